"""Walls below signs: drawn where they run into the sign on both sides, and nowhere else."""

import numpy as np
import pytest
from PIL import Image, ImageDraw

from pilotage.io.picture import sheet_of
from pilotage.io.picture.signs import uncovered

RED, GREEN, FLOOR = (150, 30, 40), (0, 140, 95), (138, 199, 159)
SIGN = (580, 420, 640, 480)


def drawn(*walls, width=9, sign=RED, symbol=True, floor=None):
    picture = Image.new("RGB", (1200, 900), (255, 255, 255))
    pen = ImageDraw.Draw(picture)
    if floor is not None:
        pen.rectangle(floor, fill=FLOOR)
    for wall in walls:
        pen.line(wall, fill=(15, 18, 18), width=width)
    if sign is not None:
        pen.rectangle(SIGN, fill=sign)
        if symbol:
            pen.rectangle([590, 430, 600, 470], fill=(255, 255, 255))
    return np.asarray(picture, dtype=np.float32) / np.float32(255.0)


def black(colors):
    return colors.max(axis=2) < 0.2


@pytest.mark.parametrize("sign", [RED, GREEN])
@pytest.mark.parametrize(
    "walls",
    [
        [[(200, 450), (1000, 450)]],
        [[(200, 425), (1000, 425)]],
        [[(610, 100), (610, 800)]],
        [[(300, 200), (915, 695)]],
        [[(200, 450), (610, 450), (610, 800)]],
        [[(200, 450), (1000, 450)], [(610, 450), (610, 800)]],
    ],
    ids=["across", "at its edge", "down", "slanted", "corner", "branch"],
)
def test_a_wall_that_a_sign_covers_is_drawn(walls, sign):
    whole = black(drawn(*walls, sign=None))
    found = black(uncovered(drawn(*walls, sign=sign)))

    hidden = whole & ~black(drawn(*walls, sign=sign))
    assert hidden.sum() > 200
    assert (found & hidden).sum() > 0.85 * hidden.sum()
    assert (found & ~whole).sum() < 0.15 * hidden.sum()


@pytest.mark.parametrize("width", [1, 2, 3])
def test_a_thin_line_that_a_sign_covers_is_drawn_as_thick_as_it_is(width):
    wall = [(200, 450), (1000, 450)]
    whole = black(drawn(wall, sign=None, width=width))
    found = black(uncovered(drawn(wall, width=width)))

    np.testing.assert_array_equal(found[:, 600:620].sum(axis=0), whole[:, 600:620].sum(axis=0))


@pytest.mark.parametrize(
    "walls",
    [
        [[(200, 450), (590, 450)]],
        [[(200, 430), (590, 430)], [(630, 470), (1000, 470)]],
        [[(200, 450), (560, 450)], [(660, 450), (1000, 450)]],
        [[(200, 488), (1000, 488)]],
        [],
    ],
    ids=["ends", "not in line", "door about it", "beside it", "alone"],
)
def test_nothing_else_is_drawn(walls):
    colors = drawn(*walls)

    assert np.array_equal(uncovered(colors), colors)


def test_a_doorway_over_a_floor_in_a_color_stays_open():
    colors = drawn([(200, 450), (560, 450)], [(660, 450), (1000, 450)], sign=None, floor=(500, 300, 720, 600))

    assert np.array_equal(uncovered(colors), colors)


def test_a_line_in_a_color_covers_nothing():
    colors = drawn([(200, 450), (1000, 450)], sign=None)
    colors[300:600, 605:612] = np.float32((0.6, 0.1, 0.1))

    assert np.array_equal(uncovered(colors), colors)


def test_a_gray_picture_stays_as_it_is():
    shades = np.random.default_rng(4).random((300, 400, 1)).astype(np.float32)
    colors = np.repeat(shades, 3, axis=2)

    assert uncovered(colors) is colors


def test_arrows_in_a_color_are_no_walls_but_walls_in_a_color_are():
    arrow = [(450, 380), (450, 560)]
    walls, both = Image.new("RGB", (1200, 900), (255, 255, 255)), []
    ImageDraw.Draw(walls).rectangle([200, 150, 1000, 750], outline=(15, 18, 18), width=7)
    for color in (None, GREEN):
        picture = walls.copy()
        if color is not None:
            ImageDraw.Draw(picture).line(arrow, fill=color, width=7)
        both.append(len(sheet_of(np.asarray(picture, dtype=np.float32) / np.float32(255.0)).marks))
    colored = Image.new("RGB", (1200, 900), (255, 255, 255))
    ImageDraw.Draw(colored).rectangle([200, 150, 1000, 750], outline=RED, width=7)

    assert both[0] == both[1] > 0
    assert sheet_of(np.asarray(colored, dtype=np.float32) / np.float32(255.0)).marks


def test_a_sign_with_a_frame_of_its_own_is_no_wall():
    picture = Image.new("RGB", (1200, 900), (255, 255, 255))
    pen = ImageDraw.Draw(picture)
    pen.rectangle([560, 440, 640, 460], fill=GREEN, outline=(0, 0, 0))
    for wall in ([200, 445, 558, 455], [642, 445, 1000, 455]):  # both end a pixel before the frame
        pen.rectangle(wall, fill=(15, 18, 18))
    colors = np.asarray(picture, dtype=np.float32) / np.float32(255.0)

    assert (black(uncovered(colors)) & ~black(colors)).sum() <= 81 * 21
