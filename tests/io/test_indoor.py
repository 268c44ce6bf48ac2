import json
import math
import zipfile

import numpy as np
import pytest
import shapely

from pilotage.errors import FileError
from pilotage.findings import report
from pilotage.interpretation import interpret
from pilotage.io.indoor import read_geojson, read_imdf, read_osm
from pilotage.maps.cells.decomposition import DecompositionSettings, divide
from shared_data import VECTOR, needs_vector

METRE = math.degrees(1.0 / 6_371_008.8)
"""A metre at the equator [deg]."""

BOX = [(0, 0), (4, 0), (4, 3), (0, 3), (0, 0)]
NEXT = [(4, 0), (8, 0), (8, 3), (4, 3), (4, 0)]


def feature(points, kind="Polygon", feature_type=None, feature_id=None, **properties):
    degrees = [[x * METRE, y * METRE] for x, y in points]
    coordinates = {"Polygon": [degrees], "LineString": degrees, "Point": degrees[0]}[kind]
    found = {"type": "Feature", "properties": properties}
    found["geometry"] = {"type": kind, "coordinates": coordinates}
    return found | {"feature_type": feature_type, "id": feature_id}


def collection(*features):
    return json.dumps({"type": "FeatureCollection", "features": features})


def read(folder, *features, level=None):
    path = folder / "plan.geojson"
    path.write_text(collection(*features))
    return read_geojson(path, level)


def length(sheet):
    return sum(outline.length for mark in sheet.marks for outline in mark.outlines)


def test_rooms_share_a_wall_and_bear_their_names_in_metres(tmp_path):
    sheet = read(
        tmp_path, feature(BOX, indoor="room", name="Kitchen", level="0"), feature(NEXT, indoor="room")
    )
    assert sheet.metres_per_unit == 1.0
    assert length(sheet) == pytest.approx(3 * 3 + 4 * 4, abs=0.01)
    (text,) = sheet.texts
    assert text.text == "Kitchen"
    assert text.position == pytest.approx((2, 1.5), abs=0.01)
    assert {name for mark in sheet.marks for name in mark.names} == {"wall"}


def test_tags_of_openstreetmap_may_be_kept_by_themselves(tmp_path):
    kitchen, bath = (
        feature(points, type="way", id=1, tags={"indoor": "room", "name": "Kitchen"})
        for points in (BOX, NEXT)
    )
    door = feature([(4, 1.5)], "Point", type="node", id=2, tags={"door": "yes"})
    closed, opened = read(tmp_path, kitchen, bath), read(tmp_path, kitchen, bath, door)
    assert ["Kitchen", "Kitchen"] == [text.text for text in opened.texts]
    assert length(opened) < length(closed)


@pytest.mark.parametrize(
    ("name", "kind"),
    [("roomName", "objectType"), ("Room Name", "Room-Type"), ("Raum", "Art"), ("nom", "TYPE")],
)
def test_names_and_kinds_are_told_in_many_spellings(tmp_path, name, kind):
    kitchen = feature(BOX, **{name: "Kitchen", kind: "room"})
    closed = read(tmp_path, kitchen)
    opened = read(tmp_path, kitchen, feature([(4, 1), (4, 2)], "LineString", **{kind: "door"}))
    assert ["Kitchen"] == [text.text for text in closed.texts]
    assert length(opened) == pytest.approx(length(closed) - 1.0, abs=0.2)


@pytest.mark.parametrize(
    ("before", "between", "after"), [("[", ",\n", "]"), ("", "\n", ""), ("\x1e", "\n\x1e", "\n")]
)
def test_features_may_be_listed_or_streamed(tmp_path, before, between, after):
    features = (feature(BOX, indoor="room", name="Kitchen"), feature(NEXT, indoor="room", name="Bath"))
    path = tmp_path / "plan.geojson"
    path.write_text(before + between.join(map(json.dumps, features)) + after)
    assert ["Kitchen", "Bath"] == [text.text for text in read_geojson(path).texts]


def test_doors_open_the_walls(tmp_path):
    rooms = (feature(BOX, indoor="room"), feature(NEXT, indoor="room"))
    door = feature([(4, 1.5)], "Point", door="yes", width="1.2")
    closed, opened = read(tmp_path, *rooms), read(tmp_path, *rooms, door)
    assert length(closed) - length(opened) == pytest.approx(1.2, abs=0.02)


