"""Worlds from files, in metres."""

import numpy as np
import pytest
from PIL import Image

from pilotage.errors import FileError
from pilotage.geometry import Pose2
from pilotage.io import open_map, open_world

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


@pytest.mark.parametrize("image", ["/home/someone/maps/map.png", r"C:\maps\map.png", "../maps/map.png"])
def test_the_picture_of_a_map_that_was_moved_is_found_beside_it(tmp_path, image):
    assert 8 == len(open_world(saved_map(tmp_path, rooms(), image=image)).segments)


def test_the_origin_may_be_listed_line_by_line(tmp_path):
    listed = open_world(saved_map(tmp_path, rooms(), origin="\n- -3.0\n- 5.0\n- 0.3"))

    np.testing.assert_array_equal(open_world(saved_map(tmp_path, rooms())).segments, listed.segments)


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


@pytest.mark.parametrize("threshold", [0.196, 0.25])
def test_cells_that_no_one_has_seen_are_solid_whatever_the_threshold(tmp_path, threshold):
    world = open_world(saved_map(tmp_path, rooms(), free_thresh=threshold))

    assert 8 == len(world.segments)


@pytest.mark.parametrize(
    ("entries", "rule"),
    [
        ({"image": None}, "must name an image"),
        ({"image": "nowhere.png"}, "there is no such file"),
        ({"resolution": None}, "resolution as a number"),
        ({"resolution": 0}, "resolution > 0"),
        ({"resolution": 1e308}, "at most 100 m, got 1e\\+308"),
        ({"origin": "[1e308, 0, 0]"}, "origin as"),
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


def drawn_world(folder, body, walls='<rect width="20" height="10" fill="none" stroke="black"/>'):
    path = folder / "world.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 10">{walls}{body}</svg>')
    return path


LINE = 'fill="none" stroke="gray" stroke-width="0.1"'


def test_things_of_a_drawn_world_are_what_they_are_called(tmp_path):
    world = open_world(
        drawn_world(
            tmp_path,
            f'<rect id="table" class="furniture" x="1" y="1" width="2" height="1" fill="brown"/>'
            f'<line class="glass" x1="5" y1="0" x2="5" y2="4" {LINE}/>'
            f'<g class="doors" data-closed="10-40.5, 100-"><line x1="5" y1="4" x2="5" y2="5" {LINE}/></g>'
            f'<line id="door-2" data-closed="always" x1="8" y1="4" x2="8" y2="5" {LINE}/>'
            f'<polyline class="person" data-speed="1.3" points="1,6 9,6 9,8" {LINE}/>'
            f'<g id="people"><polygon points="12,2 18,2 18,8" {LINE}/></g>'
            '<circle id="start" cx="2" cy="5" r="0.3" fill="green" data-heading="90"/>'
            '<text x="3" y="3">hall</text><rect class="ignore" x="9" y="1" width="1" height="1"/>',
        )
    )

    assert 8 == len(world.segments)
    assert [[5.0, 0.0, 5.0, -4.0]] == world.glass.tolist()
    assert [[5.0, -4.0, 5.0, -5.0], [8.0, -4.0, 8.0, -5.0]] == [door.segment.tolist() for door in world.doors]
    assert [((10.0, 40.5), (100.0, np.inf)), ((0.0, np.inf),)] == [door.closed for door in world.doors]
    assert [1.3, 1.0] == [person.speed for person in world.people]
    assert [False, True] == [person.path.closed for person in world.people]
    assert [[1.0, -6.0], [9.0, -6.0], [9.0, -8.0]] == world.people[0].path.vertices.tolist()
    assert Pose2(2.0, -5.0, np.pi / 2) == world.start


def test_a_world_opened_as_a_drawing_shows_the_building_alone(tmp_path):
    sketch = open_map(
        drawn_world(
            tmp_path,
            f'<line class="glass" x1="5" y1="0" x2="5" y2="4" {LINE}/>'
            f'<line class="door" data-closed="10-40" x1="5" y1="4" x2="5" y2="5" {LINE}/>'
            f'<line class="door" data-closed="always" x1="8" y1="4" x2="8" y2="5" {LINE}/>'
            f'<line class="door" x1="9" y1="4" x2="9" y2="5" {LINE}/>'
            f'<polyline class="person" points="1,6 9,6 9,8" {LINE}/>'
            '<g id="doors"><text x="3" y="3">hall</text></g>',
        )
    )

    assert [5.0, 8.0] == [float(stroke.vertices[0, 0]) for stroke in sketch.strokes if not stroke.closed]
    assert ["hall"] == [label.text for label in sketch.labels]


@pytest.mark.parametrize(
    ("body", "rule"),
    [
        (f'<line class="door" data-closed="noon" x1="5" y1="4" x2="5" y2="5" {LINE}/>', "data-closed must"),
        (
            f'<line class="door" data-closed="9-3" x1="5" y1="4" x2="5" y2="5" {LINE}/>',
            "close before it opens",
        ),
        (f'<line class="person" data-speed="fast" x1="5" y1="4" x2="5" y2="5" {LINE}/>', "data-speed must"),
        (f'<line class="person" data-speed="-1" x1="5" y1="4" x2="5" y2="5" {LINE}/>', "speed must be > 0"),
        ('<circle id="start" cx="2" cy="5" r="0.3" data-heading="north"/>', "data-heading must"),
        ('<circle id="start" cx="2" cy="5" r="0.3" data-heading="inf"/>', "finite"),
    ],
)
def test_a_drawn_world_that_cannot_be_meant_is_refused(tmp_path, body, rule):
    with pytest.raises(FileError, match=rule) as caught:
        open_world(drawn_world(tmp_path, body))

    assert str(caught.value).endswith("world.svg")


def test_a_drawn_world_without_walls_or_too_small_for_any_robot_is_refused(tmp_path):
    with pytest.raises(FileError, match="visible wall"):
        open_world(drawn_world(tmp_path, "", walls='<line class="glass" x2="9" stroke="black"/>'))
    with pytest.raises(FileError, match="room for a disc"):
        open_world(drawn_world(tmp_path, "", walls='<rect width="0.1" height="0.1"/>'))
