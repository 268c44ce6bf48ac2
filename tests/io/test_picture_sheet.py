"""What becomes a mark of a picture: walls and doors; and what does not: words, ruled lines, floors."""

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays
from PIL import Image, ImageDraw, ImageFilter, ImageFont

from pilotage.io import open_map
from pilotage.io.picture import sheet_of
from pilotage.io.picture.arcs import Arc, fit_arc, with_leaf
from pilotage.io.picture.bars import part_bars
from pilotage.io.picture.ink import find_ink
from pilotage.io.picture.join import join_straight
from pilotage.io.picture.width import deeper_than, depth_of, fat_parts
from pilotage.maps import DecompositionSettings, decompose

WHITE, BLACK, BLUE, GREEN = (255, 255, 255), (0, 0, 0), (160, 190, 230), (140, 200, 160)


def paper(color=WHITE, size=(1200, 900)):
    picture = Image.new("RGB", size, color)
    return picture, ImageDraw.Draw(picture)


def colors_of(picture):
    return np.asarray(picture, dtype=np.float32) / np.float32(255.0)


def room(pen, width=5, fill=BLACK):
    pen.rectangle([200, 150, 1000, 750], outline=fill, width=width)


def length_of(sheet):
    return sum(outline.length for mark in sheet.marks for outline in mark.outlines)


def test_a_room_in_pen_is_lines_in_its_own_pixels_y_up():
    picture, pen = paper()
    room(pen)
    sheet = sheet_of(colors_of(picture))
    points = np.vstack([outline.vertices for mark in sheet.marks for outline in mark.outlines])

    assert sheet.y_down
    assert all(mark.pen is not None and mark.fill is None for mark in sheet.marks)
    np.testing.assert_allclose(points.min(axis=0), (202.5, -748.5), atol=2.0)
    np.testing.assert_allclose(points.max(axis=0), (998.5, -152.5), atol=2.0)


@pytest.mark.parametrize(
    "size", [(1200, 900), pytest.param((3000, 2250), marks=pytest.mark.slow), (600, 450)]
)
def test_a_unit_is_a_pixel_whatever_the_size(size):
    picture, pen = paper()
    room(pen, width=9)
    sheet = sheet_of(colors_of(picture.resize(size)))

    scale = size[0] / 1200
    assert pytest.approx(2.0 * (800 + 600) * scale, rel=0.03) == length_of(sheet)


def test_words_are_no_walls():
    picture, pen = paper()
    room(pen)
    alone = length_of(sheet_of(colors_of(picture)))
    pen.text((400, 400), "kitchen 12", fill=BLACK, font=ImageFont.load_default(36))
    sheet = sheet_of(colors_of(picture))

    assert pytest.approx(alone, rel=0.01) == length_of(sheet)
    assert any("words" in said for said in sheet.left_out)


def test_walls_in_a_color_stay_beside_thin_rings():
    picture, pen = paper()
    room(pen, width=9, fill=(82, 192, 242))
    for left in (1010, 300):
        pen.ellipse([left, 300, left + 160, 460], outline=(182, 232, 33), width=4)
    sheet = sheet_of(colors_of(picture))

    assert pytest.approx(2.0 * (800 + 600) + 2.0 * 160 * np.pi, rel=0.03) == length_of(sheet)


def test_a_word_that_has_run_together_is_no_wall():
    picture, pen = paper()
    room(pen)
    blur = ImageFilter.GaussianBlur(1.2)
    alone = length_of(sheet_of(colors_of(picture.filter(blur))))
    pen.text((400, 400), "Bath", fill=BLACK, font=ImageFont.load_default(16))
    sheet = sheet_of(colors_of(picture.filter(blur)))

    assert pytest.approx(alone, rel=0.01) == length_of(sheet)


@pytest.mark.parametrize(("words", "rooms"), [("store", 3), ("", 2)])
def test_a_closed_room_with_words_is_a_room(tmp_path, words, rooms):
    picture, pen = paper()
    room(pen)
    pen.rectangle([450, 350, 750, 550], outline=BLACK, width=5)
    for wall in ([(200, 450), (280, 450)], [(380, 450), (450, 450)], [(750, 450), (1000, 450)]):
        pen.line(wall, fill=BLACK, width=5)
    pen.text((550, 430), words, fill=BLACK, font=ImageFont.load_default(36))
    picture.save(tmp_path / "plan.png")
    sketch = open_map(tmp_path / "plan.png")

    assert rooms == len(decompose(sketch, DecompositionSettings()).cells)
    assert rooms == len(decompose(sketch.mirrored(), DecompositionSettings()).cells)