def test_a_room_with_a_number_beyond_all_numbers_is_left_out(tmp_path):
    broken = feature(NEXT, indoor="room")
    broken["geometry"]["coordinates"][0][1][1] = 10**400
    sheet = read(tmp_path, feature(BOX, indoor="room"), broken)
    assert length(sheet) == pytest.approx(14.0, abs=0.01)


def test_corridors_run_into_each_other(tmp_path):
    sheet = read(tmp_path, feature(BOX, indoor="corridor"), feature(NEXT, indoor="corridor"))
    assert length(sheet) == pytest.approx(2 * (8 + 3), abs=0.01)


def test_the_level_with_most_rooms_is_shown_unless_another_is_named(tmp_path):
    rooms = (
        feature(BOX, indoor="room", level="1"),
        feature(NEXT, indoor="room", level="1"),
        feature(BOX, indoor="room", level="0;2"),
    )
    assert length(read(tmp_path, *rooms)) == pytest.approx(25, abs=0.01)
    assert length(read(tmp_path, *rooms, level="2")) == pytest.approx(14, abs=0.01)
    assert "other levels (2): 0, 2" in read(tmp_path, *rooms).left_out[0]
    with pytest.raises(FileError, match="no level '7', choose one of 1, 0, 2"):
        read(tmp_path, *rooms, level="7")


def test_stairs_columns_and_furniture_are_named(tmp_path):
    sheet = read(
        tmp_path,
        feature(BOX, indoor="room", stairs="yes"),
        feature(NEXT, indoor="column"),
        feature(NEXT, feature_type="fixture"),
    )
    names = [mark.names for mark in sheet.marks]
    assert {("stairs",), ("column",), ("furniture",)} <= set(names)
    assert sheet.marks[names.index(("column",))].fill == (0, 0, 0)


def test_imdf_opens_walls_at_openings_and_names_levels(tmp_path):
    files = {
        "unit.geojson": collection(
            feature(BOX, feature_type="unit", category="room", level_id="l1", name={"en": "Kitchen"}),
            feature(NEXT, feature_type="unit", category="walkway", level_id="l1"),
            feature(BOX, feature_type="unit", category="room", level_id="l2"),
        ),
        "opening.geojson": collection(
            feature([(4, 1), (4, 2)], "LineString", feature_type="opening", level_id="l1")
        ),
        "level.geojson": collection(
            feature(BOX, feature_type="level", feature_id="l1", short_name={"en": "EG"}, ordinal=0),
            feature(BOX, feature_type="level", feature_id="l2", ordinal=1),
        ),
    }
    with zipfile.ZipFile(tmp_path / "venue.zip", "w") as archive:
        for name, text in files.items():
            archive.writestr(f"venue/{name}", text)
            (tmp_path / name).write_text(text)
    for sheet in (read_imdf(tmp_path / "venue.zip", "EG"), read_geojson(tmp_path / "unit.geojson", "eg")):
        assert length(sheet) == pytest.approx(25 - 1, abs=0.02)
        assert [text.text for text in sheet.texts] == ["Kitchen"]
        assert sheet.left_out == (f"other levels (1): 1; choose one by {sheet.source.split('/')[-1]}#1",)


def test_coordinates_of_a_plane_stay_as_they_are(tmp_path):
    path = tmp_path / "plan.geojson"
    line = {"type": "LineString", "coordinates": [[0, 0], [120, 40]]}
    path.write_text(json.dumps({"type": "Feature", "properties": None, "geometry": line}))
    sheet = read_geojson(path)
    assert sheet.marks[0].outlines[0].vertices.tolist() == [[0, 0], [120, 40]]
    assert sheet.metres_per_unit is None


def osm(nodes, ways):
    points = "".join(
        f'<node id="{k}" lon="{x * METRE}" lat="{y * METRE}">{tags}</node>' for k, x, y, tags in nodes
    )
    lines = "".join(
        f'<way id="{100 + k}">{"".join(f"<nd ref={chr(34)}{ref}{chr(34)}/>" for ref in refs)}{tags}</way>'
        for k, (refs, tags) in enumerate(ways)
    )
    return f'<osm version="0.6">{points}{lines}</osm>'


