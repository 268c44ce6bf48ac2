import math
from pathlib import Path

import ezdxf
import pytest

from pilotage.errors import FileError
from pilotage.interpretation.names import guessed_role
from pilotage.interpretation.sheet import WHITE, Role, Sheet
from pilotage.io.dxf import read_dxf
from shared_data import needs_plans, plan


@pytest.fixture
def document():
    return ezdxf.new("R2010", setup=True)


def read(document, folder) -> Sheet:
    path = folder / "plan.dxf"
    document.saveas(path)
    return read_dxf(path)


def test_lines_arcs_and_bulges_keep_their_place(document, tmp_path):
    space = document.modelspace()
    space.add_line((0, 0), (4, 0))
    space.add_arc((0, 0), 2.0, 0, 90)
    space.add_lwpolyline([(0, 0, 0, 0, 1.0), (2, 0, 0, 0, 0)], close=False)  # half a circle below the line
    line, arc, bulge = read(document, tmp_path).marks
    assert line.outlines[0].vertices.tolist() == [[0, 0], [4, 0]]
    assert [math.hypot(*point) for point in arc.outlines[0].vertices] == pytest.approx([2.0] * 9, rel=0.001)
    assert bulge.outlines[0].vertices[:, 1].min() == pytest.approx(-1.0, abs=0.001)
    assert arc.source.startswith("ARC ")
    assert arc.source.endswith(" on 0")


def test_a_closed_polyline_is_closed_and_has_its_own_width(document, tmp_path):
    document.modelspace().add_lwpolyline(
        [(0, 0), (4, 0), (4, 3)], close=True, dxfattribs={"const_width": 0.2}
    )
    (mark,) = read(document, tmp_path).marks
    assert mark.outlines[0].closed
    assert mark.pen is not None
    assert mark.pen.width == 0.2


def test_colors_come_from_entity_layer_and_block_and_white_is_black(document, tmp_path):
    document.layers.add("A-WALL", color=1)
    block = document.blocks.new("DOOR")
    block.add_line((0, 0), (1, 0), dxfattribs={"color": 0})
    space = document.modelspace()
    space.add_line((0, 0), (1, 0), dxfattribs={"layer": "A-WALL"})
    space.add_line((0, 0), (1, 0), dxfattribs={"color": 5})
    space.add_line((0, 0), (1, 0))
    space.add_line((0, 0), (1, 0), dxfattribs={"true_color": 0xFFFFFF})
    space.add_blockref("DOOR", (0, 0), dxfattribs={"color": 3})
    colors = [mark.pen.color for mark in read(document, tmp_path).marks if mark.pen]
    assert colors == [(1, 0, 0), (0, 0, 1), (0, 0, 0), (0, 0, 0), (0, 1, 0)]


def test_dashes_and_weights(document, tmp_path):
    space = document.modelspace()
    space.add_line((0, 0), (420, 0), dxfattribs={"linetype": "DASHED"})
    space.add_line((0, 0), (420, 0), dxfattribs={"lineweight": 50})
    dashed, heavy = (mark.pen for mark in read(document, tmp_path).marks)
    assert dashed.dashed
    assert not heavy.dashed
    assert heavy.width == pytest.approx(0.5)


def test_the_weight_of_a_line_of_no_length_is_not_given_to_the_next(document, tmp_path):
    space = document.modelspace()
    space.add_line((0, 0), (0, 0), dxfattribs={"lineweight": 50})
    space.add_line((0, 0), (420, 0))
    (mark,) = read(document, tmp_path).marks
    assert mark.pen is not None
    assert mark.pen.width == 0.0


def test_blocks_in_blocks_carry_names_and_groups(document, tmp_path):
    document.layers.add("A-DOOR")
    leaf = document.blocks.new("LEAF")
    leaf.add_line((0, 0), (1, 0))
    door = document.blocks.new("DOOR")
    door.add_blockref("LEAF", (1, 0))
    door.add_attdef("NUMBER", (0, 0))
    insert = document.modelspace().add_blockref(
        "DOOR", (10, 0), dxfattribs={"rotation": 90, "layer": "A-DOOR"}
    )
    insert.add_attrib("NUMBER", "D7", (10, 0))
    sheet = read(document, tmp_path)
    (mark,) = sheet.marks
    assert mark.outlines[0].vertices.round(9).tolist() == [[10, 1], [10, 2]]
    assert mark.names == ("A-DOOR", "DOOR", "A-DOOR", "LEAF", "A-DOOR")
    assert len(mark.groups) == 2
    assert [text.text for text in sheet.texts] == ["D7"]
    assert sheet.texts[0].groups == mark.groups[:1]


