"""Buildings made up from a drawing."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from buildings import coarse, flat
from pilotage.geometry import Polyline, Pose2
from pilotage.maps import SchematicMap, build_atlas
from pilotage.simulation import StartError
from pilotage.simulation.made_real import MOST_PIECES, make_real
from pilotage.simulation.proportions import Proportions

ATLAS = build_atlas(flat(), coarse())
RADIUS = 0.2
SEEDS = st.integers(0, 10_000)


def proportions(seed, severity=1.0):
    return Proportions.at_random((0.0, -2.0, 40.0, 30.0), 0.1, severity, np.random.default_rng(seed))


@given(SEEDS, st.lists(st.tuples(st.floats(-10, 50), st.floats(-10, 40)), min_size=1, max_size=5))
def test_the_way_to_the_world_and_back_is_none(seed, places):
    points = np.array(places)

    there = proportions(seed).world_from_sketch(points)

    assert points == pytest.approx(proportions(seed).sketch_from_world(there), abs=1e-6)


@given(SEEDS)
def test_order_along_an_axis_is_kept_and_severity_0_changes_nothing(seed):
    points = np.column_stack([np.linspace(0, 40, 30), np.linspace(-2, 30, 30)])

    assert (np.diff(proportions(seed).world_from_sketch(points), axis=0) > 0).all()
    drawn = proportions(seed, severity=0.0).world_from_sketch(points)
    assert 0.1 * np.diff(points, axis=0) == pytest.approx(np.diff(drawn, axis=0))


@given(SEEDS)
def test_a_bent_segment_lies_where_its_points_lie(seed):
    bent = proportions(seed).bent(np.array([[1.0, 2.0, 33.0, 25.0]]))
    on_it = np.linspace([1.0, 2.0], [33.0, 25.0], 50)

    line = shapely.LineString([*bent[:, :2], bent[-1, 2:]])
    away = shapely.distance(line, shapely.points(proportions(seed).world_from_sketch(on_it)))
    assert away.max() < 1e-9


@given(st.floats(-3, 3))
def test_a_heading_is_carried_to_the_drawing(heading):
    x, y, carried = proportions(1, severity=0.0).sketch_pose(Pose2(3.0, 2.0, heading))

    assert heading == pytest.approx(carried, abs=1e-6)
    there = proportions(1, severity=0.0).world_from_sketch(np.array([[x, y]]))[0]
    assert [3.0, 2.0] == pytest.approx(there.tolist())


@given(SEEDS, st.floats(0.0, 1.0))
@settings(max_examples=8)
def test_the_robot_can_go_to_the_goal_and_to_every_room(seed, severity):
    goal = ATLAS.cell_graph.cells[-1].center
    made = make_real(ATLAS, severity, np.random.default_rng(seed), goal=goal)
    start = made.world.start.position

    for place in (goal, *(cell.center for cell in ATLAS.cell_graph.cells)):
        there = made.proportions.world_from_sketch(np.array([place]))[0]
        if place == goal or made.world.is_free([there], RADIUS)[0]:
            assert math.isfinite(made.world.shortest_way(start, there, RADIUS).length)
    assert ATLAS.cell_graph.cells[-1].cell_id != ATLAS.cell_at(
        tuple(made.proportions.sketch_pose(made.world.start)[:2])
    )


def test_equal_seeds_make_equal_buildings_and_severity_fills_them():
    made = [make_real(ATLAS, severity, np.random.default_rng(5)) for severity in (0.0, 0.9, 0.9)]

    assert np.array_equal(made[1].world.segments, made[2].world.segments)
    assert made[1].world.start == made[2].world.start
    assert len(made[0].world.segments) < len(made[1].world.segments)
    assert () == made[0].world.people


def test_a_building_of_kilometres_gets_no_more_furniture_than_a_large_one():
    sketch = replace(ATLAS.sketch, metres_per_unit=50.0)
    empty, made = (
        make_real(replace(ATLAS, sketch=sketch), severity, np.random.default_rng(0)).world
        for severity in (0.0, 0.1)
    )

    assert 0 < len(made.segments) - len(empty.segments) < 4 * MOST_PIECES


def test_a_drawing_of_closed_rooms_is_built_with_doors():
    strokes = ([(0, 0), (15, 0), (15, 5), (0, 5), (0, 0)], [(5, 0), (5, 5)], [(10, 0), (10, 5)])
    closed = build_atlas(SchematicMap(tuple(map(Polyline.through, strokes))), coarse())
    made = make_real(closed, 0.3, np.random.default_rng(0), start=(2.5, 2.5), goal=(12.5, 2.5))
    goal = made.proportions.world_from_sketch(np.array([(12.5, 2.5)]))[0]

    assert () == closed.cell_graph.gateways
    assert 2 == len(made.world.doors)
    assert math.isfinite(made.world.shortest_way(made.world.start.position, goal, RADIUS).length)


def test_a_marked_start_is_where_the_robot_stands():
    place = ATLAS.cell_graph.cells[0].center
    made = make_real(ATLAS, 0.5, np.random.default_rng(0), start=place, heading=1.0)

    assert (*place, 1.0) == pytest.approx(made.proportions.sketch_pose(made.world.start), abs=0.3)
    with pytest.raises(StartError):
        make_real(ATLAS, 0.0, np.random.default_rng(0), start=(0.0, 0.0))
