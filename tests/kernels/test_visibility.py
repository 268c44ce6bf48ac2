import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from pilotage.kernels import visibility as kernel
from pilotage.kernels.displacement import displace

DIRECTIONS = 180
GRID = (-2.0, -2.0, 0.1, 40, 40)


def room_table():
    """Levels in the empty square |x|, |y| < 2, exactly, and the ranges themselves."""
    middles = -1.95 + 0.1 * np.arange(40)
    angles = math.tau * np.arange(DIRECTIONS) / DIRECTIONS

    def reach(ways):
        """How far it is to the walls across the ways, from each middle by each way."""
        ways = np.where(np.abs(ways) > 1e-9, ways, 1e-9)  # along a wall: the other wall is met first
        return (np.where(ways > 0.0, 2.0, -2.0) - middles[:, np.newaxis]) / ways

    across, up = reach(np.cos(angles)), reach(np.sin(angles))
    ranges = np.minimum(across[:, np.newaxis], up).reshape(-1, DIRECTIONS)
    levels = np.round(np.log(ranges / 0.1) / kernel.LOG_STEP) + kernel.LOG_ZERO
    return np.clip(levels, 0, 255).astype(np.uint8), ranges


LEVELS, RANGES = room_table()
STEEP = -np.abs(np.arange(-400, 401) * kernel.LOG_STEP).astype(np.float32)  # -|e| ...
CLASSES = np.stack([STEEP, 2.0 * STEEP])  # ... and twice that for readings of the second class


def plain_sum(state, beams, ranges):
    """The definition, in metres and radians: sum of -|log(predicted / measured)|, the second class twice."""
    x, y, heading, log_scale, p, q = state
    cell = 40 * math.floor((x + 2) / 0.1) + math.floor((y + 2) / 0.1)
    values, vectors = np.linalg.eigh([[p, q], [q, -p]])
    stretch = vectors @ np.diag(np.exp(values)) @ vectors.T
    score = 0.0
    for k, (beam, measured) in enumerate(zip(beams, ranges, strict=True)):
        angle = heading + beam * math.tau / kernel.HEADINGS
        vector = math.exp(log_scale) * stretch @ (math.cos(angle), math.sin(angle))
        direction = round(math.atan2(vector[1], vector[0]) / math.tau * DIRECTIONS) % DIRECTIONS
        score -= (1 + k % 2) * abs(math.log(RANGES[cell, direction] / math.hypot(*vector) / measured))
    return score


def sums_of(states, scan, no_return=(0, 0.0), outside=-1.0):
    """Sum over the beams of one scan, taken at the states."""
    still, whole, starts = np.zeros((1, 3)), np.ones(1), np.array([0, len(scan[0])])
    tables = kernel.stretch_tables(DIRECTIONS)
    sums, crossings = kernel.sum_over_beams(
        states, still, whole, starts, scan, LEVELS, GRID, tables, CLASSES, no_return, outside, 1
    )
    assert not crossings.any()
    return sums


@settings(max_examples=40)
@given(
    place=st.tuples(st.floats(-1.9, 1.9), st.floats(-1.9, 1.9)),
    heading=st.floats(-7.0, 7.0),
    log_scale=st.floats(-1.0, 1.0),
    stretch=st.tuples(st.sampled_from([-0.4, 0.0, 0.2]), st.sampled_from([-0.2, 0.0, 0.6])),
    ranges=st.lists(st.floats(0.3, 5.0), min_size=1, max_size=20),
)
def test_sums_follow_the_definition(place, heading, log_scale, stretch, ranges):
    beams = np.arange(len(ranges), dtype=np.int32) * 11 % kernel.HEADINGS
    heading = round(heading / math.tau * kernel.HEADINGS) * math.tau / kernel.HEADINGS
    state = np.array([*place, heading, log_scale, *stretch])
    levels = np.round(np.log(ranges) / kernel.LOG_STEP).astype(np.int32)

    classes = np.arange(len(ranges), dtype=np.int32) % 2
    score = sums_of(state[:, np.newaxis], (beams, levels, classes))[0]

    # four lengths are rounded to whole steps, and a direction may fall to either side of a half step
    assert abs(score - plain_sum(state, beams, ranges)) <= classes.size * 2 * (2 * kernel.LOG_STEP + 0.05)


