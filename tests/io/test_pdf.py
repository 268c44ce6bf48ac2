import math

import numpy as np
import pytest
from PIL import Image, ImageDraw

from pilotage.errors import FileError
from pilotage.interpretation import interpret
from pilotage.io.pdf import PicturePageError, read_pdf, read_picture_page
from pilotage.io.pdf.words import Letter, joined
from pilotage.io.picture import sheet_of
from shared_data import needs_plans, plan

FONT = "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>"


def pdf(*contents, page="", objects=""):
    """Make a file of one page a content: paths, and words in the font F."""
    parts = [f"1 0 obj << /Type /Catalog /Pages 2 0 R >> endobj\n{objects}"]
    kids = []
    for k, content in enumerate(contents):
        number = 10 + 2 * k
        kids.append(f"{number} 0 R")
        parts.append(
            f"{number} 0 obj << /Type /Page /Parent 2 0 R /MediaBox [0 0 200 100] {page}"
            f" /Resources << /Font << /F {FONT} >> /XObject << /X 5 0 R >> /Pattern << /P 6 0 R >> >>"
            f" /Contents {number + 1} 0 R >> endobj\n"
            f"{number + 1} 0 obj << /Length {len(content)} >> stream\n{content}\nendstream endobj\n"
        )
    parts.append(f"2 0 obj << /Type /Pages /Count {len(kids)} /Kids [{' '.join(kids)}] >> endobj\n")
    return "%PDF-1.4\n" + "".join(parts) + "trailer << /Root 1 0 R >>\n%%EOF"


def read(folder, *contents, number=None, **more):
    path = folder / "plan.pdf"
    path.write_text(pdf(*contents, **more), encoding="latin-1")
    return read_pdf(path, number)


def vertices(mark):
    return mark.outlines[0].vertices.round(4).tolist()


def test_lines_and_areas_keep_color_width_and_dashes(tmp_path):
    sheet = read(
        tmp_path, "1 0 0 RG 2 w [3 1] 0 d 10 20 m 60 20 l S", "0 0 1 rg 10 10 30 20 re f", number="1"
    )
    (line,) = sheet.marks
    assert vertices(line) == [[10, 20], [60, 20]]
    assert line.pen is not None
    assert (line.pen.color, line.pen.width, line.pen.dashed) == ((1, 0, 0), 2, True)
    (area,) = read(tmp_path, "0 0 1 rg 10 10 30 20 re f").marks
    assert (area.fill, area.pen) == ((0, 0, 1), None)
    assert area.outlines[0].closed
    assert sheet.page == (0, 0, 200, 100)


def test_a_line_of_a_negative_width_is_a_hairline(tmp_path):
    sheet = read(tmp_path, "-1 w 10 20 m 60 20 l S 1 w 10 20 m 10 60 l S 60 20 m 60 60 l S")

    assert [0.0, 1.0, 1.0] == [mark.pen.width for mark in sheet.marks]
    assert 3 == len(interpret(sheet).sketch.strokes)


@pytest.mark.parametrize(("opacity", "count"), [(0.05, 1), (0.5, 2)])
def test_a_line_that_is_nearly_transparent_is_none(tmp_path, opacity, count):
    path = tmp_path / "plan.pdf"
    states = f"/Resources << /ExtGState << /Thin << /CA {opacity} >> >>"
    path.write_text(pdf("10 20 m 90 20 l S /Thin gs 10 40 m 90 40 l S").replace("/Resources <<", states))
    sheet = read_pdf(path)

    assert count == len(sheet.marks)


def test_matrices_and_curves(tmp_path):
    quarter = "1 0 m 1 0.5523 0.5523 1 0 1 c S"
    (mark,) = read(tmp_path, f"0 10 -10 0 100 50 cm {quarter}").marks  # a quarter turn, ten times as large
    assert vertices(mark)[0] == [100, 60]
    assert vertices(mark)[-1] == [90, 50]
    radii = [math.hypot(x - 100, y - 50) for x, y in vertices(mark)]
    assert radii == pytest.approx([10] * len(radii), rel=0.001)
    assert mark.pen.width == pytest.approx(10)


