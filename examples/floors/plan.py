"""What is known of a building, and how it is remembered. Metres, y down as on the page."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from pilotage.geometry import Array

Point = tuple[float, float]
Points = list[Point]


@dataclass(frozen=True)
class Memory:
    """Where a place of the building comes to lie on the page of memory [m], room by room.

    Some x of the building are drawn at other x, and at the north end differently from the south; the same for
    y in the west and in the east. In between all is interpolated, so that neighbors keep sharing their wall.
    """

    x: Sequence[float]
    x_drawn: Mapping[float, Sequence[float]]  # for some y: where each of `x` is drawn
    y: Sequence[float]
    y_drawn: Mapping[float, Sequence[float]]  # for some x: where each of `y` is drawn

    def __call__(self, points: Array) -> Array:
        """Carry points (n, 2) to the page."""
        x, y = np.asarray(points, dtype=np.float64).T
        return np.column_stack([between(y, self.x_drawn, x, self.x), between(x, self.y_drawn, y, self.y)])


def between(
    at: Array, tables: Mapping[float, Sequence[float]], values: Array, known: Sequence[float]
) -> Array:
    """Interpolate in the tables on either side, and between them."""
    rows = np.array([extended(values, known, table) for table in tables.values()])
    places = np.array(list(tables))
    shares = np.array([np.interp(at, places, row) for row in np.eye(len(places))])
    return np.asarray((shares * rows).sum(axis=0))


def extended(values: Array, known: Sequence[float], drawn: Sequence[float]) -> Array:
    """Interpolate; beyond the ends go on metre by metre."""
    beyond = values - np.clip(values, known[0], known[-1])
    return np.asarray(np.interp(values, known, drawn) + beyond)


@dataclass(frozen=True)
class Building:
    """Walls as a pen would draw them, what stands between them, who walks there, and two memories of it."""

    name: str
    title: str
    walls: list[Points]  # a stroke for as long as the pen stays down, a gap for every door
    things: list[Points]  # what stands there and is in no drawing
    glass: list[Points]  # the parts of walls that are glass
    doors: list[tuple[Point, Point, str]]  # a leaf, and the times [s] at which it is closed
    people: list[tuple[float, Points]]  # speed [m/s], and the path walked to and fro
    start: tuple[float, float, float]  # x, y, and heading [deg], counter-clockwise on the page
    rooms: dict[str, Points]
    labels: dict[str, Point]  # the names that drawings bear, and where they are written
    careful: Memory
    quick: Memory
    left_out: list[Points]  # walls that the quick drawing leaves out
    put_in: list[Points]  # and what it draws in their place
    redrawn: dict[str, Points]  # rooms whose outline differs for that


def box(x: float, y: float, width: float, height: float) -> Points:
    """Return a rectangle as a closed stroke."""
    return [(x, y), (x + width, y), (x + width, y + height), (x, y + height), (x, y)]


def turned(x: float, y: float, width: float, height: float, angle_deg: float) -> Points:
    """Return a rectangle about (x, y), turned clockwise as seen on the page."""
    c, s = math.cos(math.radians(angle_deg)), math.sin(math.radians(angle_deg))
    corners = [
        (-width / 2, -height / 2),
        (width / 2, -height / 2),
        (width / 2, height / 2),
        (-width / 2, height / 2),
    ]
    ring = [(x + c * dx - s * dy, y + s * dx + c * dy) for dx, dy in corners]
    return [*ring, ring[0]]


def disc(x: float, y: float, radius: float) -> Points:
    """Return a round thing as a polygon of twelve corners."""
    ring = [
        (x + radius * math.cos(k * math.tau / 12), y + radius * math.sin(k * math.tau / 12))
        for k in range(12)
    ]
    return [*ring, ring[0]]
