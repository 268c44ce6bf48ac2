"""Which of many drawings is of the building that a log was made in, in many processes."""

from pilotage.ranking.evidence import Evidence, observe, weigh
from pilotage.ranking.rank import Board, Score, rank
from pilotage.ranking.workers import Cluster, Processes, Workers

__all__ = ["Board", "Cluster", "Evidence", "Processes", "Score", "Workers", "observe", "rank", "weigh"]
