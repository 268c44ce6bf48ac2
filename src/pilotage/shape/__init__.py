"""What a contour looks like: simplification, arcs, dissimilarity, matching (Wolter 2001, 2.2 to 3.1)."""

from pilotage.shape.partial import EndCause, PartialShape
from pilotage.shape.simplify import Simplification, relevances, simplify, simplify_all

__all__ = ["EndCause", "PartialShape", "Simplification", "relevances", "simplify", "simplify_all"]
