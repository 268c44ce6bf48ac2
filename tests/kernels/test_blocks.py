import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from pilotage.kernels import blocks as kernel

ROWS, SECTORS = 64, 12


def plain_keys(states, left, bottom, size):
    """The definition, for all particles at once."""
    column = np.clip(np.floor((states[0] - left) / size) + 2, 0, ROWS - 2).astype(int)
    row = np.clip(np.floor((states[1] - bottom) / size) + 2, 0, ROWS - 2).astype(int)
    sector = np.floor(states[2] % math.tau / math.tau * SECTORS).astype(int) % SECTORS
    return (column * ROWS + row) * SECTORS + sector


@given(st.integers(0, 1000), st.integers(1, 400), st.floats(0.1, 100.0))
def test_each_particle_is_in_its_block(seed, count, spread):
    states = np.random.default_rng(seed).normal(0.0, spread, (6, count))

    keys, numbers = kernel.number_blocks(states, -1.0, 2.0, 0.7, ROWS, SECTORS)

    np.testing.assert_array_equal(keys[numbers], plain_keys(states, -1.0, 2.0, 0.7))
    assert len(keys) == len(set(keys.tolist()))


@given(st.integers(0, 1000), st.integers(1, 300), st.integers(3, 40))
def test_blocks_side_by_side_are_connected(seed, count, extent):
    rng = np.random.default_rng(seed)
    column, row = rng.integers(0, min(extent, ROWS - 1), (2, count))
    sector = rng.integers(0, SECTORS, count)
    keys = np.unique((column * ROWS + row) * SECTORS + sector)

    labels = kernel.connect_blocks(keys, ROWS, SECTORS)

    column, row, sector = keys // SECTORS // ROWS, keys // SECTORS % ROWS, keys % SECTORS
    column, row, sector = (np.abs(one[:, np.newaxis] - one) for one in (column, row, sector))
    beside = (column <= 1) & (row <= 1) & ((sector <= 1) | (sector == SECTORS - 1))
    np.testing.assert_array_equal(labels, connected_components(coo_matrix(beside), directed=False)[1])


def test_no_blocks_have_no_components():
    assert [] == kernel.connect_blocks(np.empty(0, np.int64), ROWS, SECTORS).tolist()
