"""Which frontier the robot drives to while it does not know its place."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from buildings import coarse, flat, scan_at
from knowing import hypothesis_at
from pilotage.geometry import Polyline, Pose2
from pilotage.maps import Roadmap, RouteSettings, SchematicMap, build_atlas
from pilotage.navigation.cost_to_go import cost_to_go
from pilotage.navigation.frontier import (
    AROUND,
    BLOCK,
    Exploration,
    box_mean,
    farthest,
    farthest_along,
    find_frontiers,
    frontier_worth,
    range_differences,
)
from pilotage.navigation.local_grid import LocalGrid
from strategies import angles

RADIUS = 0.2
HERE = Pose2.identity()
COARSE = coarse()
CORRIDOR = (Polyline.through([(-7, -1), (7, -1)]), Polyline.through([(-7, 1), (7, 1)]))
"""Open at both ends [m]."""
ALL_AROUND = {"beams": 720, "fov": math.tau * 719 / 720}


@pytest.fixture(scope="module")
def atlas():
    return build_atlas(flat(), COARSE)


def reach_in(walls, pose=HERE, size=9.0, **laser):
    """Look once, and see where one can go."""
    return LocalGrid.unknown(size).seen(scan_at(pose, walls=walls, **laser), pose).reachable_set(RADIUS)


def chosen_in(reach, atlas, *, trail=HERE.position[np.newaxis], places=(), goal=None):
    """Return the frontier of largest worth, (2,) [m]; `goal` is the cost to go and particles."""
    frontiers = find_frontiers(reach)
    worth = frontier_worth(reach, frontiers, trail, places, atlas)
    if goal is not None:
        costs, states = goal
        in_base = reach.local_grid.odom_from_base.inverse() @ reach.points[frontiers]
        worth = worth + costs.expected_progress(in_base, states)
    return reach.points[frontiers[worth.argmax()]]


def place(x, y, heading=0.0, *, scale=1.0, probability=0.5):
    return hypothesis_at(Pose2(x, y, heading), scale=scale, probability=probability)


@given(st.integers(1, 30), st.integers(1, 30), st.integers(1, 6), st.integers(0, 2**32 - 1))
def test_means_over_squares_are_plain_means(width, height, half, seed):
    mask = np.random.default_rng(seed).random((width, height)) < 0.5

    windows = np.lib.stride_tricks.sliding_window_view(np.pad(mask, half), (2 * half + 1, 2 * half + 1))
    np.testing.assert_allclose(windows.mean(axis=(2, 3)), box_mean(mask, half), atol=1e-9)


def test_frontiers_are_reachable_places_beside_much_that_was_not_seen():
    reach = reach_in(CORRIDOR)
    frontiers = find_frontiers(reach)

    unseen = reach.local_grid.middles(np.argwhere(reach.local_grid.evidence == 0))
    tree = shapely.STRtree(shapely.points(unseen))
    assert len(frontiers) > 0
    for point in reach.points[frontiers]:
        around = tree.query(shapely.Point(point), "dwithin", AROUND * math.sqrt(2.0))
        assert len(around) > 0.25 * (2.0 * AROUND / 0.05) ** 2


def test_of_each_block_one_place_is_considered():
    reach = reach_in(CORRIDOR)
    frontiers = find_frontiers(reach)

    blocks = np.floor(reach.points[frontiers] / BLOCK)
    assert len(frontiers) == len(np.unique(blocks, axis=0))


def test_where_all_was_seen_there_is_nowhere_to_explore():
    hall = Polyline.through([(-5, -5), (5, -5), (5, 5), (-5, 5)], closed=True)
    reach = reach_in((hall,), size=4.0, **ALL_AROUND)

    assert 0 == len(find_frontiers(reach))


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_the_robot_drives_to_where_it_was_not(atlas, side):
    reach = reach_in(CORRIDOR, **ALL_AROUND)
    trail = np.column_stack([np.linspace(0.0, side * 7.0, 30), np.zeros(30)])

    assert side * chosen_in(reach, atlas, trail=trail)[0] < -1.0


@given(angles)
def test_the_robot_rather_goes_on_than_turns_round(atlas, heading):
    pose = Pose2(0.0, 0.0, heading)
    reach = reach_in(CORRIDOR, pose, **ALL_AROUND)

    ahead = chosen_in(reach, atlas) @ (math.cos(heading), math.sin(heading))
    assert ahead > 0.0 or abs(math.cos(heading)) < 0.5


def test_one_place_alone_differs_from_nothing(atlas):
    points = np.array([[0.0, 0.0], [1.0, 0.5]])

    assert [0.0, 0.0] == range_differences(points, (), atlas).tolist()
    assert [0.0, 0.0] == range_differences(points, (place(1.5, 5.0),), atlas).tolist()


def test_places_that_look_alike_do_not_differ():
    square = SchematicMap((Polyline.through([(-2, -2), (2, -2), (2, 2), (-2, 2)], closed=True),))
    alike = build_atlas(square, coarse(41))
    four = tuple(place(0.0, 0.0, quarter * math.pi / 2.0) for quarter in range(4))
    points = np.array([[0.0, 0.0], [1.0, 0.3], [-0.7, 1.2]])

    one_off = (place(0.0, 0.0), place(1.2, 0.0))
    assert range_differences(points, four, alike).max() < 0.05
    assert range_differences(points[:1], one_off, alike)[0] > 0.15


def test_places_differ_most_where_they_would_look_most_different(atlas):
    # Both stand in the same room and look the same way, but for what lies around the corner.
    here, there = place(1.5, 5.0, -math.pi / 2), place(1.5, 6.0, -math.pi / 2)
    far_from_corner, at_corner = np.array([[0.0, 0.0]]), np.array([[2.5, 0.0]])

    near, far = (range_differences(point, (here, there), atlas)[0] for point in (at_corner, far_from_corner))
    assert near > far


def test_a_place_that_is_hardly_possible_hardly_counts(atlas):
    points = np.array([[0.5, 0.0]])
    first, second = (1.5, 5.0), (8.0, 5.0)
    even = range_differences(points, (place(*first), place(*second)), atlas)
    rare = range_differences(
        points, (place(*first, probability=0.98), place(*second, probability=0.02)), atlas
    )

    assert 0.0 < rare[0] < 0.5 * even[0]


def test_places_of_different_scale_see_the_same_where_that_explains_it(atlas):
    # Twice as large a scale, and so half as far in metres: the ranges differ by log 2 everywhere.
    points = np.array([[0.0, 0.0]])
    differ = range_differences(points, (place(1.5, 5.0), place(1.5, 5.0, scale=2.0)), atlas)

    assert math.log(2.0) / 2.0 == pytest.approx(differ[0], abs=1e-6)


@pytest.mark.parametrize("side", [-1, 1])
def test_the_robot_drives_to_what_tells_places_apart(side):
    # Only at one end does the drawn corridor widen; which way the robot looks along it is not known.
    corners = [(-7, -1), (5, -1), (5, -5), (9, -5), (9, 5), (5, 5), (5, 1), (-7, 1)]
    drawn = Polyline.through([(side * x, y) for x, y in corners], closed=True)
    atlas = build_atlas(SchematicMap((drawn,)), COARSE)
    places = (place(0.0, 0.0), place(0.0, 0.0, math.pi))
    points = np.array([[4.0, 0.0], [-4.0, 0.0], [0.0, 0.0]])

    ahead, behind, here = range_differences(points, places, atlas)
    assert ahead == pytest.approx(behind, rel=0.1)
    assert ahead > 1.5 * here


@pytest.mark.parametrize("side", [-1, 1])
def test_of_two_open_ends_the_robot_chooses_the_one_that_tells_places_apart(side):
    corners = [(-40, -1), (5, -1), (5, -5), (9, -5), (9, 5), (5, 5), (5, 1), (-40, 1)]
    drawn = Polyline.through([(side * x, y) for x, y in corners], closed=True)
    atlas = build_atlas(SchematicMap((drawn,)), COARSE)
    across = math.pi / 2.0  # so that no end is nearer by turning
    reach = reach_in(CORRIDOR, Pose2(0.0, 0.0, across), **ALL_AROUND)

    places = (place(0.0, 0.0, across), place(side * 1.5, 0.0, across))

    assert side * chosen_in(reach, atlas, places=places)[0] > 1.0


@pytest.mark.parametrize("side", [-1, 1])
def test_of_two_open_ends_the_robot_chooses_the_one_that_most_particles_find_nearer_to_the_goal(side):
    drawn = Polyline.through([(-30, -1), (30, -1), (30, 1), (-30, 1)], closed=True)
    atlas = build_atlas(SchematicMap((drawn,)), COARSE)
    left = cost_to_go(atlas, Roadmap(atlas.cell_graph, RouteSettings()), (side * 25.0, 0.0))
    across = math.pi / 2.0
    reach = reach_in(CORRIDOR, Pose2(0.0, 0.0, across), **ALL_AROUND)
    states = np.array([(x, 0.0, across, 0.0, 0.0, 0.0) for x in (-10.0, 0.0, 10.0)]).T
    turned = np.array([(5.0, 0.0, -across, 0.0, 0.0, 0.0)]).T

    assert side * chosen_in(reach, atlas, goal=(left, np.hstack([states, turned])))[0] > 1.0


def test_places_differ_as_much_on_a_larger_drawing():
    points = np.array([[0.0, 0.0], [1.0, 0.3], [2.0, -1.0]])
    told = []
    for scale in (1.0, 30.0):
        atlas = build_atlas(flat(scale), COARSE)
        places = [place(scale * x, scale * y, scale=scale) for x, y in ((1.5, 5.0), (7.5, 5.0))]
        told.append(range_differences(points, tuple(places), atlas))

    np.testing.assert_allclose(*told, rtol=0.05)


def test_the_farthest_place_is_far_from_the_trail():
    reach = reach_in(CORRIDOR, **ALL_AROUND)
    trail = np.column_stack([np.linspace(0.0, 3.0, 15), np.zeros(15)])

    x, _ = reach.points[farthest(reach, trail)]
    assert x == pytest.approx(reach.points[:, 0].min(), abs=0.2)


@pytest.mark.parametrize("heading", [0.0, math.pi])
def test_along_a_corridor_the_robot_drives_on_as_it_looks(heading):
    reach = reach_in(CORRIDOR, Pose2(0.0, 0.0, heading), **ALL_AROUND)
    chosen = [reach.points[farthest_along(reach, np.array(axis))] for axis in ((0.2, 0.0), (-0.2, 0.0))]

    np.testing.assert_array_equal(*chosen)
    assert 2.0 < chosen[0][0] * math.cos(heading)


def test_before_a_wall_nothing_leads_on():
    end = (*CORRIDOR, Polyline.through([(0.5, -1), (0.5, 1)]))

    assert farthest_along(reach_in(end, **ALL_AROUND), np.array([1.0, 0.0])) is None


def test_the_target_is_kept_until_it_is_reached():
    reach = reach_in(CORRIDOR, **ALL_AROUND)
    far, near = np.array([2.0, 0.0]), np.array([0.2, 0.0])

    assert Exploration().target_in(reach) is None
    assert 0.1 > np.hypot(*(reach.points[Exploration(far).target_in(reach)] - far))
    assert Exploration(near).target_in(reach) is None
    assert Exploration(np.array([2.0, 5.0])).target_in(reach) is None


def test_what_could_not_be_reached_is_remembered_and_avoided(atlas):
    across = Pose2(0.0, 0.0, math.pi / 2.0)
    reach = reach_in(CORRIDOR, across, **ALL_AROUND)
    first = chosen_in(reach, atlas)
    exploration = Exploration(first).given_up()
    avoided = np.vstack([HERE.position, exploration.unreachable])

    assert exploration.target is None
    assert first[0] * chosen_in(reach, atlas, trail=avoided)[0] < 0.0
    assert exploration is exploration.given_up()
