from pathlib import Path

import numpy as np
import pytest
import shapely
from PIL import Image

from pilotage.errors import FileError
from pilotage.io import open_map
from pilotage.io.raster import Shading, read_picture, recognize
from pilotage.maps import DecompositionSettings, decompose

SHARED = Path(__file__).resolve().parents[2] / ".." / "shared" / "data"
GRAY, LIGHT, DARK = 205, 254, 0


def saved(path, pixels):
    Image.fromarray(np.asarray(pixels, dtype=np.uint8)).save(path)
    return path


def two_rooms(ground, wall, floor):
    """Two rooms of 40 x 50 pixels and a door, as a robot would map them."""
    pixels = np.full((80, 120), ground)
    pixels[12:68, 12:108] = wall
    pixels[15:65, 15:55] = floor
    pixels[15:65, 60:105] = floor
    pixels[30:40, 50:65] = floor
    return pixels


def pen_drawing(ink=(20, 30, 160), paper=(250, 245, 235)):
    pixels = np.full((200, 300, 3), paper)
    for rows, columns in [
        (slice(20, 23), slice(20, 280)),
        (slice(177, 180), slice(20, 280)),
        (slice(20, 180), slice(20, 23)),
        (slice(20, 180), slice(277, 280)),
        (slice(20, 80), slice(150, 153)),
        (slice(105, 180), slice(150, 153)),
    ]:
        pixels[rows, columns] = ink
    return pixels


@pytest.mark.parametrize(
    ("ground", "wall", "floor", "kind"),
    [
        (GRAY, DARK, LIGHT, Shading.LIGHT_IS_FREE),
        (DARK, DARK, 255, Shading.LIGHT_IS_FREE),
        (255, 255, DARK, Shading.DARK_IS_FREE),
    ],
)
def test_filled_plans_of_any_shading_show_the_same_rooms(tmp_path, ground, wall, floor, kind):
    path = saved(tmp_path / "plan.png", two_rooms(ground, wall, floor))
    graph = decompose(open_map(path), DecompositionSettings())

    assert kind is recognize(read_picture(path))
    assert 2 == len(graph.cells)
    assert 1 == len(graph.gateways)


@pytest.mark.parametrize(("ground", "wall"), [(255, DARK), (DARK, 255)])
def test_thick_walls_are_no_free_space(tmp_path, ground, wall):
    pixels = np.full((400, 600), ground)
    pixels[20:380, 20:580] = wall
    pixels[36:364, 36:292] = pixels[36:364, 308:564] = ground
    pixels[160:230, 292:308] = ground
    path = saved(tmp_path / "plan.png", pixels)
    graph = decompose(open_map(path), DecompositionSettings())

    assert Shading.LINES is recognize(read_picture(path))
    assert 2 == len(graph.cells)
    assert 1 == len(graph.gateways)


def test_free_space_lies_left_of_the_contours(tmp_path):
    pixels = np.full((60, 60), DARK)
    pixels[10:50, 10:50] = 255
    pixels[25:35, 25:35] = DARK
    sketch = open_map(saved(tmp_path / "plan.png", pixels))
    outer, block = sorted(sketch.strokes, key=lambda stroke: -stroke.length)

    assert sketch.contours
    assert shapely.LinearRing(outer.vertices).is_ccw
    assert not shapely.LinearRing(block.vertices).is_ccw


def test_pixels_become_units_with_y_up(tmp_path):
    pixels = np.full((60, 80), DARK)
    pixels[10:20, 30:50] = 255
    sketch = open_map(saved(tmp_path / "plan.png", pixels), shading="light-is-free")

    assert (30.0, -20.0, 50.0, -10.0) == pytest.approx(sketch.bounds, abs=0.51)
    assert sketch.y_down


@pytest.mark.parametrize("ink", [(20, 30, 160), (200, 30, 30), (20, 140, 40), (0, 0, 0)])
def test_a_pen_of_any_color_draws_walls(tmp_path, ink):
    path = saved(tmp_path / "sketch.png", pen_drawing(ink))
    graph = decompose(open_map(path), DecompositionSettings())

    assert Shading.LINES is recognize(read_picture(path))
    assert 2 == len(graph.cells)
    assert 1 == len(graph.gateways)


def test_a_light_pen_on_a_dark_board_draws_walls_too(tmp_path):
    path = saved(tmp_path / "board.png", pen_drawing((255, 255, 255), (10, 10, 10)))

    assert 2 == len(decompose(open_map(path), DecompositionSettings()).cells)


def test_uneven_light_on_paper_is_no_ink(tmp_path):
    light = np.linspace(0.6, 1.0, 300)[None, :, None]
    path = saved(tmp_path / "photo.png", pen_drawing((0, 0, 0)) * light)

    assert 2 == len(decompose(open_map(path, shading="lines"), DecompositionSettings()).cells)


def test_strokes_run_along_the_middle_of_the_ink(tmp_path):
    sketch = open_map(saved(tmp_path / "sketch.png", pen_drawing()), shading="lines")
    drawn = shapely.union_all([shapely.LineString(stroke.ring) for stroke in sketch.strokes])
    middle = shapely.box(21.5, -178.5, 278.5, -21.5).exterior

    assert drawn.buffer(1.5).covers(middle)
    assert len(sketch.strokes) < 12