def test_hidden_layers_are_left_out_and_counted(document, tmp_path):
    document.layers.add("OFF").off()
    document.layers.add("FROZEN").freeze()
    space = document.modelspace()
    for layer in ("OFF", "FROZEN", "0"):
        space.add_line((0, 0), (1, 0), dxfattribs={"layer": layer})
    sheet = read(document, tmp_path)
    assert len(sheet.marks) == 1
    assert sheet.left_out == ("entities on layers that are off or frozen (2)",)


def test_hatches_are_areas_or_lines(document, tmp_path):
    space = document.modelspace()
    solid = space.add_hatch(color=1)
    solid.paths.add_polyline_path([(0, 0), (4, 0), (4, 1), (0, 1)])
    solid.paths.add_polyline_path([(1, 0.2), (2, 0.2), (2, 0.8), (1, 0.8)], flags=16)
    lines = space.add_hatch()
    lines.set_pattern_fill("ANSI31", scale=0.1)
    lines.paths.add_polyline_path([(0, 0), (4, 0), (4, 1), (0, 1)])
    dense = space.add_hatch(color=1)
    dense.set_pattern_fill("ANSI31", color=1, scale=0.00001)
    dense.paths.add_polyline_path([(0, 0), (4, 0), (4, 1), (0, 1)])
    area, strokes, full = read(document, tmp_path).marks
    assert area.fill == (1, 0, 0)
    assert area.pen is None
    assert len(area.outlines) == 2
    assert strokes.fill is None
    assert len(strokes.outlines) > 5
    assert strokes.names == ("0", "hatch")
    assert full.fill == (1, 0, 0)


def test_a_solid_hatch_is_what_its_layer_says(document, tmp_path):
    for layer in ("A-WALL", "0"):
        hatch = document.modelspace().add_hatch(dxfattribs={"layer": layer})
        hatch.paths.add_polyline_path([(0, 0), (40, 0), (40, 1), (0, 1)])
    sheet = read(document, tmp_path)
    assert [guessed_role(mark.names)[0] for mark in sheet.marks] == [Role.WALL, Role.IGNORE]


def test_solids_and_wipeouts_are_areas(document, tmp_path):
    space = document.modelspace()
    space.add_solid([(0, 0), (2, 0), (0, 1), (2, 1)], dxfattribs={"color": 1})
    space.add_wipeout([(0, 0), (1, 0), (1, 1), (0, 1)])
    solid, wipeout = read(document, tmp_path).marks
    assert solid.outlines[0].vertices.tolist() == [[0, 0], [2, 0], [2, 1], [0, 1]]
    assert solid.fill == (1, 0, 0)
    assert wipeout.fill == WHITE


def test_words_are_placed_by_their_middle(document, tmp_path):
    space = document.modelspace()
    space.add_line((0, 0), (1, 0))
    space.add_text("Hall", height=1.0).set_placement(
        (5, 5), align=ezdxf.enums.TextEntityAlignment.MIDDLE_CENTER
    )
    space.add_text("Up", height=1.0, rotation=90).set_placement((0, 0))
    space.add_mtext("Bed\\PRoom", dxfattribs={"char_height": 1.0, "insert": (3, 4), "attachment_point": 5})
    hall, up, bed, room = read(document, tmp_path).texts
    assert (hall.text, hall.position, hall.height) == ("Hall", (5, 5), 1.0)
    assert up.angle == pytest.approx(math.pi / 2)
    assert up.position[0] == pytest.approx(-0.5)
    assert up.position[1] > 0.5
    assert (bed.text, room.text) == ("Bed", "Room")
    assert bed.position[0] == pytest.approx(3)
    assert (bed.position[1] + room.position[1]) / 2 == pytest.approx(4)
    assert bed.position[1] > room.position[1]