def test_osm_doors_are_nodes_of_walls(tmp_path):
    room = '<tag k="indoor" v="room"/><tag k="level" v="0"/><tag k="name" v="Hall"/>'
    nodes = [(1, 0, 0, ""), (2, 4, 0, ""), (3, 4, 3, ""), (4, 0, 3, ""), (5, 2, 0, '<tag k="door" v="yes"/>')]
    path = tmp_path / "plan.osm"
    path.write_text(osm(nodes, [((1, 5, 2, 3, 4, 1), room), ((1, 99), room), ((3, 4), "")]))
    sheet = read_osm(path)
    assert length(sheet) == pytest.approx(14 - 0.9, abs=0.02)
    assert sheet.texts[0].text == "Hall"
    points = np.vstack([outline.vertices for mark in sheet.marks for outline in mark.outlines])
    assert points.max(axis=0) == pytest.approx([4, 3], abs=0.01)


@pytest.mark.parametrize("text", ["", "{", "[]", "{}", '{"type": "FeatureCollection", "features": [1, {}]}'])
def test_other_json_is_refused_in_one_line(tmp_path, text):
    path = tmp_path / "plan.geojson"
    path.write_text(text)
    with pytest.raises(FileError, match=r"^[^\n]+$"):
        read_geojson(path)


@pytest.mark.parametrize("text", ["", "<osm>", "<osm/>", "<osm><node id='1' lat='x' lon='1'/></osm>"])
def test_other_xml_is_refused_in_one_line(tmp_path, text):
    path = tmp_path / "plan.osm"
    path.write_text(text)
    with pytest.raises(FileError, match=r"^[^\n]+$"):
        read_osm(path)


@needs_vector
@pytest.mark.parametrize("name", ["house.osm", "house.geojson"])
def test_a_house_is_the_same_in_both_formats(name):
    sheet = (read_osm if name.endswith("osm") else read_geojson)(VECTOR / name)
    assert {text.text for text in sheet.texts} == {"kid room", "parent room"}
    assert length(sheet) == pytest.approx(68.2, abs=0.5)


def moved(points, right):
    return [(x + right, y) for x, y in points]


def joined(sheet):
    """Names of the rooms that gateways join."""
    graph = divide(interpret(sheet).sketch, DecompositionSettings()).graph
    labels = {cell.cell_id: cell.label for cell in graph.cells}
    return {frozenset(labels[cell] for cell in gateway.cell_ids) for gateway in graph.gateways}


@pytest.mark.parametrize("far", [20, 300])
def test_doors_are_gateways_however_large_the_site_is(tmp_path, far):
    rooms = (
        feature(BOX, indoor="room", name="a"),
        feature(NEXT, indoor="room", name="b"),
        feature(moved(BOX, far), indoor="room", name="c"),
        feature(moved(NEXT, far), indoor="room", name="d"),
    )
    doors = (
        feature([(4, 1), (4, 1.8)], "LineString", feature_type="opening"),
        feature([(4 + far, 1.5)], "Point", door="yes"),
    )
    assert joined(read(tmp_path, *rooms, *doors)) == {frozenset("ab"), frozenset("cd")}


def test_a_door_as_wide_as_the_wall_parts_two_rooms(tmp_path):
    rooms = (feature(BOX, indoor="room", name="a"), feature(NEXT, indoor="room", name="b"))
    door = feature([(4, 0.01), (4, 2.99)], "LineString", feature_type="opening")
    assert joined(read(tmp_path, *rooms, door)) == {frozenset("ab")}


def test_a_door_opens_no_wall_that_runs_across_its_end(tmp_path):
    above = [(0, 3), (8, 3), (8, 6), (0, 6), (0, 3)]
    rooms = [
        feature(points, indoor="room", name=name)
        for points, name in zip((BOX, NEXT, above), "abc", strict=True)
    ]
    door = feature([(4, 0), (4, 3)], "LineString", feature_type="opening")

    assert joined(read(tmp_path, *rooms, door)) == {frozenset("ab")}


def test_stairs_with_a_door_are_a_room(tmp_path):
    rooms = (
        feature(BOX, indoor="room", name="a"),
        feature(NEXT, feature_type="unit", category="stairs", name="flight"),
    )
    door = feature([(4, 1), (4, 2)], "LineString", feature_type="opening")
    assert joined(read(tmp_path, *rooms, door)) == {frozenset(("a", "flight"))}


def test_walls_of_neighbors_that_hardly_miss_are_one(tmp_path):
    beside = [(4.008, 0), (8, 0.004), (8, 3), (4.006, 3), (4.008, 0)]
    sheet = read(tmp_path, feature(BOX, indoor="room"), feature(beside, indoor="room"))
    assert length(sheet) == pytest.approx(3 * 3 + 4 * 4, abs=0.05)


