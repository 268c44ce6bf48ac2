"""All that a localizer has learned, as a value that can be kept while the robot is switched off."""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from pilotage.errors import PilotageError
from pilotage.localization.belief import Belief
from pilotage.localization.other_buildings import ElsewhereState
from pilotage.maps import SchematicMap


class OtherDrawingError(PilotageError):
    """A state is of another drawing."""


@dataclass(frozen=True, eq=False)
class LocalizerState:
    """What a localizer believes, and what its scan matcher and its generator go on from."""

    drawing: str  # fingerprint of the drawing
    belief: Belief
    scan_matcher: Mapping[str, object]  # its attributes that change from scan to scan
    elsewhere: ElsewhereState
    generator: Mapping[str, object]  # of the localizer's random numbers
    scale: float | None = None  # [drawing units per metre] that the user gave

    def check_drawing(self, sketch: SchematicMap) -> None:
        """Reject the state of another drawing; raises OtherDrawingError."""
        if self.drawing != fingerprint(sketch):
            raise OtherDrawingError("the saved state is of another drawing, or this one was changed since")


def fingerprint(sketch: SchematicMap) -> str:
    """Sum up the strokes and the names of a drawing, which give its cells and gateways their ids.

    >>> from pilotage.geometry import Polyline
    >>> one, other = (SchematicMap((Polyline.through([(0, 0), (1, y)]),)) for y in (0, 1))
    >>> fingerprint(one) == fingerprint(one) != fingerprint(other)
    True
    """
    total = hashlib.sha256(np.ascontiguousarray(sketch.segments).tobytes())
    for label in sketch.labels:
        total.update(repr((label.text, label.position)).encode())
    return total.hexdigest()