@pytest.mark.parametrize("squared", [False, True])
def test_ruled_and_squared_paper_is_no_ink(squared):
    picture, pen = paper()
    for y in range(0, 900, 40):
        pen.line([(0, y), (1200, y)], fill=BLUE, width=2)
    for x in range(0, 1200 if squared else 0, 40):
        pen.line([(x, 0), (x, 900)], fill=BLUE, width=2)
    room(pen)
    sheet = sheet_of(colors_of(picture))

    assert any("ruled" in said for said in sheet.left_out)
    assert pytest.approx(2.0 * (800 + 600), rel=0.03) == length_of(sheet)


def test_faint_lines_of_a_room_are_not_taken_for_ruling():
    picture, pen = paper()
    room(pen)
    pen.line([(600, 150), (600, 500)], fill=(150, 150, 150), width=4)

    assert not find_ink(colors_of(picture)).ruled
    assert find_ink(colors_of(picture)).mask[300, 600]


def test_thick_walls_beside_thin_lines_are_areas():
    picture, pen = paper()
    room(pen, width=16)
    pen.line([(600, 165), (600, 735)], fill=BLACK, width=3)
    sheet = sheet_of(colors_of(picture))
    (wall,) = [mark for mark in sheet.marks if mark.fill is not None]
    (line,) = [mark for mark in sheet.marks if mark.pen is not None]

    assert 2 == len(wall.outlines)
    assert sum(wall.fill) < 0.3
    assert pytest.approx(570.0, abs=20.0) == line.outlines[0].length


def test_the_color_of_a_narrow_floor_is_no_wall():
    picture, pen = paper()
    pen.rectangle([200, 300, 1000, 330], fill=GREEN)
    room(pen, width=16)
    sheet = sheet_of(colors_of(picture))

    assert all(max(mark.fill) < 0.5 for mark in sheet.marks if mark.fill is not None)


def test_a_door_is_a_smooth_arc_that_ends_at_its_leaf():
    picture, pen = paper()
    room(pen)
    pen.line([(400, 150), (400, 250)], fill=BLACK, width=5)
    pen.arc([300, 50, 500, 250], 0, 90, fill=BLACK, width=4)
    sheet = sheet_of(colors_of(picture))
    arcs = [line for mark in sheet.marks for line in mark.outlines if len(line) == 10]

    (arc,) = [line for line in arcs if line.length < 200.0]
    assert pytest.approx(150.0, abs=15.0) == arc.length
    strays = np.hypot(*(arc.vertices - (400.0, -150.0)).T) - 100.0
    assert np.abs(strays).max() < 4.0


def test_rooms_that_a_hand_draws_with_bends_are_lines_in_one_piece():
    picture, pen = paper()
    for x in range(150, 1000, 200):
        pen.arc([x, 300, x + 200, 500], 180, 270, fill=BLACK, width=5)
        pen.line([(x, 400), (x, 440), (x + 100, 440), (x + 100, 302)], fill=BLACK, width=5)

    assert 5 == len(sheet_of(colors_of(picture)).marks)


def test_a_leaf_is_found_where_ink_is():
    ink = np.zeros((200, 200), dtype=bool)
    ink[100:180, 99:102] = True
    arc = Arc((100.0, 100.0), 80.0, 0.0, np.deg2rad(70.0))

    assert pytest.approx(np.pi / 2, abs=0.1) == with_leaf(arc, ink).last
    assert not with_leaf(arc, np.zeros_like(ink)).has_leaf


@pytest.mark.parametrize("sweep", [60.0, 90.0, 120.0])
def test_a_circle_is_fitted_exactly(sweep):
    angles = np.deg2rad(np.linspace(20.0, 20.0 + sweep, 60))
    arc = fit_arc(np.column_stack([50.0 + 40.0 * np.cos(angles), 60.0 + 40.0 * np.sin(angles)]), 3.0, (5, 99))

    assert arc is not None
    assert pytest.approx((50.0, 60.0, 40.0), abs=1e-6) == (*arc.center, arc.radius)


