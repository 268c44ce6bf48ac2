"""What a contour looks like: simplification, arcs, dissimilarity, matching (Wolter 2001, 2.2 to 3.1)."""

from pilotage.shape.arcs import Arc, Bend, find_arcs
from pilotage.shape.dissimilarity import (
    Comparison,
    Lengths,
    Measure,
    arc_dissimilarity,
    dissimilarity,
    sequence_dissimilarity,
)
from pilotage.shape.matching import Matching, PartialMatch, match_partial, match_partial_near
from pilotage.shape.partial import EndCause, PartialShape
from pilotage.shape.sequence import ArcSequence
from pilotage.shape.simplify import Simplification, relevances, simplify, simplify_all
from pilotage.shape.tangent import TangentFunction

__all__ = [
    "Arc",
    "ArcSequence",
    "Bend",
    "Comparison",
    "EndCause",
    "Lengths",
    "Matching",
    "Measure",
    "PartialMatch",
    "PartialShape",
    "Simplification",
    "TangentFunction",
    "arc_dissimilarity",
    "dissimilarity",
    "find_arcs",
    "match_partial",
    "match_partial_near",
    "relevances",
    "sequence_dissimilarity",
    "simplify",
    "simplify_all",
]