def test_a_geometry_collection_is_read_part_by_part(tmp_path):
    path = tmp_path / "plan.geojson"
    line = {"type": "LineString", "coordinates": [[0, 0], [500, 0]]}
    areas = {
        "type": "MultiPolygon",
        "coordinates": [[[[x, 9], [x + 9, 9], [x, 18], [x, 9]]] for x in (0, 90)],
    }
    path.write_text(json.dumps({"type": "GeometryCollection", "geometries": [line, areas]}))
    assert [len(mark.outlines[0]) for mark in read_geojson(path).marks] == [2, 3, 3]


def test_the_width_of_a_door_may_be_in_centimetres(tmp_path):
    door = feature([(2, 0)], "Point", door="yes", width="90 cm")
    sheet = read(tmp_path, feature(BOX, indoor="room"), door)

    assert [pytest.approx(0.9, abs=0.01)] == [opening.length for opening in sheet.openings]


@pytest.mark.parametrize("key", ["objectType", "type", "USE_TYPE", "feature_type"])
def test_maps_of_no_standard_are_read_by_what_they_call_things(tmp_path, key):
    rooms = [feature(BOX, NAME="a"), feature(NEXT, Name="b", FLOOR="1")]
    door = feature([(4, 1), (4, 2)], "LineString")
    for made, called in zip([*rooms, door], ["Room", "Laboratory", "Interior door"], strict=True):
        made["properties"][key] = called

    assert joined(read(tmp_path, *rooms, door)) == {frozenset("ab")}


def test_imdf_may_tell_its_types_among_the_properties(tmp_path):
    flat = [feature(BOX, name="a"), feature(NEXT, name="b"), feature([(4, 1), (4, 2)], "LineString")]
    for made, told in zip(flat, ["unit", "unit", "opening"], strict=True):
        made["properties"]["feature_type"] = told

    assert joined(read(tmp_path, *flat)) == {frozenset("ab")}


def test_a_drawing_that_was_turned_into_a_map_keeps_its_layers_and_words(tmp_path):
    sheet = read(
        tmp_path,
        feature(BOX, "LineString", Layer="A-FURN", Text=None),
        feature([(2, 1)], "Point", Layer="A-TEXT", Text="Kitchen"),
    )

    assert [("A-FURN",)] == [mark.names for mark in sheet.marks]
    assert ["Kitchen"] == [text.text for text in sheet.texts]


def test_the_name_of_a_building_names_no_room(tmp_path):
    sheet = read(tmp_path, feature(BOX, building="school", name="Goethe"), feature(BOX, indoor="room"))

    assert not sheet.texts


def test_the_outline_of_a_building_cuts_no_room(tmp_path):
    rooms = (feature(BOX, indoor="room"), feature(NEXT, indoor="room"))
    skewed = feature([(0.4, 0.5), (8.5, 0.9), (8.3, 3.8), (0, 3.5), (0.4, 0.5)], building="school")

    sheet = read(tmp_path, *rooms, skewed)

    outlines = shapely.union_all(
        [shapely.linestrings(outline.vertices) for mark in sheet.marks for outline in mark.outlines]
    )
    inside = shapely.box(0.1, 0.1, 3.9, 2.9), shapely.box(4.1, 0.1, 7.9, 2.9)
    assert not any(shapely.intersects(outlines, room) for room in inside)
    assert shapely.length(shapely.intersection(outlines, shapely.box(8.1, 0.0, 9.0, 4.0))) > 2.0


def test_walls_and_furniture_name_no_room(tmp_path):
    wall = feature([(0, 0), (4, 0)], "LineString", type="wall", name="wall_1")
    sheet = read(tmp_path, feature(BOX, type="room", name="a"), wall, feature(NEXT, type="table", name="t1"))

    assert ["a"] == [text.text for text in sheet.texts]


def test_what_lies_between_rooms_that_are_drawn_by_their_inner_faces_is_a_wall(tmp_path):
    rooms = (feature(BOX, indoor="room", name="a"), feature(moved(NEXT, 0.2), indoor="room", name="b"))
    sheet = read(tmp_path, *rooms, feature([(4, 1.5)], "Point", door="yes"))

    assert ["a", "b"] == sorted(text.text for text in sheet.texts)
    assert joined(sheet) == {frozenset("ab")}


def box(left, bottom, right, top):
    return [(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)]


