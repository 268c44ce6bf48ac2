"""Which of many drawings is of the building that a log was made in."""

from pilotage.ranking.evidence import Evidence, observations_of, weigh
from pilotage.ranking.rank import Board, Score, rank

__all__ = ["Board", "Evidence", "Score", "observations_of", "rank", "weigh"]
