import base64
import math
import urllib.parse
import zlib

import pytest

from pilotage.errors import FileError
from pilotage.interpretation import interpret
from pilotage.io.drawio import read_drawio
from pilotage.maps import DecompositionSettings, decompose
from shared_data import needs_plans, plan


def vertex(cell_id="a", style="", box=(10, 20, 40, 30), parent="1", value=""):
    x, y, width, height = box
    return (
        f'<mxCell id="{cell_id}" value="{value}" style="{style}" vertex="1" parent="{parent}">'
        f'<mxGeometry x="{x}" y="{y}" width="{width}" height="{height}" as="geometry"/></mxCell>'
    )


def model(*cells, layer='<mxCell id="1" parent="0"/>'):
    return f'<mxGraphModel><root><mxCell id="0"/>{layer}{"".join(cells)}</root></mxGraphModel>'


def packed(text):
    deflater = zlib.compressobj(9, zlib.DEFLATED, -zlib.MAX_WBITS)
    quoted = urllib.parse.quote(text, safe="~()*!.'").encode()
    return base64.b64encode(deflater.compress(quoted) + deflater.flush()).decode()


def mxfile(*pages):
    diagrams = "".join(f'<diagram name="{name}">{content}</diagram>' for name, content in pages)
    return f"<mxfile>{diagrams}</mxfile>"


def read(folder, text, page=None):
    path = folder / "plan.drawio"
    path.write_text(text, encoding="utf-8")
    return read_drawio(path, page)


def corners(mark):
    return sorted(map(tuple, mark.outlines[0].vertices.round(6).tolist()))


@pytest.mark.parametrize("pack", [str, packed])
def test_plain_and_packed_pages_are_the_same(tmp_path, pack):
    sheet = read(tmp_path, mxfile(("Ground", pack(model(vertex(value="Küche"))))))
    (mark,) = sheet.marks
    assert corners(mark) == [(10, -50), (10, -20), (50, -50), (50, -20)]
    assert mark.fill == (1, 1, 1)
    assert mark.pen is not None
    assert sheet.texts[0].text == "Küche"
    assert sheet.texts[0].position == pytest.approx((30, -35))
    assert sheet.y_down


def test_pages_are_chosen_by_name_or_number(tmp_path):
    text = mxfile(
        ("Ground", model(vertex(box=(0, 0, 1, 1)))), ("First floor", model(vertex(box=(5, 0, 1, 1))))
    )
    for page, left in ((None, 0), ("1", 0), ("2", 5), ("first floor", 5)):
        assert read(tmp_path, text, page).marks[0].outlines[0].vertices[:, 0].min() == left
    assert "First floor" in read(tmp_path, text).left_out[0]
    with pytest.raises(FileError, match="no page 'attic', choose one of Ground, First floor"):
        read(tmp_path, text, "attic")


def test_children_are_placed_in_their_groups(tmp_path):
    sheet = read(
        tmp_path,
        model(
            vertex("g", "group", (100, 200, 50, 50)),
            vertex("a", "", (1, 2, 3, 4), parent="g"),
            vertex("b", "", (1, 2, 3, 4), parent="g"),
        ),
    )
    one, other = sheet.marks
    assert corners(one)[-1] == (104, -202)
    assert one.groups[0] == other.groups[0]


def test_layers_give_names_and_may_be_hidden(tmp_path):
    layers = (
        '<mxCell id="1" parent="0" value="furniture"/><mxCell id="2" parent="0" value="old" visible="0"/>'
    )
    sheet = read(tmp_path, model(vertex("a"), vertex("b", parent="2"), layer=layers))
    (mark,) = sheet.marks
    assert mark.names == ("furniture",)


