import json
import math

import pytest

from pilotage.errors import FileError
from pilotage.io.excalidraw import read_excalidraw
from shared_data import needs_plans, plan


def element(kind, **more):
    box = {"x": 10, "y": 20, "width": 40, "height": 30, "strokeColor": "#1e1e1e", "strokeWidth": 2}
    return {"type": kind, "id": kind, **box, "backgroundColor": "transparent", "opacity": 100, **more}


def read(folder, *elements, **more):
    path = folder / "plan.excalidraw"
    path.write_text(json.dumps({"type": "excalidraw", "elements": elements, **more}))
    return read_excalidraw(path)


def test_a_rectangle_stands_upright_on_a_sheet_whose_file_points_down(tmp_path):
    sheet = read(tmp_path, element("rectangle"))
    (mark,) = sheet.marks
    assert mark.outlines[0].vertices.tolist() == [[10, -20], [50, -20], [50, -50], [10, -50]]
    assert mark.outlines[0].closed
    assert mark.fill is None
    assert mark.pen is not None
    assert (mark.pen.width, mark.pen.dashed) == (2, False)
    assert sheet.y_down


def test_a_quarter_turn_is_clockwise_on_the_page(tmp_path):
    (mark,) = read(tmp_path, element("rectangle", angle=math.pi / 2)).marks
    assert mark.outlines[0].vertices.round(6).tolist()[0] == [45, -15]  # upper left has become upper right


def test_round_shapes_stay_within_their_box(tmp_path):
    sheet = read(
        tmp_path, element("ellipse"), element("diamond"), element("rectangle", roundness={"type": 3})
    )
    for mark in sheet.marks:
        points = mark.outlines[0].vertices
        assert (points.min(axis=0) >= (10 - 1e-9, -50 - 1e-9)).all()
        assert (points.max(axis=0) <= (50 + 1e-9, -20 + 1e-9)).all()
    assert len(sheet.marks[2].outlines[0]) > 20


def test_lines_may_be_curved_dashed_and_filled(tmp_path):
    corner = [[0, 0], [30, 0], [30, 30]]
    sheet = read(
        tmp_path,
        element("line", points=corner, strokeStyle="dashed"),
        element("arrow", points=corner, roundness={"type": 2}),
        element("line", points=[*corner, [0, 0]], backgroundColor="#ff0000"),
        element("freedraw", points=corner),
    )
    plain, curved, area, pen = sheet.marks
    assert plain.outlines[0].vertices.tolist() == [[10, -20], [40, -20], [40, -50]]
    assert plain.pen.dashed
    assert len(curved.outlines[0]) > 6
    assert curved.names == ("arrow",)
    assert area.outlines[0].closed
    assert area.fill == (1, 0, 0)
    assert pen.pen.width > plain.pen.width


def test_an_arrow_without_a_head_is_a_line(tmp_path):
    way = [[0, 0], [30, 0]]
    heads = ({"endArrowhead": None}, {"endArrowhead": "triangle"}, {"startArrowhead": "bar"})
    sheet = read(tmp_path, *(element("arrow", points=way, **head) for head in heads))

    assert [(), ("arrow",), ("arrow",)] == [mark.names for mark in sheet.marks]


def test_a_label_that_says_what_a_shape_is_names_it_and_its_words(tmp_path):
    box, label = element("rectangle"), element("text", text="desk", containerId="rectangle")
    sheet = read(tmp_path, box, label, element("rectangle", id="other"))

    assert [("desk",), ()] == [mark.names for mark in sheet.marks]
    assert ("desk",) == sheet.texts[0].names


def test_words_are_read_line_by_line(tmp_path):
    text = element("text", text="Bed\nroom", fontSize=10)
    bed, room = read(tmp_path, element("rectangle"), text).texts
    assert (bed.text, bed.position) == ("Bed", (30, -27.5))
    assert (room.text, room.position) == ("room", (30, -42.5))


def test_groups_and_frames_are_kept(tmp_path):
    sheet = read(
        tmp_path,
        {"type": "frame", "id": "f", "name": "furniture", "x": 0, "y": 0},
        element("rectangle", groupIds=["inner", "outer"], frameId="f"),
        element("ellipse", groupIds=["outer"]),
    )
    inner, outer = sheet.marks
    assert inner.names == ("furniture",)
    assert inner.groups[:1] == outer.groups
    assert len(inner.groups) == 2


def test_a_role_that_the_drawing_table_wrote_is_a_name(tmp_path):
    measure, zone = read(
        tmp_path,
        element("line", points=[[0, 0], [40, 0]], customData={"role": "measure", "metres": 3}),
        element("rectangle", customData={"role": "keep-out"}),
    ).marks
    assert measure.names == ("ignore",)
    assert zone.names == ("keep-out",)


def test_what_is_not_seen_is_not_there(tmp_path):
    sheet = read(
        tmp_path,
        element("rectangle"),
        element("ellipse", isDeleted=True),
        element("diamond", opacity=0),
        element("line", points=[[0, 0], [1, 1]], strokeColor="transparent"),
        element("image"),
        element("line", points=[]),
        appState={"viewBackgroundColor": "#121212"},
    )
    assert [mark.source for mark in sheet.marks] == ["rectangle rectangle"]
    assert sheet.left_out == ("damaged elements (1)", "embedded pictures (1)")
    assert sheet.background[0] < 0.1


@pytest.mark.parametrize(
    "content",
    [
        "",
        "[]",
        "{",
        '{"elements": {}}',
        '{"elements": []}',
        "[" * 100_000,
        '{"elements": [1, null, {"type": 3}]}',
    ],
)
def test_anything_else_is_refused_in_one_line(tmp_path, content):
    path = tmp_path / "plan.excalidraw"
    path.write_text(content)
    with pytest.raises(FileError, match=r"^[^\n]+$"):
        read_excalidraw(path)


@needs_plans
def test_the_plan_of_an_office_is_six_boxes():
    sheet = read_excalidraw(plan("office-boxes.excalidraw"))
    assert len(sheet.marks) == 6