def test_clips_cut_lines_and_areas(tmp_path):
    clip = "50 0 100 100 re W n "
    line, area = read(tmp_path, clip + "0 50 m 200 50 l S 0 0 100 10 re f").marks
    assert sorted(vertices(line)) == [[50, 50], [150, 50]]
    assert area.outlines[0].vertices.min(axis=0).tolist() == [50, 0]
    assert area.outlines[0].vertices.max(axis=0).tolist() == [100, 10]


def test_areas_that_overlap_by_the_winding_rule_have_no_hole(tmp_path):
    rings = "0 0 50 50 re 10 10 20 20 re "
    assert [len(mark.outlines) for mark in read(tmp_path, rings + "f").marks] == [1, 1]
    assert [len(mark.outlines) for mark in read(tmp_path, rings + "f*").marks] == [2]


def test_forms_are_groups_in_their_place(tmp_path):
    form = (
        "5 0 obj << /Type /XObject /Subtype /Form /BBox [0 0 50 50] /Matrix [1 0 0 1 100 0]"
        " /Length 13 >> stream\n0 0 m 9 9 l S\nendstream endobj\n"
    )
    (mark,) = read(tmp_path, "q 1 0 0 1 0 20 cm /X Do Q", objects=form).marks
    assert vertices(mark) == [[100, 20], [109, 29]]
    assert len(mark.groups) == 1


def test_words_are_joined_into_lines(tmp_path):
    words = "BT /F 10 Tf 20 40 Td (Bed room) Tj 0 -12 Td (12 m2) Tj ET"
    upright = "BT /F 10 Tf 0 1 -1 0 150 20 Tm (Hall) Tj ET"
    sheet = read(tmp_path, f"0 0 m 9 9 l S {words} {upright} BT /F 5 Tf 5 5 Td (Scale 1:100) Tj ET")
    bed, size, hall, _ = sheet.texts
    assert (bed.text, size.text, hall.text) == ("Bed room", "12 m2", "Hall")
    assert bed.position == pytest.approx((42, 43.6), abs=2)
    assert bed.height == pytest.approx(7.2)
    assert hall.angle == pytest.approx(math.pi / 2)
    assert hall.position == pytest.approx((146.4, 29), abs=2)
    assert sheet.metres_per_unit == pytest.approx(100 * 0.0254 / 72)


def test_letters_of_a_ligature_make_one_word():
    glyphs = [
        ("O", 0, 7),
        ("f", 7, 16),
        ("f", 7, 16),
        ("i", 7, 16),
        ("c", 16, 21),
        ("e", 21, 26),
        ("2", 30, 35),
    ]
    (text,) = joined([Letter(letter, complex(x), complex(end), 10.0, 0.0) for letter, x, end in glyphs])

    assert text.text == "Office 2"


def test_letters_over_their_halo_are_read_once(tmp_path):
    halo = "BT 1 Tr 3 w 1 0 0 RG /F 10 Tf 20 40 Td (Bed room) Tj ET"
    sheet = read(tmp_path, f"0 0 m 9 9 l S {halo} BT 0 Tr /F 10 Tf 20 40 Td (Bed room) Tj ET")

    assert ["Bed room"] == [text.text for text in sheet.texts]


def test_dashes_that_are_painted_one_by_one_are_dashed_lines(tmp_path):
    east = "".join(f"{x} 19 m {x + 4} 19 l {x + 4} 21 l {x} 21 l " for x in range(10, 58, 8))
    north = "".join(f"69 {y} m 69 {y + 4} l 71 {y + 4} l 71 {y} l " for y in range(25, 85, 8))
    (mark,) = read(tmp_path, f"1 0 0 rg {east} {north} f").marks

    assert [line.vertices.round(4).tolist() for line in mark.outlines] == [
        [[10, 20], [54, 20]],
        [[70, 25], [70, 85]],
    ]
    assert (mark.pen.color, mark.pen.width, mark.pen.dashed, mark.fill) == ((1, 0, 0), 2, True, None)


