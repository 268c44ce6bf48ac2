"""A scan falls into contours where the line of sight passes an edge."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from buildings import scan_at
from pilotage.geometry import Polyline, Pose2
from pilotage.perception import LaserScan, PerceptionSettings, perceive
from pilotage.perception.perceive import find_runs
from pilotage.shape import EndCause

HALF_DEGREE = math.radians(0.5)
WALLS_ONLY = PerceptionSettings(min_relevance=0.0)


def scan_of(ranges, *, first=-math.pi / 2, step=HALF_DEGREE, base_from_laser=None, range_max=50.0):
    return LaserScan(
        0.0,
        first,
        step,
        np.array(ranges),
        range_max=range_max,
        base_from_laser=base_from_laser or Pose2(0, 0, 0),
    )


def seen(segments, beams=361):
    """Look ahead from the origin."""
    return scan_at(Pose2.identity(), beams=beams, walls=[Polyline.through(ends) for ends in segments])


def ends(shapes):
    return [(shape.first_end, shape.last_end) for shape in shapes]


BOX_BEFORE_WALL = [((5.0, -9.0), (5.0, 9.0)), ((2.0, -0.5), (2.0, 0.5))]
GRAZED = [((0.0, -1.0), (20.0, -1.0))]
"""A wall along which the robot looks."""


def test_a_box_before_a_wall_occludes_it():
    shapes = perceive(seen(BOX_BEFORE_WALL), WALLS_ONLY)

    assert ends(shapes) == [
        (EndCause.RANGE_LIMIT, EndCause.OCCLUDED),
        (EndCause.OCCLUDING, EndCause.OCCLUDING),
        (EndCause.OCCLUDED, EndCause.RANGE_LIMIT),
    ]


def test_free_space_lies_left_of_every_segment():
    for shape in perceive(seen(BOX_BEFORE_WALL), WALLS_ONLY):
        vertices = shape.polyline.vertices
        steps = np.diff(vertices, axis=0)
        to_laser = -vertices[:-1]

        assert (steps[:, 0] * to_laser[:, 1] - steps[:, 1] * to_laser[:, 0] > 0.0).all()


def test_a_laser_that_turns_clockwise_sees_the_same_shapes():
    scan = seen(BOX_BEFORE_WALL)
    turned = scan_of(scan.ranges[::-1], first=math.pi / 2, step=-HALF_DEGREE)

    for expected, got in zip(perceive(scan, WALLS_ONLY), perceive(turned, WALLS_ONLY), strict=True):
        np.testing.assert_allclose(expected.polyline.vertices, got.polyline.vertices, atol=1e-9)
        assert (expected.first_end, expected.last_end) == (got.first_end, got.last_end)


@pytest.mark.parametrize("step_deg", [0.5, 1.0])
def test_a_wall_seen_at_a_grazing_angle_stays_whole(step_deg):
    (shape,) = perceive(seen(GRAZED, beams=round(180.0 / step_deg) + 1), WALLS_ONLY)
    steps = np.diff(shape.polyline.vertices, axis=0)

    assert np.hypot(*steps.T).max() > 0.3  # the paper's rule alone would break it at 0.1 m
    assert shape.polyline.vertices[-1, 0] > 13.0


def test_the_rule_of_the_paper_alone_breaks_the_grazing_wall():
    runs = find_runs(seen(GRAZED), PerceptionSettings(max_line_ratio=0.0))

    assert 0 < sum(len(run.beams) for run in runs) < 170


def test_a_noisy_grazing_wall_stays_nearly_whole():
    scan = seen(GRAZED)
    noisy = scan.ranges + np.random.default_rng(0).normal(0.0, 0.01, len(scan))
    longest = max(perceive(scan_of(noisy), WALLS_ONLY), key=lambda shape: shape.polyline.length)

    assert longest.polyline.length > 6.0


def test_a_short_step_along_the_line_of_sight_blocks_no_sight():
    ranges = [2.0] * 20 + [2.08] * 20
    (shape,) = perceive(scan_of(ranges), WALLS_ONLY)

    assert len(shape.polyline) == 40


def test_the_first_and_last_beam_end_at_the_field_of_view():
    (shape,) = perceive(scan_of([2.0] * 40), WALLS_ONLY)

    assert ends([shape]) == [(EndCause.FIELD_LIMIT, EndCause.FIELD_LIMIT)]


def test_something_too_near_occludes():
    ranges = [2.0] * 10 + [-math.inf] + [2.0] * 10
    shapes = perceive(scan_of(ranges), WALLS_ONLY)

    assert ends(shapes) == [
        (EndCause.FIELD_LIMIT, EndCause.OCCLUDED),
        (EndCause.OCCLUDED, EndCause.FIELD_LIMIT),
    ]


def test_a_full_circle_in_a_room_is_closed():
    room = [((-3, -2), (3, -2)), ((3, -2), (3, 2)), ((3, 2), (-3, 2)), ((-3, 2), (-3, -2))]
    walls = [Polyline.through(ends) for ends in room]
    scan = scan_at(Pose2.identity(), beams=360, fov=math.radians(359.0), walls=walls)
    (shape,) = perceive(scan, PerceptionSettings())

    assert shape.polyline.closed
    assert len(shape.polyline) <= 8


def test_a_full_circle_with_one_gap_is_one_line_across_the_last_beam():
    ranges = [2.0] * 360
    ranges[100] = math.inf
    (shape,) = perceive(scan_of(ranges, first=0.0, step=math.radians(1.0)), WALLS_ONLY)

    assert len(shape.polyline) == 359
    assert ends([shape]) == [(EndCause.RANGE_LIMIT, EndCause.RANGE_LIMIT)]


@pytest.mark.parametrize(
    "ranges",
    [
        [3.0],
        [math.nan],
        [math.inf],
        [math.nan] * 181,
        [math.inf] * 181,
        [-math.inf] * 181,
        [1.0, math.nan] * 90,
    ],
)
def test_scans_without_neighboring_returns_show_no_shape(ranges):
    assert () == perceive(scan_of(ranges), PerceptionSettings())


def test_shapes_are_in_the_base_frame():
    mount = Pose2(0.2, -0.1, math.pi)
    scan = seen(BOX_BEFORE_WALL)
    mounted = scan_of(scan.ranges, base_from_laser=mount)

    for expected, got in zip(perceive(scan, WALLS_ONLY), perceive(mounted, WALLS_ONLY), strict=True):
        np.testing.assert_allclose(mount @ expected.polyline.vertices, got.polyline.vertices, atol=1e-12)


RANGES = st.lists(
    st.one_of(st.floats(0.1, 20.0), st.sampled_from([math.inf, math.nan, -math.inf])), min_size=1, max_size=60
)


@given(RANGES, st.floats(-math.pi, math.pi), st.sampled_from([-0.1, -0.01, 0.01, math.tau / 60]))
def test_any_scan_falls_into_runs_of_its_own_returns(ranges, first, step):
    scan = scan_of(ranges, first=first, step=step)
    runs = find_runs(scan, PerceptionSettings())
    beams = np.concatenate([run.beams for run in runs]) if runs else np.array([], dtype=int)

    assert len(beams) == len(set(beams.tolist()))
    assert scan.returned[beams].all()
    assert all(len(run.beams) >= 2 for run in runs)


@given(RANGES)
def test_simplifying_keeps_ends_and_adds_nothing(ranges):
    raw = perceive(scan_of(ranges), WALLS_ONLY)
    simple = perceive(scan_of(ranges), PerceptionSettings())

    assert len(raw) == len(simple)
    for a, b in zip(raw, simple, strict=True):
        assert (a.polyline.vertices[[0, -1]] == b.polyline.vertices[[0, -1]]).all()
        assert {tuple(p) for p in b.polyline.vertices.tolist()} <= {
            tuple(p) for p in a.polyline.vertices.tolist()
        }


@pytest.mark.parametrize(
    "wrong",
    [{"max_shadow": -0.1}, {"range_tolerance": math.nan}, {"max_line_ratio": -1.0}, {"min_relevance": -1.0}],
)
def test_invalid_settings_are_rejected(wrong):
    with pytest.raises(ValueError, match=f"{next(iter(wrong))} must be >= 0"):
        PerceptionSettings(**wrong)
