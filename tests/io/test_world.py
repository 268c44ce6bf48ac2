"""Worlds from files, in metres."""

import numpy as np
import pytest
from PIL import Image

from pilotage.errors import FileError
from pilotage.geometry import Pose2
from pilotage.io import open_world

UNKNOWN, FREE, WALL = 205, 254, 0
ORIGIN = Pose2(-3.0, 5.0, 0.3)


def saved_map(folder, pixels, origin="[-3.0, 5.0, 0.3]", **entries):
    Image.fromarray(np.asarray(pixels, dtype=np.uint8)).save(folder / "map.png")
    values = {"image": "map.png", "resolution": 0.05, "origin": origin, **entries}
    path = folder / "map.yaml"
    path.write_text("".join(f"{key}: {value}\n" for key, value in values.items() if value is not None))
    return path


def rooms():
    """A room of 40 x 20 pixels with a pillar, in ground that no one has seen."""
    pixels = np.full((40, 60), UNKNOWN)
    pixels[9:31, 9:51] = WALL
    pixels[10:30, 10:50] = FREE
    pixels[18:20, 30:34] = WALL
    return pixels


def test_a_map_is_as_large_as_it_says_and_lies_where_it_says(tmp_path):
    world = open_world(saved_map(tmp_path, rooms()))
    inside = ORIGIN.inverse() @ world.segments.reshape(-1, 2)

    assert 8 == len(world.segments)
    np.testing.assert_allclose([10 * 0.05, 10 * 0.05], inside.min(axis=0))
    np.testing.assert_allclose([50 * 0.05, 30 * 0.05], inside.max(axis=0))
    np.testing.assert_allclose([2.5 - 1.7], world.ranges(ORIGIN @ np.array([[1.7, 0.6]]), np.array([0.3])))
    np.testing.assert_allclose(
        [1.0 - 0.6], world.ranges(ORIGIN @ np.array([[1.6, 0.6]]), np.array([0.3 + np.pi / 2]))
    )


@pytest.mark.parametrize(
    ("entries", "rule"),
    [
        ({"image": None}, "must name an image"),
        ({"image": "nowhere.png"}, "exists"),
        ({"resolution": None}, "resolution as a number"),
        ({"resolution": 0}, "resolution > 0"),
        ({"resolution": "fine"}, "resolution as a number"),
        ({"origin": "[0, 0]"}, "origin as"),
        ({"origin": "[0, 0, nan]"}, "origin as"),
        ({"free_thresh": "low"}, "free_thresh as a number"),
        ({"negate": 1}, "free space"),
    ],
)
def test_a_broken_map_is_refused(tmp_path, entries, rule):
    with pytest.raises(FileError, match=rule):
        open_world(saved_map(tmp_path, np.where(rooms() == FREE, 254, 150), **entries))


def test_a_map_without_free_space_is_refused(tmp_path):
    with pytest.raises(FileError, match="free space"):
        open_world(saved_map(tmp_path, np.full((9, 9), UNKNOWN)))


def test_a_drawing_is_taken_in_metres_with_y_up(tmp_path):
    (tmp_path / "room.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">'
        '<rect x="1" y="2" width="4" height="3" fill="none" stroke="black"/></svg>'
    )

    assert (1.0, -5.0, 5.0, -2.0) == open_world(tmp_path / "room.svg").bounds
