"""Blocks of position and heading that hold particles, and which of them are connected.

A block has a column, a row and a sector of headings, and the key (column * rows + row) * sectors + sector.
"""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit

SPREAD = np.uint64(0x9E3779B97F4A7C15)  # Fibonacci hashing: neighboring keys fall far apart


@njit(cache=True)
def number_blocks(
    states: NDArray[np.float64], left: float, bottom: float, size: float, rows: int, sectors: int
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Find the blocks that hold particles and give each particle the number of its block, (k,) keys and (n,).

    Blocks have this size, and the one at the corner (left, bottom) has column and row 2. There are as many
    columns as `rows`, and what lies farther off shares the outermost. The last row and column stay empty, so
    that no block has neighbors on the far side. Columns of `states` (6, n) are as in
    kernels/visibility.py.
    """
    n, last = states.shape[1], rows - 2.0
    bits = 1
    while 1 << bits < 2 * n:
        bits += 1
    slots = np.full(1 << bits, -1)
    keys, numbers, count = np.empty(n, np.int64), np.empty(n, np.int64), 0
    for i in range(n):
        column = int(min(max(math.floor((states[0, i] - left) / size) + 2.0, 0.0), last))
        row = int(min(max(math.floor((states[1, i] - bottom) / size) + 2.0, 0.0), last))
        sector = math.floor(states[2, i] % math.tau / math.tau * sectors) % sectors
        key = (column * rows + row) * sectors + sector
        slot = (np.uint64(key) * SPREAD) >> np.uint64(64 - bits)
        while slots[slot] >= 0 and keys[slots[slot]] != key:
            slot = (slot + np.uint64(1)) & np.uint64((1 << bits) - 1)
        if slots[slot] < 0:
            slots[slot], keys[count] = count, key
            count += 1
        numbers[i] = slots[slot]
    return keys[:count], numbers


@njit(cache=True)
def connect_blocks(keys: NDArray[np.int64], rows: int, sectors: int) -> NDArray[np.int64]:
    """Give each block the number of its connected component, (k,); `keys` (k,) are sorted.

    Blocks are connected if neither column nor row nor sector differ by more than one; sectors go round.
    Components are numbered in the order of their first blocks.
    """
    count = len(keys)
    parents = np.arange(count)
    for ahead in (0, 1, rows - 1, rows, rows + 1):  # what is connected with a cell before was found there
        start = 0
        for i in range(count):
            sector = keys[i] % sectors
            first = keys[i] - sector + ahead * sectors
            while start < count and keys[start] < first:
                start += 1
            j = start
            while j < count and keys[j] < first + sectors:
                gap = abs(keys[j] - first - sector)
                if gap <= 1 or gap == sectors - 1:
                    one, other = root_of(parents, i), root_of(parents, j)
                    parents[max(one, other)] = min(one, other)
                j += 1
    labels, components = np.empty(count, np.int64), 0
    for i in range(count):
        root = root_of(parents, i)  # never after i
        labels[i] = labels[root] if root < i else components
        components += root == i
    return labels


@njit(cache=True)
def root_of(parents: NDArray[np.int64], i: int) -> int:
    """Follow parents to the end, and shorten the way there."""
    while parents[i] != i:
        parents[i] = parents[parents[i]]
        i = parents[i]
    return i
