import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from pilotage.evaluation.deformation import Plan, deform, read_plan, statistics_of
from pilotage.evaluation.deformation.doors import find_openings
from pilotage.evaluation.deformation.elastic import bend, least_areas, linear_of, node_grid
from pilotage.evaluation.deformation.omissions import change
from pilotage.evaluation.deformation.statistics import elongations, similarity_miss
from pilotage.evaluation.rooms import Rooms, read_world_rooms
from pilotage.evaluation.warp import Warp
from pilotage.geometry import Affine2, Polyline, Pose2
from pilotage.maps import RangeTableSettings, SchematicMap
from pilotage.maps.range_table import build_range_table
from pilotage.worlds import OFFICE

PLAN = read_plan(OFFICE.careful)


@pytest.mark.parametrize(("person", "severity"), [(0, 0.3), (1, 0.7), (2, 1.0), (3, 1.25)])
def test_what_is_the_same_place_stays_in_its_room(person, severity):
    drawn = deform(PLAN, severity, person)
    known = [name in drawn.rooms.names for name in PLAN.rooms.names_at(PLAN.warp.in_sketch)]
    before = np.array(PLAN.rooms.names_at(PLAN.warp.in_sketch))[known]
    after = np.array(drawn.rooms.names_at(drawn.warp.in_sketch))[known]

    assert np.mean(before == after) > 0.97  # on a border either room is right


@pytest.mark.parametrize("person", range(3))
def test_at_severity_zero_the_plan_is_only_laid_down(person):
    drawn = deform(PLAN, 0.0, person)

    assert similarity_miss(PLAN.warp.in_sketch, drawn.warp.in_sketch) < 1e-6
    assert PLAN.rooms.names == drawn.rooms.names


def test_equal_persons_draw_equally_and_others_do_not():
    first, again, other = (deform(PLAN, 1.0, person) for person in (3, 3, 4))

    assert shapely.equals_exact(first.strokes, again.strokes)
    np.testing.assert_array_equal(first.warp.in_sketch, again.warp.in_sketch)
    assert not np.array_equal(first.warp.in_sketch, other.warp.in_sketch)


def test_severity_makes_a_drawing_worse():
    rooms = read_world_rooms(OFFICE.folder / "rooms.geojson")
    way = PLAN.warp.in_world
    stretches = [
        np.mean(
            [statistics_of(deform(PLAN, severity, person), way, rooms).stretch_median for person in range(3)]
        )
        for severity in (0.0, 0.5, 1.0)
    ]

    assert stretches == sorted(stretches)
    assert stretches[2] > 1.4


def test_equal_wishes_bend_the_sheet_evenly():
    corner, nodes = node_grid((0.0, 0.0, 12.0, 9.0))
    wish = np.array([0.3, 0.2, -0.1, 0.4])

    sheet = bend(corner, np.broadcast_to(wish, (*nodes.shape[:2], 4)))

    points = np.random.default_rng(0).uniform(0.0, 9.0, (20, 2))
    expected = (points - corner) @ linear_of(wish).T + corner
    np.testing.assert_allclose(sheet.carry(points), expected, atol=1e-9)


@pytest.mark.parametrize("seed", range(5))
def test_no_wish_folds_the_sheet(seed):
    corner, nodes = node_grid((0.0, 0.0, 15.0, 10.0))
    wishes = np.random.default_rng(seed).normal(0.0, 1.0, (*nodes.shape[:2], 4))

    assert least_areas(bend(corner, wishes).nodes).min() > 0.0


def test_openings_are_found_and_all_rooms_stay_joined():
    openings = find_openings(PLAN.rooms, PLAN.strokes)
    changed = change(PLAN, 1.0, np.random.default_rng(1)).plan

    assert len(openings) >= len(PLAN.rooms.names) - 1
    assert set(changed.rooms.names) <= set(PLAN.rooms.names)


@pytest.mark.parametrize("severity", [-0.1, float("nan"), float("inf")])
def test_a_severity_that_means_nothing_is_refused(severity):
    with pytest.raises(ValueError, match="severity must be"):
        deform(PLAN, severity, 0)


@pytest.mark.parametrize("person", range(2))
def test_the_true_warp_leads_back_to_the_building(person):
    straight = deform(PLAN, 0.0, person).straightened()

    strayed = shapely.difference(straight.strokes, shapely.buffer(PLAN.straightened().strokes, 0.05))
    assert strayed.length < 0.02 * straight.strokes.length
    np.testing.assert_array_equal(straight.warp.in_sketch, straight.warp.in_world)


def test_without_the_warp_a_bent_drawing_has_true_proportions():
    rooms = read_world_rooms(OFFICE.folder / "rooms.geojson")
    bent = deform(PLAN, 0.6, 1)
    true = dict(zip(PLAN.rooms.names, PLAN.straightened().rooms.polygons, strict=True))

    straight = bent.straightened()

    for name, room in zip(straight.rooms.names, straight.rooms.polygons, strict=True):
        overlap = room.buffer(0.0).intersection(true[name]).area / true[name].area
        assert overlap > 0.8, name
    statistics = statistics_of(straight, PLAN.warp.in_world, rooms)
    assert statistics.stretch_median < 1.01
    assert statistics.shortening == pytest.approx(0.0, abs=0.01)


@given(st.floats(-0.35, 0.35), st.floats(-0.35, 0.35))
@settings(max_examples=10)
def test_the_view_in_a_stretched_round_room_is_as_long_as_its_stretch(p, q):
    angles = np.linspace(0.0, math.tau, 60, endpoint=False)
    outline = np.stack([np.cos(angles), np.sin(angles)], axis=1) @ Affine2.from_state(0, 0, 0, 0, p, q).linear
    room = SchematicMap((Polyline(outline, closed=True),))
    table = build_range_table(room, RangeTableSettings(cells=61, directions=90))

    np.testing.assert_allclose(elongations(table, np.zeros((1, 2)))[:, 0], (p, q), atol=0.05)


@pytest.mark.parametrize(("degrees", "p", "q"), [(0, 1, 0), (45, 0, 1), (90, -1, 0), (135, 0, -1)])
def test_the_view_in_a_hall_is_as_long_as_half_the_logarithm_of_its_sides(degrees, p, q):
    hall = Polyline.through([(0, 0), (12, 0), (12, 3), (0, 3), (0, 0)])
    turn = Pose2(0.0, 0.0, math.radians(degrees))
    table = build_range_table(SchematicMap((hall.moved(turn),)), RangeTableSettings(cells=60))

    seen = elongations(table, turn @ np.array([(6.0, 1.5)]))[:, 0]

    np.testing.assert_allclose(seen, 0.5 * math.log(12 / 3) * np.array([p, q]), atol=0.05)


def test_a_hall_drawn_half_as_long_is_shortened():
    grid = np.stack(np.meshgrid([0.0, 4.0, 8.0, 12.0], [0.0, 3.0]), axis=-1).reshape(-1, 2)
    hall = shapely.box(0.0, 0.0, 12.0, 3.0)
    true = Plan(shapely.MultiLineString([hall.exterior]), Rooms(("hall",), (hall,)), Warp(grid, grid))
    way = np.array([(1.5, 1.5), (6.0, 1.5), (10.5, 1.5)])

    halved = true.moved(np.diag([0.5, 1.0]))

    assert statistics_of(true, way, true.rooms).shortening == pytest.approx(0.0, abs=1e-6)
    # The map stretches by log(1/2) / 2, and a view of 2 : 1 is elongated by log(2) / 2.
    assert statistics_of(halved, way, true.rooms).shortening == pytest.approx(1.0, abs=0.2)
