"""A small flat of two rooms, drawn in code as people and programs draw it."""

import numpy as np

from pilotage.geometry import Polyline
from pilotage.interpretation import Mark, Pen, Sheet, Text, interpret
from pilotage.maps import DecompositionSettings, decompose

BLACK, RED, WHITE = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 1.0)
ROOMS = {"bath": (25.0, 40.0), "hall": (75.0, 40.0)}


def stroke(*points, color=BLACK, width=1.0, dashed=False, names=()):
    """A line through points."""
    return Mark((Polyline(np.array(points, dtype=float)),), Pen(color, width, dashed), names=names)


def box(left, bottom, right, top, *, pen=None, fill=None, names=()):
    """A rectangle."""
    corners = np.array([(left, bottom), (right, bottom), (right, top), (left, top)], dtype=float)
    return Mark((Polyline(corners, closed=True),), pen, fill, names=names)


OUTSIDE = box(0, 0, 100, 80, pen=Pen(BLACK, 1.0))
WITH_GAP = (OUTSIDE, stroke((50, 0), (50, 30)), stroke((50, 42), (50, 80)))
LABELS = tuple(Text(name, at, height=3.0) for name, at in ROOMS.items())


def arc(center, radius, start, end):
    """A part of a circle in chords; angles in degrees."""
    angles = np.radians(np.linspace(start, end, 9))
    return stroke(*(np.array(center) + radius * np.column_stack([np.cos(angles), np.sin(angles)])))


def graph_of(marks, texts=LABELS):
    """Divide what is understood of marks into cells."""
    return decompose(interpret(Sheet(tuple(marks), texts)).sketch, DecompositionSettings())


def are_joined(marks):
    """Tell whether the two rooms are told apart and one leads to the other."""
    graph = graph_of(marks)
    ids = {cell.label: cell.cell_id for cell in graph.cells}
    assert set(ROOMS) == set(ids)
    return ids["hall"] in {neighbor.cell_id for neighbor in graph.neighbors(ids["bath"])}


def flight(count, *, depth=2.0, width=10.0, turn=0.0):
    """Lines, one after the other along x, turned as a whole, (n, 2, 2)."""
    x = depth * np.arange(count)
    lines = np.stack([np.column_stack([x, 0.0 * x]), np.column_stack([x, 0.0 * x + width])], axis=1)
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    return lines @ rotation.T
