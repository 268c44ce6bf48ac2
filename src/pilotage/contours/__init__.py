"""The paper's measure of shape: dissimilarity and matching (Wolter 2001, sections 3, 3.1 and 3.2).

The product does not use it by default: `method = "shapes"` in the settings of scan matching asks for it
(docs/theory/paper.md).
"""

from pilotage.contours.arcs import Arc, Bend, find_arcs
from pilotage.contours.dissimilarity import (
    Comparison,
    Lengths,
    Measure,
    arc_dissimilarity,
    dissimilarity,
    sequence_dissimilarity,
)
from pilotage.contours.matching import Matching, PartialMatch, match_partial, match_partial_near
from pilotage.contours.sequence import ArcSequence
from pilotage.contours.tangent import TangentFunction

__all__ = [
    "Arc",
    "ArcSequence",
    "Bend",
    "Comparison",
    "Lengths",
    "Matching",
    "Measure",
    "PartialMatch",
    "TangentFunction",
    "arc_dissimilarity",
    "dissimilarity",
    "find_arcs",
    "match_partial",
    "match_partial_near",
    "sequence_dissimilarity",
]
