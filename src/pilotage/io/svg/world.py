"""Read a world to drive in from SVG whose unit is the metre.

Every visible stroke is solid, furniture too, and lies where its outline is, however wide it is drawn.
By class, id or layer

- `glass` is solid, and beams pass it;
- `door` stands while it is closed: `data-closed="10-40 100-160"` [s since the start], `"100-"` for ever
  after, or `"always"`;
- `person` is the path along which someone walks to and fro, or round if it is closed, with
  `data-speed="1.2"` [m/s];
- `start` marks where the robot begins, with `data-heading="90"` [degrees, counter-clockwise on the page];
- `label`, `goal` and `ignore` are not there at all.
"""

import math
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from pilotage.errors import FileError
from pilotage.geometry import Array, Pose2
from pilotage.interpretation import Role
from pilotage.io.svg.reader import (
    Shape,
    flipped,
    read_content,
    reading_values,
    wall_strokes,
    without_background,
)
from pilotage.io.svg.roles import ALWAYS, CLOSED, Thing
from pilotage.maps import SchematicMap
from pilotage.simulation import WALKING_SPEED, Door, Person, World

SPEED, HEADING = "data-speed", "data-heading"
"""Where a person says how fast it walks, and a start where the robot looks."""

SPAN = re.compile(r"(\d+(?:\.\d*)?|\.\d+)-(\d+(?:\.\d*)?|\.\d+)?")


def read_svg_world(path: Path) -> World:
    """Read an SVG (or gzipped SVG) file as a world in metres, y up.

    Raises FileError for a file that is missing, is not SVG, shows nothing solid, or holds a value that cannot
    be meant.
    """
    content = read_content(path)
    bodies = [shape for shape in content.shapes if shape.drawn.role in (Role.WALL, Role.FURNITURE)]
    with reading_values(path):
        bodily = [shape for shape in bodies if shape.drawn.thing is not Thing.PERSON]
        standing = without_background(bodily, content.page)
        walls = segments_of([shape for shape in standing if shape.drawn.thing is Thing.SOLID])
    if len(walls) == 0:
        raise FileError("a world needs at least one visible wall, found none", path)
    try:
        return World(
            walls,
            glass=segments_of([shape for shape in standing if shape.drawn.thing is Thing.GLASS]),
            doors=tuple(door for shape in standing for door in read_doors(shape)),
            people=tuple(person for shape in bodies for person in read_people(shape)),
            start=read_start(content.shapes),
        )
    except (ValueError, TypeError, IndexError, ArithmeticError) as error:
        raise FileError(f"a world holds an invalid value ({error})", path) from error


def segments_of(shapes: Sequence[Shape]) -> Array:
    """Flatten the outlines of shapes to segments, (n, 4) [m], y up."""
    strokes = tuple(flipped(stroke) for stroke in wall_strokes(shapes))
    return SchematicMap(strokes).segments if strokes else np.empty((0, 4))


def read_doors(shape: Shape) -> Iterator[Door]:
    """Read a door: a leaf for each segment of its outline."""
    if shape.drawn.thing is Thing.DOOR:
        closed = read_times(shape.drawn.notes.get(CLOSED, ""))
        yield from (Door(segment, closed) for segment in segments_of([shape]))


def read_times(text: str) -> tuple[tuple[float, float], ...]:
    """Read from when until when a door is closed [s].

    >>> read_times("10-40, 100-"), read_times("always")
    (((10.0, 40.0), (100.0, inf)), ((0.0, inf),))
    """
    if text == ALWAYS:
        return ((0.0, math.inf),)
    spans = [SPAN.fullmatch(part) for part in re.split(r"[\s,]+", text) if part]
    if None in spans:
        raise ValueError(f'{CLOSED} must be "{ALWAYS}" or seconds such as "10-40 100-160", got {text!r}')
    return tuple((float(span[1]), float(span[2] or math.inf)) for span in spans if span is not None)


def read_people(shape: Shape) -> Iterator[Person]:
    """Read who walks along an outline: one for each stroke of it."""
    if shape.drawn.thing is Thing.PERSON:
        speed = read_number(shape, SPEED, WALKING_SPEED)
        yield from (Person(flipped(stroke), speed) for stroke in wall_strokes([shape]))


def read_start(shapes: Sequence[Shape]) -> Pose2 | None:
    """Read where the robot begins, and where it looks; along the x axis if nothing is said."""
    mark = next((shape for shape in shapes if shape.drawn.role is Role.START), None)
    if mark is None:
        return None
    left, top, right, bottom = mark.bounds
    return Pose2((left + right) / 2.0, -(top + bottom) / 2.0, math.radians(read_number(mark, HEADING, 0.0)))


def read_number(shape: Shape, name: str, otherwise: float) -> float:
    """Read a number that a shape gives in its notes."""
    text = shape.drawn.notes.get(name)
    try:
        return float(text) if text is not None else otherwise
    except ValueError as error:
        raise ValueError(f"{name} must be a number, got {text!r}") from error