def score_one(x, levels, no_return=(0, -3.0)):
    state = np.array([[x], [0.01], [0.0], [0.0], [0.0], [0.0]])
    beams = np.zeros(len(levels), np.int32)
    levels = np.array(levels, np.int32)
    return sums_of(state, (beams, levels, np.zeros_like(beams)), no_return, outside=-5.0)[0]


@given(st.integers(0, 1000), st.integers(1, 5))
def test_scans_along_a_way_add_up(seed, count):
    rng = np.random.default_rng(seed)
    states = rng.normal(0.0, [[0.9], [0.9], [2.0], [0.3], [0.3], [0.3]], (6, 30))
    motions = rng.normal(0.0, 1.0, (count, 3)) * (np.arange(count) > 0)[:, np.newaxis]
    weights = rng.random(count)
    scans = []
    for size in rng.integers(0, 10, count):
        levels = rng.integers(-40, 40, size)
        levels[rng.random(size) < 0.2] = kernel.NO_RETURN
        scans.append([rng.integers(0, kernel.HEADINGS, size), levels, rng.integers(0, 2, size)])
    scans = [tuple(column.astype(np.int32) for column in scan) for scan in scans]
    starts = np.cumsum([0, *(len(scan[0]) for scan in scans)])
    joined = tuple(np.concatenate(column) for column in zip(*scans, strict=True))
    tables = kernel.stretch_tables(DIRECTIONS)

    sums, crossings = kernel.sum_over_beams(
        states, motions, weights, starts, joined, LEVELS, GRID, tables, CLASSES, (20, -3.0), -5.0, 1
    )

    expected, crossed, later = np.zeros(30), np.zeros(30), states[:2]
    for k, (x, y, turn) in enumerate(motions):
        then = states.copy()
        then[:2] += displace(states, np.full(30, x), np.full(30, y))
        then[2] += turn
        expected += weights[k] * sums_of(then, scans[k], (20, -3.0), -5.0)
        crossed += (k > 0) & kernel.cross_walls(then[:2].copy(), later - then[:2], LEVELS, GRID, 1)
        later = then[:2]
    np.testing.assert_allclose(sums, expected, atol=1e-9)
    np.testing.assert_array_equal(crossings, crossed)


def test_a_particle_off_the_drawing_pays_for_every_beam():
    assert -10.0 == score_one(3.0, [0, 0])


def test_no_return_costs_where_a_wall_is_near_and_only_there():
    two_meters = round(math.log(2.0) / kernel.LOG_STEP)

    assert -3.0 == score_one(0.01, [kernel.NO_RETURN], (two_meters + 2, -3.0))
    assert 0.0 == score_one(0.01, [kernel.NO_RETURN], (two_meters - 2, -3.0))


def test_no_stretch_turns_and_lengthens_nothing():
    turned, lengthened = kernel.stretch_tables(kernel.HEADINGS)
    middle = kernel.STRETCHES // 2

    assert (np.arange(2 * kernel.HEADINGS) % kernel.HEADINGS == turned[middle, middle]).all()
    assert (lengthened[middle, middle] == 0).all()


def test_a_step_through_a_wall_crosses_it():
    starts = np.array([[0.0, 0.0, 1.5, 5.0], [0.0, 0.0, 0.0, 0.0]])
    steps = np.array([[1.8, 2.5, 1.0, 0.1], [0.0, 0.0, 0.0, 0.0]])

    crossing = kernel.cross_walls(starts, steps, LEVELS, GRID, 1)

    assert [False, True, True, True] == crossing.tolist()
