"""Places as a user types them: a point, a word, a pose."""

import math
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from pilotage.geometry import Pose2
    from pilotage.maps import CellGraph, SchematicMap
    from pilotage.maps.routing.roadmap import Point


FARTHEST = 1e9
"""Largest number that is accepted: no drawing is larger."""


def find_place(words: str, sketch: "SchematicMap", graph: "CellGraph") -> "Point":
    """Read `X,Y` in the axes of the drawing's file, or find the cell that bears a label."""
    from pilotage.maps import find_labeled

    place = point_or_label(words, sketch)
    return find_labeled(graph, place) if isinstance(place, str) else place


def point_or_label(words: str, sketch: "SchematicMap") -> "Point | str":
    """Read `X,Y` in the axes of the drawing's file as a point of the sketch; all else is a label."""
    import numpy as np

    numbers = finite_numbers(words)
    if len(numbers) != 2:
        return words
    position = sketch.sketch_from_file(np.array([numbers]))[0]
    return float(position[0]), float(position[1])


def pose_on(sketch: "SchematicMap", words: str, option: str) -> "Pose2":
    """Read `X,Y,HEADING_DEG` in the axes of the drawing's file as a pose of the sketch."""
    from pilotage.geometry import Pose2

    return sketch.file_axes.pose_to_sketch(Pose2(*parse_pose(words, option)))


def parse_pose(words: str, option: str) -> tuple[float, float, float]:
    """Read `X,Y,HEADING_DEG`; the heading comes in radians."""
    numbers = finite_numbers(words)
    if len(numbers) != 3:
        raise typer.BadParameter(
            f"a start must be three numbers X,Y,HEADING_DEG, got {words!r}", param_hint=option
        )
    x, y, heading_deg = numbers
    return x, y, math.radians(heading_deg)


def finite_numbers(words: str) -> list[float]:
    """Read numbers between commas; none if one of them is not a number, or beyond `FARTHEST`.

    >>> finite_numbers("1,-2.5"), finite_numbers("nan,1"), finite_numbers("kitchen")
    ([1.0, -2.5], [], [])
    """
    try:
        numbers = [float(word) for word in words.split(",")]
    except ValueError:
        return []
    return numbers if all(abs(number) <= FARTHEST for number in numbers) else []
