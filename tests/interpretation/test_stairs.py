"""Stairs are not driven into, and what a person says of a layer decides."""

from dataclasses import replace

import pytest
import shapely

from flats import BLACK, OUTSIDE, WITH_GAP, box, stroke
from pilotage.interpretation import Pen, Role, Sheet, interpret
from pilotage.maps import DecompositionSettings, decompose

FLIGHT = tuple(stroke((70.0 + 2.0 * k, 10.0), (70.0 + 2.0 * k, 25.0)) for k in range(7))
ON_STAIRS = shapely.box(70.5, 10.5, 81.5, 24.5)
FRONT = stroke((60, 30), (60, 40), color=(0.9, 0.1, 0.1))
"""Parts no room, so that it is a wall only if someone says so."""


def named(marks, name):
    """The marks on a layer."""
    return tuple(replace(mark, names=(name,)) for mark in marks)


def sketch_of(marks, **layers):
    return interpret(Sheet(tuple(marks)), layers).sketch


def free(sketch):
    """All space that a robot may drive in."""
    graph = decompose(sketch, DecompositionSettings())
    return shapely.union_all([cell.polygon for cell in graph.cells])


@pytest.mark.parametrize("name", ["A-STAIRS", "Treppe", "lift"])
def test_stairs_are_closed_though_steps_leave_gaps_at_their_ends(name):
    assert not free(sketch_of((*WITH_GAP, *named(FLIGHT, name)))).intersects(ON_STAIRS)


def test_stairs_by_a_word_of_the_user_are_closed():
    assert not free(sketch_of((*WITH_GAP, *named(FLIGHT, "X7")), X7=Role.STAIRS)).intersects(ON_STAIRS)


def test_a_lift_within_painted_walls_is_solid():
    walls = [box(0, 0, 100, 4), box(0, 76, 100, 80), box(0, 4, 4, 76), box(96, 4, 100, 76)]
    walls += [box(48, 4, 52, 30), box(48, 42, 52, 76)]
    painted = tuple(replace(mark, fill=BLACK) for mark in walls)
    lift = box(70, 10, 82, 25, pen=Pen(BLACK, 0.5), names=("elevator",))
    sketch = sketch_of((*painted, lift))

    assert sketch.solids
    assert not free(sketch).intersects(ON_STAIRS)


def test_stairs_of_one_line_close_nothing():
    alone = sketch_of((*WITH_GAP, *named((stroke((70, 10), (90, 10)),), "stairs")))

    assert free(alone).equals(free(sketch_of(WITH_GAP)))


@pytest.mark.parametrize("role", [Role.WALL, Role.WINDOW])
def test_a_layer_that_the_user_calls_walls_is_walls(role):
    told = sketch_of((OUTSIDE, *named(WITH_GAP[1:], "X7")), X7=role)

    assert told.strokes == sketch_of(WITH_GAP).strokes


def test_a_line_that_parts_no_room_is_a_wall_if_the_user_says_so():
    marks = (*WITH_GAP, *named((FRONT,), "X7"))

    assert [60.0, 30.0, 60.0, 40.0] in sketch_of(marks, X7=Role.WALL).segments.tolist()
    assert [60.0, 30.0, 60.0, 40.0] not in sketch_of(marks).segments.tolist()
