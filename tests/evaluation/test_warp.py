import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from buildings import flat
from pilotage.errors import FileError
from pilotage.evaluation.rooms import read_drawn_rooms, read_world_rooms
from pilotage.evaluation.warp import Warp, read_warp
from pilotage.geometry import Pose2
from pilotage.io import open_map
from shared_data import SKETCHES, needs_sketches

DRAWINGS = sorted(
    path for path in SKETCHES.glob("*/*.json") if path.stem in {"draftsman", "quick", "schematic"}
)
GRID = np.array([(x, y) for x in (0.0, 4.0, 9.0, 15.0) for y in (0.0, 5.0, 8.0)])

scales = st.floats(0.1, 30.0)
angles = st.floats(-math.pi, math.pi)
seeds = st.integers(0, 2**32 - 1)


def bent(seed, scale=7.0):
    """Draw the grid by hand: every point up to a metre off."""
    off = np.random.default_rng(seed).uniform(-1.0, 1.0, GRID.shape)
    return Warp(GRID, scale * (GRID + off))


@given(seeds)
def test_control_points_are_carried_exactly(seed):
    warp = bent(seed)

    np.testing.assert_allclose(warp.sketch_from_world(warp.in_world), warp.in_sketch, atol=1e-9)
    np.testing.assert_allclose(warp.world_from_sketch(warp.in_sketch), warp.in_world, atol=1e-9)


@given(seeds, st.lists(st.tuples(st.floats(0.0, 15.0), st.floats(0.0, 8.0)), min_size=1, max_size=20))
def test_there_and_back_is_where_one_was(seed, points):
    warp = bent(seed)

    there = warp.sketch_from_world(np.array(points))

    np.testing.assert_allclose(warp.world_from_sketch(there), points, atol=1e-9)


@given(scales, angles, angles)
def test_a_true_drawing_is_a_similarity_everywhere(scale, turn, heading):
    sketch_from_world = Pose2(30.0, -8.0, turn)
    warp = Warp(GRID, sketch_from_world @ (scale * GRID))

    found = warp.sketch_from_base(Pose2(-3.0, 20.0, heading))

    expected = sketch_from_world @ Pose2(-3.0 * scale, 20.0 * scale, heading)
    assert math.isclose(scale, found.scale, rel_tol=1e-9)
    np.testing.assert_allclose(found.pose.position, expected.position, atol=1e-6)
    assert abs((expected.inverse() @ found.pose).theta) < 1e-9


def test_flat_triangles_along_a_wall_are_left_out():
    along_a_wall = np.array([(0.0, 0.0), (5.0, -0.1), (10.0, 0.0), (5.0, 6.0)])

    warp = Warp(along_a_wall, along_a_wall * (1.0, 3.0))

    assert 2 == len(warp.corners)


def test_a_triangle_that_the_drawing_folds_over_leads_nowhere_back():
    folded = GRID.copy()
    folded[4] = GRID[4] + (30.0, 0.0)  # an inner point, far outside

    warp = Warp(GRID, folded)

    assert len(warp.back.maps) < len(warp.there.maps)


@pytest.mark.parametrize(
    ("in_world", "in_sketch", "message"),
    [
        (GRID, GRID[1:], "must come in pairs"),
        (GRID[:2], GRID[:2], "at least 3"),
        (GRID[:3], GRID[:3], "must span"),  # on one line
    ],
)
def test_control_points_that_carry_nothing_are_refused(in_world, in_sketch, message):
    with pytest.raises(ValueError, match=message):
        Warp(in_world, in_sketch)


@pytest.mark.parametrize(
    "content", ["{}", '{"control_points": [{"world": [0, 0]}]}', '{"control_points": []}']
)
def test_a_file_without_control_points_is_named(tmp_path, content):
    (tmp_path / "quick.json").write_text(content)

    with pytest.raises(FileError, match=r"quick\.json"):
        read_warp(tmp_path / "quick.json", flat())


def test_points_of_a_file_are_turned_up(tmp_path):
    pairs = [{"world": [x, y], "sketch": [2 * x, -2 * y]} for x, y in GRID.tolist()]
    (tmp_path / "quick.json").write_text(json.dumps({"control_points": pairs}))
    (tmp_path / "quick.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0 H30 V-16"/></svg>'
    )

    warp = read_warp(tmp_path / "quick.json", open_map(tmp_path / "quick.svg"))

    np.testing.assert_allclose(warp.in_sketch, 2.0 * GRID)


@needs_sketches
@pytest.mark.parametrize("path", DRAWINGS, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_rooms_are_carried_to_where_they_are_drawn(path):
    sketch = open_map(path.with_suffix(".svg"))
    drawn = read_drawn_rooms(path)
    rooms = read_world_rooms(path.parent / "rooms.geojson")
    warp = read_warp(path, sketch)
    middles = {
        name: (polygon.representative_point().x, polygon.representative_point().y)
        for name, polygon in zip(rooms.names, rooms.polygons, strict=True)
        if name in drawn.names
    }

    on_sheet = warp.sketch_from_world(np.array(list(middles.values())))

    found = drawn.names_at(sketch.file_from_sketch(on_sheet))
    assert np.mean([name == other for name, other in zip(middles, found, strict=True)]) >= 0.8
    there_and_back = warp.world_from_sketch(on_sheet) - list(middles.values())
    assert np.median(np.hypot(*there_and_back.T)) < 1e-6