def test_lines_go_on_across_a_fork_and_a_gap_of_the_pen_but_not_through_a_door():
    left, right = np.array([(0.0, 0.0), (50.0, 0.0)]), np.array([(52.0, 0.5), (100.0, 0.0)])
    beyond, stem = np.array([(130.0, 0.0), (200.0, 0.0)]), np.array([(51.0, 40.0), (51.0, 0.0)])
    joined = join_straight([left, right, beyond, stem], 3.0)

    assert [2, 2, 4] == sorted(map(len, joined))
    assert shapely.LineString(max(joined, key=len)).length == pytest.approx(100.0, abs=0.5)


def test_a_bar_on_a_thin_line_is_a_mark_of_its_own_and_bars_are_alike():
    picture, pen = paper()
    room(pen, width=2)
    pen.line([(600, 150), (600, 750)], fill=BLACK, width=2)
    pen.line([(600, 300), (600, 360)], fill=BLACK, width=5)
    pen.line([(300, 150), (360, 150)], fill=BLACK, width=6)
    sheet = sheet_of(colors_of(picture))
    width = min(mark.pen.width for mark in sheet.marks)
    bars = [mark for mark in sheet.marks if mark.pen.width > 2.0 * width]

    assert len(bars) == 2
    assert len({mark.pen for mark in bars}) == 1
    assert all(pytest.approx(60.0, abs=12.0) == mark.outlines[0].length for mark in bars)
    assert pytest.approx(2.0 * (800 + 600) + 600, rel=0.03) == length_of(sheet)


def test_ink_is_no_bar_where_lines_cross():
    run = np.column_stack([np.arange(100) + 0.5, np.full(100, 10.5)])
    depth = np.ones((20, 100), dtype=np.float32)
    depth[:, 50:56] = 3.0  # a crossing
    assert part_bars([run], depth, 1.5)[1] == []

    depth[:, 20:60] = 3.0
    thin, bars = part_bars([run], depth, 1.5)
    assert [(bar[0, 0], bar[-1, 0]) for bar in bars] == [(20.5, 59.5)]
    assert [(line[0, 0], line[-1, 0]) for line in thin] == [(0.5, 20.5), (59.5, 99.5)]


@pytest.mark.parametrize("walls", [BLACK, (120, 30, 30)])
def test_walls_may_have_a_hue_beside_black_furniture(walls):
    picture, pen = paper()
    room(pen, width=16, fill=walls)
    for x in (300, 500, 700):
        pen.rectangle([x, 250, x + 120, 330], fill=BLACK)
        pen.rectangle([x, 400, x + 120, 600], outline=BLACK, width=2)
        pen.rectangle([x + 10, 410, x + 110, 590], outline=BLACK, width=2)
    areas = [mark.outlines[0] for mark in sheet_of(colors_of(picture)).marks if mark.fill is not None]

    assert pytest.approx(2.0 * (800 + 600), rel=0.01) == max(outline.length for outline in areas)


@given(
    arrays(np.bool_, array_shapes(min_dims=2, max_dims=2, max_side=15), elements=st.booleans()),
    st.integers(1, 60),
)
def test_ink_is_deeper_than_a_distance_where_its_edge_is_farther(ink, quarters):
    assert np.array_equal(deeper_than(ink, quarters / 4.0), depth_of(ink) > quarters / 4.0)


@pytest.mark.parametrize("slender", [1.0, 3.0])
def test_a_ragged_line_is_an_area_nowhere_but_a_wall_is_with_its_short_ends(slender):
    ink = np.zeros((60, 200), dtype=bool)
    ink[10:13, 10:190] = True  # a line, wider over a short piece
    ink[9:14, 90:98] = True
    ink[30:45, 10:175] = True  # a wall, and the short end of one
    ink[30:45, 185:200] = True
    fat = fat_parts(ink, 4.0, slender)

    assert fat[:20].any() == (slender == 1.0)
    assert fat[37, 10:175].all()
    assert fat[37, 192]
