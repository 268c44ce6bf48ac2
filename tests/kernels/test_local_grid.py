import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import grid_oracles
from pilotage.kernels.local_grid import DEAREST, DIAGONAL, STRAIGHT, UNREACHED, clearances, flood, mark

FEW = 6
"""So many scans may pass through something that walked away before it is forgotten."""


@st.composite
def grids(draw, most=14):
    """Evidence of every kind on a small grid, a third of it occupied at most."""
    shape = draw(st.integers(1, most)), draw(st.integers(1, most))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    occupied, unseen = draw(st.floats(0.0, 0.3)), draw(st.floats(0.0, 0.3))
    kinds = rng.choice([1, 0, -1], p=[occupied, unseen, 1.0 - occupied - unseen], size=shape)
    return np.where(kinds > 0, rng.integers(1, 5, shape), kinds).astype(np.int8)


def beams(*rows):
    """Directions, ranges and whether something stands at the end, from rows of these."""
    directions, ranges, returned = zip(*rows, strict=True)
    return np.array(directions, dtype=float), np.array(ranges, dtype=float), np.array(returned, dtype=bool)


@given(grids(), st.integers(1, 20))
def test_clearances_are_the_distances_to_the_nearest_occupied_cell(evidence, farthest):
    expected = grid_oracles.clearances(evidence, farthest)

    np.testing.assert_allclose(expected, clearances(evidence, farthest), rtol=1e-6)


@given(grids(), st.data())
def test_ways_cost_what_a_plain_search_finds(evidence, data):
    start = tuple(data.draw(st.integers(0, size - 1)) for size in evidence.shape)
    tight = data.draw(st.floats(0.5, 2.5))
    easy, freed = tight + data.draw(st.floats(0.1, 3.0)), data.draw(st.floats(0.0, 5.0))
    clearance = clearances(evidence, 6)

    costs, _ = flood(evidence, clearance, start, tight, easy, freed)

    expected = np.full(evidence.shape, UNREACHED)
    found = grid_oracles.cheapest_costs(
        evidence,
        clearance,
        start,
        tight=tight,
        easy=easy,
        freed=freed,
        prices=(STRAIGHT, DIAGONAL, DEAREST),
    )
    for cell, cost in found.items():
        expected[cell] = cost
    np.testing.assert_array_equal(expected, costs)


@given(grids(), st.data())
def test_what_comes_before_is_a_neighbor_that_costs_less_down_to_the_start(evidence, data):
    start = tuple(data.draw(st.integers(0, size - 1)) for size in evidence.shape)
    costs, before = flood(evidence, clearances(evidence, 6), start, 1.0, 3.0, 2.0)

    reached = costs < UNREACHED
    assert [start] == [tuple(cell) for cell in np.argwhere(reached & (before < 0))]
    assert (before[~reached] == -1).all()
    for cell in map(tuple, np.argwhere(reached & (before >= 0)).tolist()):
        previous = divmod(int(before[cell]), evidence.shape[1])
        assert 1 == max(abs(a - b) for a, b in zip(cell, previous, strict=True))
        assert costs[previous] < costs[cell]


def test_in_the_open_a_way_costs_its_length():
    free = np.full((30, 30), -1, np.int8)
    costs, _ = flood(free, clearances(free, 9), (3, 3), 1.0, 5.0, 0.0)

    assert 20 * STRAIGHT == costs[23, 3]
    assert 20 * DIAGONAL == costs[23, 23]


def test_a_robot_that_stands_at_a_wall_gets_away_from_it_and_not_along_it():
    evidence = np.full((30, 30), -1, np.int8)
    evidence[0] = 4

    costs, _ = flood(evidence, clearances(evidence, 9), (1, 15), 3.0, 6.0, 5.0)

    assert costs[20, 15] < UNREACHED
    assert (costs[1:3, :9] == UNREACHED).all()


def test_a_beam_frees_what_it_passes_and_fills_where_it_ends():
    evidence = np.zeros((12, 3), np.int8)
    mark(evidence, (1.5, 1.5), *beams((0.0, 7.0, True)))

    assert (evidence[1:8, 1] < 0).all()
    assert evidence[8, 1] > 0
    assert (evidence[9:] == 0).all()
    assert (evidence[:, [0, 2]] == 0).all()


def test_a_beam_that_met_nothing_fills_nothing():
    evidence = np.zeros((12, 3), np.int8)
    mark(evidence, (1.5, 1.5), *beams((0.0, 7.0, False)))

    assert (evidence[1:7, 1] < 0).all()
    assert not (evidence > 0).any()


origins = st.tuples(st.floats(0.0, 13.9), st.floats(0.0, 13.9))
rays = st.tuples(st.floats(-math.pi, math.pi), st.floats(0.0, 25.0), st.booleans())


@given(grids(), origins, st.lists(rays, min_size=1, max_size=30))
def test_a_scan_never_clears_what_it_hit_and_frees_only_what_a_beam_crossed(evidence, origin, rows):
    known, (directions, ranges, returned) = evidence.copy(), beams(*rows)
    mark(evidence, origin, directions, ranges, returned)

    units = np.column_stack([np.cos(directions), np.sin(directions)])
    ends = np.floor(origin + ranges[:, np.newaxis] * units).astype(int)[returned]
    on_grid = ((ends >= 0) & (ends < evidence.shape)).all(axis=1)
    assert (evidence[tuple(ends[on_grid].T)] > 0).all()
    crossed = np.zeros(evidence.shape, dtype=bool)
    for unit, length in zip(units, ranges, strict=True):
        cells = np.floor(origin + np.linspace(0.0, length, 2001)[:, np.newaxis] * unit).astype(int)
        cells = cells[((cells >= 0) & (cells < evidence.shape)).all(axis=1)]
        crossed[tuple(cells.T)] = True
    assert (evidence == known)[~crossed].all()


def test_what_walked_away_is_forgotten_after_a_few_scans():
    evidence = np.zeros((12, 3), np.int8)
    for _ in range(50):
        mark(evidence, (1.5, 1.5), *beams((0.0, 5.0, True)))
    for _ in range(FEW):
        mark(evidence, (1.5, 1.5), *beams((0.0, 9.0, True)))

    assert evidence[6, 1] < 0
    assert evidence[10, 1] > 0


@pytest.mark.parametrize("count", [1, 200])
def test_one_scan_does_not_clear_a_wall_however_many_beams_graze_it(count):
    evidence = np.zeros((12, 3), np.int8)
    for _ in range(3):
        mark(evidence, (1.5, 1.5), *beams((0.0, 5.0, True)))
    mark(evidence, (1.5, 1.5), *beams(*[(0.001 * k / count, 9.0, False) for k in range(count)]))

    assert evidence[6, 1] > 0


@settings(max_examples=20)
@given(st.integers(0, 300))
def test_evidence_stays_within_bounds_however_often_it_is_seen(times):
    evidence = np.zeros((12, 3), np.int8)
    for _ in range(times):
        mark(evidence, (1.5, 1.5), *beams((0.0, 5.0, True)))
        mark(evidence, (1.5, 1.5), *beams((math.pi / 2.0, 1.4, False)))

    assert (evidence[1:6, 1] <= 0).all()
    assert (0 < evidence[6, 1]) == (times > 0)
