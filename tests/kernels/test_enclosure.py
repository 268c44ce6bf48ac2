"""Which points contours enclose."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from shapely import Point, Polygon

from pilotage.kernels.enclosure import enclosed, enclosed_corners
from pilotage.kernels.segment_grid import build_grid
from strategies import star_shaped_outlines

UP, RIGHT = np.eye(2, dtype=int)  # rows and columns


def enclosed_by(segments, places):
    grid = build_grid(np.asarray(segments, dtype=np.float64))
    return enclosed(np.array(places, dtype=np.float64).reshape(-1, 2), grid, enclosed_corners(grid))


@given(
    outline=star_shaped_outlines(),
    places=st.lists(st.tuples(st.floats(-5, 5), st.floats(-5, 5)), min_size=1, max_size=20),
)
def test_a_contour_encloses_what_geometry_says(outline, places):
    segments = np.hstack([outline.ring[:-1], outline.ring[1:]])
    polygon = Polygon(outline.vertices)
    away = [place for place in places if polygon.exterior.distance(Point(place)) > 1e-9]
    expected = [polygon.contains(Point(place)) for place in away]

    assert expected == enclosed_by(segments, away).tolist()


@given(seed=st.integers(0, 10_000), size=st.sampled_from([0.05, 0.1, 0.3, 1.0]), share=st.floats(0.1, 0.9))
def test_cells_of_a_map_are_told_from_its_walls(seed, size, share):
    free = np.pad(np.random.default_rng(seed).random((14, 19)) < share, 1)
    level = [(x, y, x + 1, y) for y, x in np.argwhere(free[1:] != free[:-1]) + UP]
    upright = [(x, y, x, y + 1) for y, x in np.argwhere(free[:, 1:] != free[:, :-1]) + RIGHT]
    rows, columns = np.indices(free.shape)
    middles = np.column_stack([columns.ravel(), rows.ravel()]) + 0.5

    np.testing.assert_array_equal(free.ravel(), enclosed_by(size * np.array(level + upright), size * middles))
