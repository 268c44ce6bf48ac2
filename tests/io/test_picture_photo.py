"""Paper on a table is found, straightened, and its places told in the photo's own pixels."""

import numpy as np
import pytest
import shapely
from PIL import Image, ImageDraw

from pilotage.geometry import Homography
from pilotage.io.picture import sheet_of
from pilotage.io.picture.light import flatten
from pilotage.io.picture.photo import find_paper, is_photo, straighten

CORNERS = np.array([(90.0, 70.0), (690.0, 100.0), (740.0, 520.0), (50.0, 500.0)])
ROOMS = np.array([(150, 120), (650, 120), (650, 480), (150, 480)])  # on paper of 800 x 600
PAPER = np.array([(0.0, 0.0), (800.0, 0.0), (800.0, 600.0), (0.0, 600.0)])
PHOTO_FROM_PAPER = Homography.between(PAPER, CORNERS)


def drawn():
    """A room with a wall across it, and a gap in the wall, in pen on white paper."""
    paper = Image.new("RGB", (800, 600), (245, 243, 238))
    pen = ImageDraw.Draw(paper)
    pen.line([*map(tuple, ROOMS.tolist()), tuple(ROOMS[0].tolist())], fill=(25, 30, 110), width=5)
    pen.line([(400, 120), (400, 260)], fill=(25, 30, 110), width=5)
    pen.line([(400, 330), (400, 480)], fill=(25, 30, 110), width=5)
    return paper


def photographed(shadow=0.4):
    """The drawing on a brown table, from one side, with a shadow over a corner."""
    matrix = Homography.between(CORNERS, PAPER).matrix
    sheet = drawn().transform(
        (800, 600), Image.Transform.PERSPECTIVE, matrix.ravel()[:8].tolist(), Image.Resampling.BILINEAR
    )  # fmt: skip
    mask = Image.new("1", (800, 600))
    ImageDraw.Draw(mask).polygon([tuple(corner) for corner in CORNERS.tolist()], fill=1)
    noise = np.random.default_rng(3).normal(0.0, 0.02, (600, 800, 1))
    colors = np.where(np.asarray(mask)[..., None], np.asarray(sheet) / 255.0, (0.4, 0.28, 0.2)) + noise
    rows, columns = np.mgrid[:600, :800]
    dark = 1.0 - shadow * np.exp(-((rows - 400) ** 2 + (columns - 600) ** 2) / 2.0 / 90.0**2)
    return np.clip(colors * dark[..., None], 0.0, 1.0).astype(np.float32)


def test_the_corners_of_paper_are_found():
    found = find_paper(photographed())

    assert found is not None
    np.testing.assert_allclose(found, CORNERS, atol=3.0)


def test_a_picture_of_paper_alone_has_no_corners():
    assert find_paper(np.asarray(drawn(), dtype=np.float32) / np.float32(255.0)) is None


def test_only_a_camera_sees_edges_of_no_one_color():
    assert is_photo(photographed())
    assert not is_photo(np.asarray(drawn(), dtype=np.float32) / np.float32(255.0))


def test_straight_paper_has_right_angles_and_knows_its_place():
    straight = straighten(photographed(), CORNERS)
    height, width = straight.colors.shape[:2]
    inner = np.array([(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]) + straight.corner
    back = Homography.from_matrix(straight.picture_from_plane).points(inner)

    assert shapely.Polygon(CORNERS).buffer(1e-6).contains(shapely.Polygon(back))
    np.testing.assert_allclose(back, CORNERS, atol=15.0)


def test_lines_of_a_photo_lie_where_they_were_drawn():
    sheet = sheet_of(photographed())
    upright = PHOTO_FROM_PAPER.points(ROOMS.astype(float)) * (1.0, -1.0)
    expected = shapely.LinearRing(upright)

    assert sheet.photo_from_sheet is not None
    lines = [sheet.photo_from_sheet.points(mark.outlines[0].vertices) for mark in sheet.marks]
    reach = shapely.union_all([shapely.LineString(line) for line in lines]).buffer(4.0)
    assert reach.contains(expected)


def test_shadow_on_paper_is_no_ink():
    straight = straighten(photographed(shadow=0.6), CORNERS)
    flat = flatten(straight.colors, is_photo=True)

    assert pytest.approx(1.0, abs=0.05) == float(np.median(flat))
    assert np.mean(flat.min(axis=2) < 0.7) < 0.05
