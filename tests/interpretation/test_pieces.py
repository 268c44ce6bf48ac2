"""Fewer pieces of lines say the same as all of them."""

import numpy as np
import shapely
from hypothesis import given
from hypothesis import strategies as st

from pilotage.interpretation.pieces import joined, on_grid, straight, without_scribble

GRAIN = 1e-3

PLACES = st.integers(0, 6)

PIECES = st.lists(
    st.tuples(st.sampled_from([(1, 0), (0, 1), (1, 1), (1, -1), (2, 1)]), PLACES, PLACES, PLACES, PLACES),
    min_size=1,
    max_size=30,
).map(
    lambda found: np.array(
        [
            [(x + first * dx, y + first * dy), (x + last * dx, y + last * dy)]
            for (dx, dy), x, y, first, last in found
        ],
        dtype=np.float64,
    )
)


def drawn(ends: np.ndarray) -> shapely.Geometry:
    """Put pieces together."""
    return shapely.union_all(shapely.linestrings(ends)) if len(ends) else shapely.LineString()


@given(PIECES)
def test_joined_pieces_cover_the_same_points(ends: np.ndarray) -> None:
    """Nothing is added or lost, and no two of them overlap."""
    ends = ends[(ends[:, 0] != ends[:, 1]).any(axis=1)]
    whole, fewer = drawn(ends), joined(ends, GRAIN)
    assert shapely.hausdorff_distance(whole, drawn(fewer)) <= GRAIN or whole.is_empty
    assert np.isclose(shapely.length(shapely.linestrings(fewer)).sum() if len(fewer) else 0.0, whole.length)
    assert len(joined(fewer, GRAIN)) == len(fewer)


def test_pieces_of_parallel_lines_are_not_joined() -> None:
    """Nor are those of one line with a gap between them."""
    ends = np.array([[[0.0, 0.0], [1.0, 0.0]], [[1.0, 0.1], [2.0, 0.1]], [[1.2, 0.0], [2.0, 0.0]]])
    assert len(joined(ends, GRAIN)) == 3


def test_lines_are_taken_apart_at_their_vertices() -> None:
    """Also those within collections, and no piece leads from one line to the next."""
    lines = shapely.from_wkt("GEOMETRYCOLLECTION (LINESTRING (0 0, 1 0, 1 1), MULTILINESTRING ((5 5, 6 6)))")
    assert straight(lines).tolist() == [[[0, 0], [1, 0]], [[1, 0], [1, 1]], [[5, 5], [6, 6]]]


def test_on_a_grid_a_line_drawn_twice_is_one_piece() -> None:
    """Whichever way it was drawn; and what becomes a point is none."""
    ends = np.array([[[0.0, 0.01], [1.0, 0.0]], [[1.02, 0.0], [0.0, 0.0]], [[3.0, 3.0], [3.01, 3.0]]])
    assert on_grid(ends, 0.25).tolist() == [[[0.0, 0.0], [1.0, 0.0]]]


def test_of_a_scribble_one_piece_a_square_is_left() -> None:
    """Long pieces all stay."""
    ends = np.array([[[0.1, 0.1], [0.2, 0.2]], [[0.3, 0.1], [0.2, 0.1]], [[0.0, 0.0], [5.0, 0.0]]])
    assert without_scribble(ends, 1.0).tolist() == [ends[2].tolist(), ends[0].tolist()]
