"""Polylines as shapes: simplification, corners, partial shapes (Wolter 2001, 2.1 and 2.2)."""

from pilotage.shape.partial import EndCause, PartialShape
from pilotage.shape.simplify import Simplification, relevances, simplify, simplify_all

__all__ = ["EndCause", "PartialShape", "Simplification", "relevances", "simplify", "simplify_all"]