def test_what_is_transparent_looks_like_the_edge(tmp_path):
    plan = two_rooms(DARK, DARK, 255)
    alpha = np.full(plan.shape, 255)
    alpha[:, :10] = 0
    path = saved(tmp_path / "plan.png", np.dstack([plan, plan, plan, alpha]))

    assert 2 == len(decompose(open_map(path), DecompositionSettings()).cells)


def test_a_map_server_file_says_what_is_free(tmp_path):
    saved(tmp_path / "map.pgm", two_rooms(GRAY, DARK, LIGHT))
    (tmp_path / "map.yaml").write_text(
        "image: map.pgm  # beside\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\n"
        "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )

    assert 2 == len(decompose(open_map(tmp_path / "map.yaml"), DecompositionSettings()).cells)


@pytest.mark.parametrize(
    ("negate", "is_negated"), [("1", True), ("true", True), ("false", False), ("No", False)]
)
def test_a_negated_map_server_file_turns_shades_round(tmp_path, negate, is_negated):
    shades = two_rooms(GRAY, DARK, LIGHT)
    saved(tmp_path / "map.png", 255 - shades if is_negated else shades)
    (tmp_path / "map.yml").write_text(f'image: "map.png"\nnegate: {negate}\nfree_thresh: 0.1\n')

    assert 2 == len(decompose(open_map(tmp_path / "map.yml"), DecompositionSettings()).cells)


@pytest.mark.parametrize(
    ("text", "rule"),
    [
        ("resolution: 0.05\n", "must name an image"),
        ("image: map.png\nfree_thresh: low\n", "must give free_thresh as a number"),
        ("image: none.png\n", "there is no such file"),
    ],
)
def test_a_broken_map_server_file_is_refused(tmp_path, text, rule):
    saved(tmp_path / "map.png", two_rooms(GRAY, DARK, LIGHT))
    (tmp_path / "map.yaml").write_text(text)

    with pytest.raises(FileError, match=rule):
        open_map(tmp_path / "map.yaml")


def test_pictures_that_show_nothing_are_refused(tmp_path):
    blank = saved(tmp_path / "blank.png", np.full((50, 50), 255))
    noise = tmp_path / "noise.png"
    noise.write_bytes(b"no picture")

    with pytest.raises(FileError, match="stroke, found none"):
        open_map(blank)
    with pytest.raises(FileError, match="cannot be read") as refused:
        open_map(noise)
    assert 1 == str(refused.value).count(str(noise))
    with pytest.raises(FileError, match="there is no such file"):
        open_map(tmp_path / "none.png")


@pytest.mark.skipif(not SHARED.exists(), reason="the shared drawings are not here")
@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("rooms/office_b.png", Shading.LIGHT_IS_FREE),
        ("rooms/lab_c_scan_furnitures.png", Shading.LIGHT_IS_FREE),
        ("people-sketches/04.png", Shading.LIGHT_IS_FREE),
        ("people-drawings/belgioioso/plan.png", Shading.DARK_IS_FREE),
        ("people-drawings/belgioioso/freehand.png", Shading.LINES),
        ("worlds/hospital_section.png", Shading.LINES),
    ],
)
def test_real_pictures_are_recognized(name, kind):
    assert kind is recognize(read_picture(SHARED / name))


def test_a_file_that_is_not_a_picture_is_never_handed_to_another_program(tmp_path, monkeypatch):
    def run(*_words, **_options):
        raise AssertionError("a program was started")

    monkeypatch.setattr("subprocess.Popen", run)
    path = tmp_path / "page.png"
    path.write_bytes(b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 9 9\n%%EndComments\nshowpage\n%%EOF\n")

    with pytest.raises(FileError, match="a PostScript drawing cannot be read"):
        open_map(path)
    with pytest.raises(FileError, match="a picture cannot be read"):
        read_picture(path)


def test_a_broken_chunk_of_a_png_is_refused(tmp_path):
    path = saved(tmp_path / "broken.png", np.zeros((40, 40)))
    content = path.read_bytes()
    at = content.index(b"IDAT")
    path.write_bytes(content[:at] + b"\0\0\0\0" + content[at + 4 :])

    with pytest.raises(FileError, match="a picture cannot be read"):
        open_map(path)


def test_a_picture_of_too_many_pixels_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr("pilotage.io.raster.MAX_PIXELS", 1000)

    with pytest.raises(FileError, match="pixels, got 40 x 40"):
        open_map(saved(tmp_path / "large.png", np.zeros((40, 40))))


def test_a_photo_is_read_as_its_camera_was_held(tmp_path):
    exif = Image.Exif()
    exif[0x0112] = 6  # turned by a quarter
    Image.fromarray(pen_drawing().astype(np.uint8)).save(tmp_path / "turned.jpg", exif=exif)

    assert (300, 200, 3) == read_picture(tmp_path / "turned.jpg").colors.shape