@pytest.mark.parametrize(
    "boxes",
    [
        [(10, 4), (18, 4), (26, 4)],  # few
        [(10, 4), (18, 4), (30, 4), (50, 4), (62, 4)],  # at several distances
        [(10, 4), (18, 12), (34, 6), (44, 20), (68, 9)],  # of several lengths
    ],
)
def test_other_rows_of_boxes_are_areas(tmp_path, boxes):
    path = "".join(f"{x} 19 {width} 2 re " for x, width in boxes)
    marks = read(tmp_path, f"{path} f").marks

    assert len(boxes) == len(marks)
    assert all(mark.pen is None for mark in marks)


def test_a_pattern_over_the_whole_page_is_paper(tmp_path):
    tile = (
        "6 0 obj << /Type /Pattern /PatternType 1 /PaintType 1 /TilingType 1 /BBox [0 0 5 5]"
        " /XStep 5 /YStep 5 /Resources << >> /Length 13 >> stream\n0 0 m 5 0 l S\nendstream endobj\n"
    )
    squared = "/Pattern cs /P scn"
    (mark, floor) = read(
        tmp_path, f"{squared} 0 0 200 100 re f 10 10 m 90 10 l S 20 20 50 50 re f", objects=tile
    ).marks

    assert (vertices(mark), floor.outlines[0].vertices.max()) == ([[10, 10], [90, 10]], 70)


def test_a_turned_and_cropped_page_is_read_as_it_is_shown(tmp_path):
    sheet = read(tmp_path, "20 10 m 70 10 l S", page="/CropBox [10 0 200 100] /Rotate 90")
    assert sheet.page == (0, 0, 100, 190)
    assert vertices(sheet.marks[0]) == [[10, 180], [10, 130]]


def test_pages_are_chosen_by_number(tmp_path):
    lines = ("0 0 m 9 9 l S", "0 0 m 5 5 l S")
    assert vertices(read(tmp_path, *lines, number="2").marks[0])[1] == [5, 5]
    assert read(tmp_path, *lines).left_out == ("other pages (1): 2; choose one by plan.pdf#2",)
    with pytest.raises(FileError, match="no page '3', choose one of 1, 2"):
        read(tmp_path, *lines, number="3")


@pytest.mark.parametrize("content", [b"", b"%PDF-1.4", b"%PDF-1.4\n" + b"\x00\xff" * 200])
def test_damaged_files_are_refused_in_one_line(tmp_path, content):
    path = tmp_path / "plan.pdf"
    path.write_bytes(content)
    with pytest.raises(FileError, match=r"^[^\n]+$"):
        read_pdf(path)


def test_an_empty_page_is_refused(tmp_path):
    with pytest.raises(FileError, match="at least one visible stroke"):
        read(tmp_path, "")


def test_a_page_that_is_a_picture_is_traced_in_points(tmp_path):
    picture = Image.new("RGB", (1000, 800), "white")
    ImageDraw.Draw(picture).rectangle((200, 160, 800, 640), outline="black", width=8)
    picture.save(tmp_path / "scan.pdf", resolution=100.0)
    with pytest.raises(PicturePageError):
        read_pdf(tmp_path / "scan.pdf")
    shapes = []

    def trace(colors):
        shapes.append(colors.shape)
        return sheet_of(colors)

    sheet = read_picture_page(tmp_path / "scan.pdf", None, trace, side=500)
    assert shapes == [(400, 500, 3)]
    points = np.vstack([outline.vertices for mark in sheet.marks for outline in mark.outlines])
    width, height = 720.0, 576.0
    assert sheet.page == pytest.approx((0, 0, width, height))
    assert points.min(axis=0) == pytest.approx([0.2 * width, 0.2 * height], abs=6)
    assert points.max(axis=0) == pytest.approx([0.8 * width, 0.8 * height], abs=6)
    assert not sheet.y_down


@needs_plans
@pytest.mark.parametrize(("name", "least", "word"), [("house-iguide-three-levels.pdf", 400, "KITCHEN")])
def test_plans_of_people_are_read_whole(name, least, word):
    sheet = read_pdf(plan(name))
    assert len(sheet.marks) >= least
    assert word in {text.text for text in sheet.texts}
