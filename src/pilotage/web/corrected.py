"""The drawing as the robot of a drive or a log found it, as SVG in metres."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from pilotage.correction import NothingBelievedError, Sighting, correct_drawing
from pilotage.errors import PilotageError
from pilotage.geometry import Polyline, Pose2
from pilotage.maps import Atlas, Label, SchematicMap
from pilotage.web.drawings import svg_of


class NotSureError(PilotageError):
    """The robot was hardly ever sure of its place."""


def corrected_svg(atlas: Atlas, sightings: Sequence[Sighting]) -> str:
    """Bend a drawing to where its walls were seen; NotSureError if the robot was hardly ever sure.

    It lies on the page as the drawing does, and not as the robot stood when it began.
    """
    try:
        found = correct_drawing(atlas, sightings)
    except NothingBelievedError as error:
        raise NotSureError("the drawing cannot be corrected yet: the robot must be sure for 5 m") from error
    cosine, sine = found.metres_from_sketch.linear[:, 0]
    return svg_of(turned(found.sketch, -math.atan2(sine, cosine)))


def turned(sketch: SchematicMap, angle: float) -> SchematicMap:
    """Turn a drawing about its origin [rad]."""
    turn = Pose2(0.0, 0.0, angle)

    def point(place: tuple[float, float]) -> tuple[float, float]:
        x, y = (turn @ np.array([place]))[0].tolist()
        return x, y

    def line(stroke: Polyline) -> Polyline:
        return Polyline(turn @ stroke.vertices, stroke.closed)

    return replace(
        sketch,
        strokes=tuple(map(line, sketch.strokes)),
        solids=tuple(map(line, sketch.solids)),
        labels=tuple(Label(label.text, point(label.position)) for label in sketch.labels),
        start=None if sketch.start is None else point(sketch.start),
        goal=None if sketch.goal is None else point(sketch.goal),
    )