def test_thin_walls_with_doors_stand_beside_a_thick_outer_wall(tmp_path):
    rooms = {"a": (0, 0, 5, 4), "b": (5, 0, 10, 4), "hall": (0, 4, 10, 6)}
    sheet = read(
        tmp_path,
        feature(box(-0.2, -0.2, 10.2, 6.2), building="yes"),
        *(feature(box(*corners), indoor="room", name=name) for name, corners in rooms.items()),
        *(feature([(x, 4)], "Point", door="yes") for x in (2.5, 7.5)),
    )

    assert joined(sheet) == {frozenset(("a", "hall")), frozenset(("b", "hall"))}


def test_passages_of_an_area_graph_are_doors(tmp_path):
    def room(name):
        return f'<tag k="osmAG:type" v="area"/><tag k="indoor" v="room"/><tag k="name" v="{name}"/>'

    passage = '<tag k="osmAG:type" v="passage"/><tag k="name" v="p_1"/>'
    oven = '<tag k="osmAG:furniture_type" v="oven"/><tag k="osmAG:furniture_name" v="oven_1"/>'
    corners = [(0, 0), (4, 0), (4, 1), (4, 2), (4, 3), (0, 3), (8, 0), (8, 3), (1, 1), (2, 1), (2, 2)]
    nodes = [(k, x, y, "") for k, (x, y) in enumerate(corners)]
    a, b = (0, 1, 2, 3, 4, 5, 0), (1, 6, 7, 4, 3, 2, 1)
    path = tmp_path / "plan.osm"
    path.write_text(osm(nodes, [(a, room("a")), (b, room("b")), ((2, 3), passage), ((8, 9, 10, 8), oven)]))
    sheet = read_osm(path)

    assert joined(sheet) == {frozenset("ab")}
    assert ["furniture"] == [mark.names[0] for mark in sheet.marks if mark.names != ("wall",)]


def test_coordinates_of_a_national_grid_are_metres(tmp_path):
    west, north = 691_000.0, 5_335_000.0
    shapes = {"a": box(0, 0, 4, 3), "b": box(4.2, 0, 8, 3)}
    rooms = [feature(points, Typ="Raum", Name=name) for name, points in shapes.items()]
    for made, points in zip(rooms, shapes.values(), strict=True):
        made["geometry"]["coordinates"] = [[[west + x, north + y] for x, y in points]]
    door = feature([(0, 0)], "Point", Typ="Tür")
    door["geometry"]["coordinates"] = [west + 4.1, north + 1.5]
    sheet = read(tmp_path, *rooms, door)

    assert 1.0 == sheet.metres_per_unit
    assert joined(sheet) == {frozenset("ab")}


@pytest.mark.parametrize("unit", [1.0, 100.0], ids=["metres", "pixels"])
def test_maps_of_a_plane_have_doors_and_walls_in_units_of_their_own(tmp_path, unit):
    def on_plane(points, kind="Polygon", **properties):
        return feature([(x * unit / METRE, y * unit / METRE) for x, y in points], kind, **properties)

    rooms = [on_plane(box(0, 0, 6, 5), type="room", name="a")]
    rooms.append(on_plane(box(6.2, 0, 12, 5), type="room", name="b"))
    sheet = read(tmp_path, *rooms, on_plane([(6.1, 2)], "Point", type="door"))

    assert sheet.metres_per_unit is None
    assert joined(sheet) == {frozenset("ab")}


def test_findings_ask_for_doors_in_the_terms_of_the_file(tmp_path):
    rooms = (feature(BOX, indoor="room", name="a"), feature(NEXT, indoor="room", name="b"))
    map_file = tmp_path / "map.osm"
    nodes = [(k, x, y, "") for k, (x, y) in enumerate((*BOX[:4], *NEXT[1:3]))]
    room = '<tag k="indoor" v="room"/>'
    map_file.write_text(osm(nodes, [((0, 1, 2, 3, 0), room), ((1, 4, 5, 2, 1), room)]))

    for sheet, words in ((read(tmp_path, *rooms), "'opening'"), (read_osm(map_file), "door=yes")):
        understood = interpret(sheet)
        found = report(understood.sketch, understood).findings[0]
        assert "no-doors" == found.kind
        assert words in found.advice


def test_a_map_in_pieces_lacks_doors(tmp_path):
    rooms = [feature(moved(BOX, 4 * k), indoor="room", name=name) for k, name in enumerate("abcde")]
    door = feature([(4, 1.5)], "Point", door="yes")

    understood = interpret(read(tmp_path, *rooms, door))
    found = report(understood.sketch, understood).findings[0]

    assert "in-pieces" == found.kind
    assert found.advice.startswith("add a feature with the feature_type 'opening'")