def test_dimensions_bear_their_kind_as_a_name(document, tmp_path):
    document.modelspace().add_linear_dim(base=(0, 2), p1=(0, 0), p2=(3, 0)).render()
    sheet = read(document, tmp_path)
    assert all("DIMENSION" in mark.names for mark in sheet.marks)
    assert sheet.texts
    assert "DIMENSION" in sheet.texts[0].names


def test_the_kind_of_a_dimension_says_more_than_its_layer(document, tmp_path):
    attributes = {"layer": "A-ANNO-DIMS"}
    document.modelspace().add_linear_dim(base=(0, 2), p1=(0, 0), p2=(3, 0), dxfattribs=attributes).render()
    (text,) = read(document, tmp_path).texts

    assert "DIMENSION" == text.names[-1]


def test_paper_is_read_where_model_space_is_empty(document, tmp_path):
    document.layouts.get("Layout1").add_line((0, 0), (1, 0))
    assert len(read(document, tmp_path).marks) == 1


@pytest.mark.parametrize(("code", "metres"), [(0, None), (1, 0.0254), (4, 0.001), (6, 1.0), (99, None)])
def test_the_unit_is_as_claimed(document, tmp_path, code, metres):
    document.header["$INSUNITS"] = code
    document.modelspace().add_line((0, 0), (1, 0))
    assert read(document, tmp_path).metres_per_unit == metres


def test_a_block_that_holds_itself_ends(document, tmp_path):
    block = document.blocks.new("LOOP")
    block.add_line((0, 0), (1, 0))
    block.add_blockref("LOOP", (0, 0))
    document.modelspace().add_blockref("LOOP", (0, 0))
    assert "blocks that are nested too deeply" in read(document, tmp_path).left_out[0]


def test_a_block_bomb_is_refused(document, tmp_path, monkeypatch):
    monkeypatch.setattr("pilotage.io.dxf.walk.MOST_ENTITIES", 1000)
    document.blocks.new("B0").add_line((0, 0), (1, 0))
    for level in range(1, 9):
        block = document.blocks.new(f"B{level}")
        for _ in range(10):
            block.add_blockref(f"B{level - 1}", (0, 0))
    document.modelspace().add_blockref("B8", (0, 0))
    with pytest.raises(FileError, match="at most 1,000 entities"):
        read(document, tmp_path)


def test_points_beyond_all_bounds_are_left_out(document, tmp_path):
    space = document.modelspace()
    space.add_line((0, 0), (1e300, 0))
    space.add_line((0, 0), (1, 0))
    assert read(document, tmp_path).left_out == ("shapes beyond all bounds (1)",)


@pytest.mark.parametrize(
    "content", [b"", b"0\nSECTION\n", b"\x00" * 100, b"AutoCAD Binary DXF\r\n\x1a\x00abc"]
)
def test_damaged_files_are_refused_in_one_line(tmp_path, content):
    path = tmp_path / "plan.dxf"
    path.write_bytes(content)
    with pytest.raises(FileError, match=r"^[^\n]+$"):
        read_dxf(path)


@needs_plans
@pytest.mark.parametrize(
    ("name", "marks", "texts"),
    [
        ("hackerspace-door-lines.dxf", 91, 18),
        ("house-outline-single-layer.dxf", 94, 0),
        ("villa-architect-site.dxf", 2671, 32),
    ],
)
def test_plans_of_people_are_read_whole(name, marks, texts):
    sheet = read_dxf(Path(plan(name)))
    assert (len(sheet.marks), len(sheet.texts)) == (marks, texts)


def test_attributes_of_a_block_that_are_hidden_name_nothing(document, tmp_path):
    block = document.blocks.new("TAG")
    block.add_line((0, 0), (1, 0))
    block.add_attdef("NAME", (0, 0))
    block.add_attdef("GUID", (0, 1), dxfattribs={"flags": 1})
    insert = document.modelspace().add_blockref("TAG", (5, 5))
    insert.add_auto_attribs({"NAME": "Kitchen", "GUID": "a8f-99x"})
    assert [text.text for text in read(document, tmp_path).texts] == ["Kitchen"]