def test_shapes_turn_clockwise_about_their_middle(tmp_path):
    style = "shape=mxgraph.floorplan.doorLeft;rotation=90"
    threshold, leaf = read(tmp_path, model(vertex(style=style, box=(0, 0, 80, 80)))).marks
    points = threshold.outlines[0].vertices
    assert points[:, 0].min() == pytest.approx(75)  # the upper side has become the right one
    assert points[:, 0].max() == pytest.approx(80)
    hinge = leaf.outlines[0].vertices[-1]
    assert hinge == pytest.approx([75, 0])
    assert leaf.names == ("mxgraph.floorplan.doorLeft",)


def test_shapes_of_the_library_that_are_no_part_of_a_building_are_called_furniture(tmp_path):
    (mark,) = read(tmp_path, model(vertex(style="shape=mxgraph.floorplan.water_cooler"))).marks

    assert mark.names == ("furnishings", "mxgraph.floorplan.water_cooler")


def test_directions_and_mirrors_are_those_of_drawio(tmp_path):
    corner = "shape=mxgraph.floorplan.wallCorner;fillColor=strokeColor;"
    for style, full in (
        ("", (0, 0)),
        ("direction=south", (40, 0)),
        ("direction=west", (40, 30)),
        ("flipH=1", (40, 0)),
        ("flipV=1", (0, 30)),
        ("direction=south;flipH=1", (0, 0)),
    ):
        (mark,) = read(tmp_path, model(vertex(style=corner + style, box=(0, 0, 40, 30)))).marks
        assert mark.fill == mark.pen.color
        points = mark.outlines[0].vertices * (1, -1)
        middle = points.mean(axis=0)  # four of six vertices are near the full corner
        assert (middle[0] < 20, middle[1] < 15) == (full[0] == 0, full[1] == 0), style


def test_edges_join_cells_and_go_through_waypoints(tmp_path):
    edge = (
        '<mxCell id="e" style="endArrow=none;dashed=1" edge="1" parent="1" source="a" target="b">'
        '<mxGeometry relative="1" as="geometry"/></mxCell>'
        '<mxCell id="f" style="" edge="1" parent="1"><mxGeometry as="geometry">'
        '<mxPoint x="1" y="2" as="sourcePoint"/><mxPoint x="5" y="6" as="targetPoint"/>'
        '<Array as="points"><mxPoint x="1" y="6"/></Array></mxGeometry></mxCell>'
    )
    cells = (vertex("a", box=(0, 0, 10, 10)), vertex("b", box=(100, 0, 10, 10)))
    *_, joined, free = read(tmp_path, model(*cells, edge)).marks
    assert joined.outlines[0].vertices.tolist() == [[10, -5], [100, -5]]
    assert joined.pen.dashed
    assert joined.names == ()
    assert free.outlines[0].vertices.tolist() == [[1, -2], [1, -6], [5, -6]]
    assert free.names == ("arrow",)


def test_labels_lose_their_tags_and_keep_their_lines(tmp_path):
    value = "&lt;b&gt;Bed&lt;/b&gt;&amp;nbsp;room&lt;br&gt;12 m&amp;sup2;"
    first, second = read(tmp_path, model(vertex(value=value, style="rotation=90"))).texts
    assert (first.text, second.text) == ("Bed room", "12 m²")
    assert first.angle == pytest.approx(-math.pi / 2)
    assert first.position[0] > second.position[0]


def test_other_pages_are_told_where_the_first_is_empty(tmp_path):
    with pytest.raises(
        FileError, match=r"found none \(left out: other pages \(1\): Plan; choose one by .*#Plan\)"
    ):
        read(tmp_path, mxfile(("Cover", model()), ("Plan", model(vertex()))))


def test_colors_and_opacity(tmp_path):
    (mark,) = read(
        tmp_path, model(vertex(style="ellipse;fillColor=#000000;strokeColor=none;opacity=50"))
    ).marks
    assert mark.pen is None
    assert mark.fill == pytest.approx((0.5, 0.5, 0.5), abs=0.01)
    with pytest.raises(FileError, match="at least one visible stroke"):
        read(tmp_path, model(vertex(style="fillColor=none;strokeColor=none")))


@pytest.mark.parametrize(
    "text",
    [
        "",
        "<a/>",
        "<mxfile/>",
        "<mxfile><diagram>%%%</diagram></mxfile>",
        "<mxfile><diagram>" + packed("<a/>") + "</diagram></mxfile>",
        model(),
        '<!DOCTYPE a [<!ENTITY b "c">]><mxfile>&b;</mxfile>',
    ],
)
def test_damaged_files_are_refused_in_one_line(tmp_path, text):
    with pytest.raises(FileError, match=r"^[^\n]+$"):
        read(tmp_path, text)


def test_a_packed_bomb_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr("pilotage.io.drawio.document.LARGEST", 1_000_000)
    with pytest.raises(FileError, match="at most 1 MB"):
        read(tmp_path, mxfile(("a", packed(" " * 1_000_000))))


def test_a_cell_that_holds_itself_still_has_a_place(tmp_path):
    assert len(read(tmp_path, model(vertex(parent="a"))).marks) == 1


@needs_plans
def test_the_plan_of_a_house_has_its_walls_where_the_truth_says():
    sheet = read_drawio(plan("house-drawio.drawio"))
    assert len(sheet.marks) == 110
    assert {"TV Room", "Kitchen", "Double Garage"} <= {text.text for text in sheet.texts}


def test_a_property_class_names_a_shape_and_what_it_holds(tmp_path):
    cell = vertex("x", value="").replace('id="x" ', "")
    inner = vertex("b", parent="desk")
    shelf = f'<object class="furniture" label="" id="desk">{cell}</object>'
    sheet = read(tmp_path, mxfile(("Ground", model(shelf, inner, vertex("c")))))
    assert [mark.names for mark in sheet.marks] == [("furniture",), ("furniture",), ()]


def test_a_label_that_says_what_a_shape_is_names_it_and_its_words(tmp_path):
    labels = ("Coffee&lt;br&gt;table", "Door 2", "Bed room", "Toilet", "Bed 2")
    sheet = read(tmp_path, model(*(vertex(str(k), value=label) for k, label in enumerate(labels))))

    assert [("Coffee table",), ("Door 2",), (), (), ()] == [mark.names for mark in sheet.marks]
    assert ("Coffee table",) == sheet.texts[0].names


def test_boxes_with_labels_of_doors_lie_over_the_walls_of_rooms_and_open_them(tmp_path):
    boxes = {"Kitchen": (0, 0, 300, 200), "Bath": (300, 0, 200, 200), "Door": (290, 80, 20, 50)}
    boxes["Sofa"] = (20, 140, 120, 50)
    cells = (vertex(label, value=label, box=corners) for label, corners in boxes.items())
    graph = decompose(interpret(read(tmp_path, model(*cells))).sketch, DecompositionSettings())

    assert ["Bath", "Kitchen"] == sorted(cell.label for cell in graph.cells)
    assert 1 == len(graph.gateways)


def test_boxes_with_labels_of_doors_lead_from_one_room_to_another_that_stands_apart(tmp_path):
    boxes = {"Kitchen": (0, 0, 300, 200), "Bath": (340, 0, 300, 200), "Door": (300, 80, 40, 30)}
    boxes["Door 2"] = (100, 200, 30, 30)  # to nowhere
    cells = (vertex(label, value=label, box=corners) for label, corners in boxes.items())
    graph = decompose(interpret(read(tmp_path, model(*cells))).sketch, DecompositionSettings())
    rooms = {cell.label: cell.cell_id for cell in graph.cells if cell.label}
    (between,) = (cell.cell_id for cell in graph.cells if not cell.label)

    assert {"Bath", "Kitchen"} == set(rooms)
    assert set(rooms.values()) == {neighbor.cell_id for neighbor in graph.neighbors(between)}
