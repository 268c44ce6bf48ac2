"""Small flats of two rooms, drawn as people and programs draw them: what is a wall, what a door?"""

import math
from dataclasses import replace

import numpy as np
import pytest

from flats import BLACK, LABELS, OUTSIDE, RED, ROOMS, WHITE, WITH_GAP, arc, are_joined, box, graph_of, stroke
from pilotage.geometry import Polyline
from pilotage.interpretation import Mark, NoWallsError, Pen, Role, Sheet, Text, interpret
from pilotage.maps import DecompositionSettings, decompose


def test_plain_strokes_stay_as_they_were_drawn():
    understood = interpret(Sheet(WITH_GAP))

    drawn = [outline for mark in WITH_GAP for outline in mark.outlines]
    assert [line.vertices.tolist() for line in drawn] == [
        line.vertices.tolist() for line in understood.sketch.strokes
    ]
    assert () == understood.sketch.solids
    assert are_joined(WITH_GAP)


@pytest.mark.parametrize("name", ["arrow", "Hilfslinien"])
def test_arrows_and_guides_are_no_walls(name):
    across = replace(stroke((50, 20), (50, 60)), names=(name,))

    assert are_joined((*WITH_GAP, across))
    assert not are_joined((*WITH_GAP, replace(across, names=("partition",))))


def test_a_leaf_with_a_quarter_arc_is_a_door():
    wall, leaf = stroke((50, 0), (50, 80)), stroke((50, 30), (62, 30))

    assert not are_joined((OUTSIDE, wall))
    assert are_joined((OUTSIDE, wall, leaf, arc((50, 30), 12, 0, 90)))


def test_a_white_patch_over_a_wall_is_a_gap_and_below_it_is_not():
    rooms = (box(0, 0, 50, 80, pen=Pen(BLACK, 1.0)), box(50, 0, 100, 80, pen=Pen(BLACK, 1.0)))
    patch = box(47, 30, 53, 42, fill=WHITE)

    assert are_joined((*rooms, patch))
    assert not are_joined((patch, *rooms))


def test_walls_painted_with_a_thickness_are_solid():
    painted = (
        box(0, 0, 100, 4, fill=BLACK),
        box(0, 76, 100, 80, fill=BLACK),
        box(0, 0, 4, 80, fill=BLACK),
        box(96, 0, 100, 80, fill=BLACK),
        box(48, 0, 52, 30, fill=BLACK),
        box(48, 42, 52, 80, fill=BLACK),
    )

    assert interpret(Sheet(painted)).sketch.solids
    assert are_joined(painted)
    assert 2 == len([cell for cell in graph_of(painted).cells if cell.label])


def test_what_lies_between_rows_of_rooms_is_a_corridor_and_no_wall():
    rooms = [(x, y) for x in (0, 64, 128, 192) for y in (0, 44, 88, 132)]
    walls = [box(x, y, x + 60, y + 40, pen=Pen(BLACK, 1.0)) for x, y in rooms]
    gaps = [stroke((x + 28, y), (x + 31, y), color=WHITE, width=2.0) for x, y in rooms if y]
    outside = box(0, 0, 252, 172, pen=Pen(BLACK, 1.0))

    sketch = interpret(Sheet((outside, *walls, *gaps))).sketch

    assert not sketch.solids
    assert len(decompose(sketch, DecompositionSettings()).cells) > len(rooms)


def test_walls_that_are_named_need_no_doors():
    names = ("walls",)
    outer = [box(k, k, 100 - k, 80 - k, pen=Pen(BLACK, 1.0), names=names) for k in (0, 2)]
    inner = [box(49, y, 51, top, pen=Pen(BLACK, 1.0), names=names) for y, top in ((2, 30), (42, 78))]

    assert are_joined((*outer, *inner, stroke((70, 20), (80, 20))))


def test_a_frame_of_two_lines_around_the_sheet_is_not_the_only_wall():
    frame = [box(-60 - k, -60 - k, 200 + k, 140 + k, pen=Pen(BLACK, 1.0)) for k in (0, 4)]
    walls = [replace(mark, names=("walls",)) for mark in WITH_GAP]

    assert {"bath", "hall"} <= {cell.label for cell in graph_of((*frame, *walls)).cells}


def test_a_wall_whose_faces_nearly_meet_parts_rooms():
    outer = (box(-2, -2, 102, 82, pen=Pen(BLACK, 1.0)), box(0, 0, 100, 80, pen=Pen(BLACK, 1.0)))
    wedge = [stroke((50, 0), (50, 80)), stroke((50.01, 0), (51.5, 80))]

    assert not are_joined((*outer, *wedge))


def test_a_lawn_is_no_wall_though_a_house_and_paths_leave_little_of_it():
    lawn = box(-15, -15, 115, 95, fill=(0.2, 0.5, 0.2))
    paths = [box(0, y, 100, y + 1, fill=(0.9, 0.9, 0.8)) for y in (-14, -12, -10, 90, 92, 94)]
    rooms = [box(x, 0, x + 50, 80, pen=Pen(BLACK, 1.0), fill=WHITE) for x in (0, 50)]
    marks = (lawn, *paths, *rooms)

    assert not interpret(Sheet(marks)).sketch.solids
    assert {"bath", "hall"} <= {cell.label for cell in graph_of(marks).cells}


@pytest.mark.parametrize("furniture", [{"color": RED}, {"dashed": True}])
def test_small_things_in_a_color_or_dashed_are_no_walls(furniture):
    table = stroke((20, 20), (28, 20), (28, 26), (20, 26), (20, 20), **furniture)

    understood = interpret(Sheet((*WITH_GAP, table)))

    assert Role.FURNITURE is understood.meanings[-1].role
    assert len(graph_of(WITH_GAP).cells) == len(graph_of((*WITH_GAP, table)).cells)


@pytest.mark.parametrize("name", ["WALLS", "layer"])
def test_lines_in_a_color_that_are_named_walls_stay_though_they_end_short_of_others(name):
    frame, wall = box(-20, -20, 120, 100, pen=Pen(BLACK, 1.0)), {"color": RED, "names": (name,)}
    outer = stroke((0, 0), (100, 0), (100, 80), (0, 80), (0, 0), **wall)
    walls = stroke((50, 2), (50, 78), **wall), stroke((52, 40), (60, 40), **wall)

    found = interpret(Sheet((frame, outer, *walls))).sketch.strokes

    assert ([[52.0, 40.0], [60.0, 40.0]] in [line.vertices.tolist() for line in found]) is (name == "WALLS")


def test_two_panes_along_the_faces_of_a_wall_close_one_opening():
    outer = stroke((100, 10), (100, 0), (0, 0), (0, 80), (100, 80), (100, 70), width=3.0)
    walls = stroke((50, 0), (50, 30), width=3.0), stroke((50, 42), (50, 80), width=3.0)
    panes = [stroke((x, 10), (x, 70), width=0.5) for x in (99, 101)]
    island = stroke((70, 30), (78, 30), (78, 50), (70, 50), (70, 30), width=0.5)

    cells = graph_of((outer, *walls, *panes, island)).cells

    assert {"hall", "bath"} == {cell.label for cell in cells}


def test_dashed_axes_run_through_a_building_and_beyond_and_part_no_rooms():
    walls = [box(*sides, fill=BLACK) for sides in ((0, 0, 100, 4), (0, 76, 100, 80), (0, 0, 4, 80))]
    walls += [box(*sides, fill=BLACK) for sides in ((96, 0, 100, 30), (96, 42, 100, 80))]
    axes = [stroke((-15, y), (115, y), dashed=True) for y in (2, 50, 78)]

    understood = interpret(Sheet((*walls, *axes)))

    assert {Role.IGNORE} == {meaning.role for meaning in understood.meanings[-3:]}
    assert len(graph_of(walls).cells) == len(graph_of((*walls, *axes)).cells)
    assert len(graph_of(walls).cells) < len(graph_of((*walls, stroke((4, 50), (96, 50)))).cells)


def test_lines_of_a_grid_run_beyond_all_that_is_in_other_pens_and_part_no_rooms():
    grid = [stroke((-15, y), (115, y), color=(0.8, 0.8, 0.8)) for y in (10, 20, 60)]
    walls = [stroke((0, y), (100, y), color=(0.8, 0.8, 0.8)) for y in (10, 20, 60)]

    understood = interpret(Sheet((*grid, *WITH_GAP)))

    assert [Role.IGNORE] * 3 == [meaning.role for meaning in understood.meanings[:3]]
    assert len(graph_of(WITH_GAP).cells) == len(graph_of((*grid, *WITH_GAP)).cells)
    assert len(graph_of(WITH_GAP).cells) < len(graph_of((*walls, *WITH_GAP)).cells)


def test_dashed_lines_from_wall_to_wall_are_openings_if_others_are_drawn_through():
    wall, edge = stroke((50, 0), (50, 50)), stroke((50, 50), (50, 80), dashed=True)
    loose = stroke((50, 60), (50, 75), dashed=True)
    rooms = [replace(mark, pen=Pen(BLACK, 1.0, dashed=True)) for mark in WITH_GAP]

    assert are_joined((OUTSIDE, wall, edge))
    assert 2 == len(graph_of((OUTSIDE, wall, edge)).cells)
    assert Role.DOOR is interpret(Sheet((OUTSIDE, wall, edge))).meanings[2].role
    assert Role.DOOR is not interpret(Sheet((OUTSIDE, wall, loose))).meanings[2].role
    assert not are_joined((OUTSIDE, wall, replace(edge, names=("wall",))))
    assert Role.DOOR not in {meaning.role for meaning in interpret(Sheet(tuple(rooms))).meanings}


def test_thin_lines_between_thick_ones_are_thresholds_and_furniture_and_part_rooms_if_they_are_long():
    threshold = [stroke((x, 30), (x, 42), width=0.1) for x in (49.5, 50.5)]
    table = stroke((20, 20), (28, 20), (28, 26), (20, 26), (20, 20), width=0.1)
    partition = stroke((50, 0), (50, 80), width=0.1)

    understood = interpret(Sheet((*WITH_GAP, *threshold, table)))

    assert are_joined((*WITH_GAP, *threshold, table))
    assert [Role.FURNITURE] * 3 == [meaning.role for meaning in understood.meanings[-3:]]
    assert not are_joined((OUTSIDE, partition))


def test_lines_less_than_half_as_wide_as_walls_are_furniture_unless_they_enclose_rooms_themselves():
    table = [(20, 20), (28, 20), (28, 26), (20, 26), (20, 20)]
    alone = (*WITH_GAP, stroke(*table, width=0.4))
    annex = [
        stroke((100, 0), (180, 0), (180, 80), (100, 80), width=0.4),
        stroke((140, 0), (140, 80), width=0.4),
    ]
    enlarged = (*WITH_GAP, *annex, stroke(*table, width=0.1))

    assert Role.FURNITURE is interpret(Sheet(alone)).meanings[-1].role
    assert [Role.WALL, Role.WALL, Role.FURNITURE] == [
        meaning.role for meaning in interpret(Sheet(enlarged)).meanings[-3:]
    ]


def test_a_long_thin_line_within_a_building_is_a_wall_but_no_large_bed_that_stands_free():
    bed = [(15, 20), (27, 20), (27, 38), (15, 38)]
    screen = stroke(*bed, width=0.1)
    closed = stroke(*bed, bed[0], width=0.1)

    assert Role.WALL is interpret(Sheet((*WITH_GAP, screen))).meanings[-1].role
    assert Role.FURNITURE is interpret(Sheet((*WITH_GAP, closed))).meanings[-1].role


def test_thin_lines_are_furniture_too_where_the_thick_walls_are_open_at_wide_windows():
    below = [stroke((0, 20), (0, 0), (10, 0)), stroke((40, 0), (60, 0)), stroke((90, 0), (100, 0))]
    walls = (*below, stroke((100, 0), (100, 80), (0, 80), (0, 60)), *WITH_GAP[1:])
    ends = (((10, 0), (40, 0)), ((60, 0), (90, 0)), ((0, 20), (0, 60)))
    panes = [stroke(start, end, width=0.1) for start, end in ends]
    table = stroke((20, 20), (28, 20), (28, 26), (20, 26), (20, 20), width=0.1)

    understood = interpret(Sheet((*walls, *panes, table)))

    assert Role.FURNITURE is understood.meanings[-1].role
    assert [Role.WALL] * 3 == [meaning.role for meaning in understood.meanings[-4:-1]]
    assert are_joined((*walls, *panes, table))


def test_lines_in_a_color_over_walls_are_doors_within_a_building_and_windows_around_it():
    walls = (OUTSIDE, stroke((50, 0), (50, 80)))
    brown, blue = (0.55, 0.27, 0.07), (0.53, 0.81, 0.92)
    door, window = stroke((50, 30), (50, 38), color=brown), stroke((0, 20), (0, 34), color=blue)

    understood = interpret(Sheet((*walls, door, window)))

    assert not are_joined(walls)
    assert are_joined((*walls, door, window))
    assert Role.WALL is understood.meanings[-1].role


@pytest.mark.parametrize(("name", "joined"), [("window", False), ("w1", True)])
def test_thin_lines_in_gaps_between_rooms_close_them_if_they_are_named_windows(name, joined):
    front = (stroke((20, 0), (20, -9), width=0.3), arc((20, 0), 9, 270, 360))
    pane = stroke((50, 30), (50, 42), width=0.3, names=(name,))

    assert are_joined((*WITH_GAP, *front, pane)) is joined


@pytest.mark.parametrize("layer", ["PIPES", "cable-trays 2", "ELECTRICAL", "给排水管线"])
def test_pipes_and_cables_are_no_walls(layer):
    sheet = Sheet((*WITH_GAP, stroke((20, 0), (20, 80), names=(layer,))))

    assert Role.IGNORE is interpret(sheet).meanings[-1].role


@pytest.mark.parametrize(("height", "label"), [(2.0, "hall"), (3.0, "hall, Stove")])
def test_words_for_furniture_in_smaller_letters_than_names_of_rooms_name_none(height, label):
    texts = [replace(text, height=3.0) for text in LABELS]
    graph = graph_of(WITH_GAP, (*texts, Text("Stove", (75.0, 20.0), height=height)))

    assert {"bath", label} == {cell.label for cell in graph.cells}


@pytest.mark.parametrize("words", ["UP 14R", "DN", "±0.00", "FFL +0.15"])
def test_the_way_of_stairs_and_the_level_of_a_floor_name_no_room(words):
    graph = graph_of(WITH_GAP, (*LABELS, Text(words, (75.0, 20.0), height=3.0)))

    assert {"bath", "hall"} == {cell.label for cell in graph.cells}


def test_a_room_of_electricity_is_a_room():
    rooms = [box(x, 0, x + 50, 80, pen=Pen(BLACK, 1.0), names=("electrical-room",)) for x in (0, 50)]

    assert {Role.WALL} == {meaning.role for meaning in interpret(Sheet((*rooms, OUTSIDE))).meanings}


@pytest.mark.parametrize("layer", ["A-FURN", "Möbel", "mobilier", "arredo"])
def test_layers_are_understood_in_several_languages_and_a_hint_wins(layer):
    sheet = Sheet((*WITH_GAP, box(20, 20, 28, 26, pen=Pen(BLACK, 1.0), names=(layer,))))

    guessed, told = interpret(sheet), interpret(sheet, {layer: Role.WALL})

    assert (Role.FURNITURE, f"its name is {layer!r}") == (
        guessed.meanings[-1].role,
        guessed.meanings[-1].reason,
    )
    assert Role.WALL is told.meanings[-1].role


@pytest.mark.parametrize("name", ["axes_1", "Frame 1", "legend"])
def test_a_name_that_all_marks_bear_says_nothing_of_any(name):
    table = box(20, 20, 28, 26, pen=Pen(RED, 1.0), names=("chair",))
    marks = tuple(replace(mark, names=(name, *mark.names)) for mark in (*WITH_GAP, table))

    understood = interpret(Sheet(marks))

    assert are_joined(marks)
    assert (Role.FURNITURE, "its name is 'chair'") == (
        understood.meanings[-1].role,
        understood.meanings[-1].reason,
    )


def test_names_that_leave_nothing_else_say_nothing():
    floor = box(0, 0, 100, 80, fill=WHITE, names=("rooms",))
    walls = tuple(replace(mark, names=("border",)) for mark in WITH_GAP)

    assert are_joined((floor, *walls))
    assert Role.IGNORE is interpret(Sheet((*WITH_GAP, replace(walls[0])))).meanings[-1].role


def test_the_outline_of_a_room_is_its_wall_however_thin_and_small_it_is():
    thick = box(0, 0, 100, 80, pen=Pen(BLACK, 4.0))
    cells = [box(x, 60, x + 5, 65, pen=Pen(BLACK, 1.0), names=("room",)) for x in range(0, 100, 5)]
    things = [replace(cell, names=()) for cell in cells]
    names = [Text(f"R{k}", (5 * k + 2.5, 62.5), height=1.0) for k in range(20)]

    assert 21 <= len(graph_of((thick, *cells), names).cells)
    assert 21 > len(graph_of((thick, *things), names).cells)


def test_the_outline_of_a_room_closes_no_gap_of_the_wall_beside_it():
    sides = ((50, 0), (50, 34)), ((50, 42), (50, 80))
    thick = [replace(OUTSIDE, pen=Pen(BLACK, 4.0)), *(stroke(*ends, width=4.0) for ends in sides)]
    rooms = [
        box(*sides, pen=Pen(BLACK, 0.5), names=("room",)) for sides in ((0, 0, 50, 80), (50, 0, 100, 80))
    ]

    assert are_joined((*thick, *rooms))


def test_lines_of_one_name_are_joined_and_areas_are_no_names():
    texts = (Text("Meeting", (25, 42), 3.0), Text("room", (25, 38), 3.0), Text("11.2 m²", (25, 34), 3.0))

    assert ["Meeting room"] == [label.text for label in interpret(Sheet(WITH_GAP, texts)).sketch.labels]


def test_lines_of_words_with_a_wall_between_them_are_two_names():
    wall = (stroke((0, 40), (20, 40)), stroke((30, 40), (50, 40)))
    upper, lower = (Text("WC 1", (12, 42.5), 3.0), Text("WC 2", (12, 37.5), 3.0))

    names = [label.text for label in interpret(Sheet((*WITH_GAP, *wall), (upper, lower))).sketch.labels]
    without = [label.text for label in interpret(Sheet(WITH_GAP, (upper, lower))).sketch.labels]

    assert (["WC 1", "WC 2"], ["WC 1 WC 2"]) == (names, without)


def test_each_mark_has_a_role_and_a_reason():
    understood = interpret(
        Sheet((box(-5, -5, 105, 85, fill=WHITE), *WITH_GAP, box(2, 2, 48, 78, fill=(0.8, 0.9, 1.0))))
    )

    assert len(understood.sheet.marks) == len(understood.meanings)
    assert all(meaning.reason for meaning in understood.meanings)
    assert (Role.IGNORE, Role.FLOOR) == (understood.meanings[0].role, understood.meanings[-1].role)


@pytest.mark.parametrize("degrees", [0.0, 17.0, 90.0, 200.0])
@pytest.mark.parametrize("flip", [1.0, -1.0])
def test_turned_and_mirrored_sheets_are_understood_alike(degrees, flip):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    turn = np.array([[c, s], [-s, c]]) * (1.0, flip)
    drawn = (OUTSIDE, stroke((50, 0), (50, 80)), stroke((50, 30), (62, 30)), arc((50, 30), 12, 0, 90))
    marks = [
        Mark(tuple(Polyline(line.vertices @ turn, line.closed) for line in mark.outlines), mark.pen)
        for mark in drawn
    ]
    texts = tuple(Text(text.text, tuple((np.array(text.position) @ turn).tolist()), 3.0) for text in LABELS)

    graph = graph_of(marks, texts)

    assert set(ROOMS) == {cell.label for cell in graph.cells}
    assert 1 == len(graph.gateways)


def test_a_sheet_without_a_line_has_no_walls():
    with pytest.raises(NoWallsError, match="at least one visible stroke"):
        interpret(Sheet((box(0, 0, 1, 1, fill=WHITE),)))


def test_corners_of_a_wall_that_nearly_coincide_are_no_matter():
    panel = box(1, 4, 5, 7, pen=Pen(BLACK, 0.01, dashed=True), fill=RED)
    zigzag = stroke((6, 5), (7, 6), (3, 5), (1, 8), (8, 5), (6, 3), width=0.0, names=("wall",))
    sheet = Sheet((box(0, 0, 10, 8, pen=Pen(BLACK, 1.0)), panel, zigzag))

    assert interpret(sheet).sketch.strokes  # and warns of no division by zero


def test_a_color_tells_what_marks_are_unless_an_inner_name_does():
    gray = (0.6, 0.6, 0.6)
    marks = (
        box(0, 0, 100, 80, pen=Pen(BLACK, 1.0)),
        box(10, 10, 20, 20, fill=gray),
        box(40, 10, 50, 20, fill=gray, names=("core",)),
    )

    found = interpret(Sheet(marks), {"#999999": Role.FURNITURE, "core": Role.WALL})

    assert (Role.FURNITURE, "you said that '#999999' is furniture") == (
        found.meanings[1].role,
        found.meanings[1].reason,
    )
    assert "you said that 'core' is wall" == found.meanings[2].reason


def test_a_painted_mark_without_a_line_may_be_told_to_be_a_wall_where_walls_are_solids_and_lines():
    edges = [(0, 0, 100, 4), (0, 76, 100, 80), (0, 0, 4, 80), (96, 0, 100, 80)]
    outer = [box(*edge, fill=BLACK) for edge in edges]
    thin = stroke((50, 4), (50, 76))
    cupboard = box(70, 30, 80, 50, fill=(0.6, 0.6, 0.6), names=("cupboard",))

    sketch = interpret(Sheet((*outer, thin, cupboard)), {"cupboard": Role.WALL}).sketch

    assert [70.0, 30.0] in [ring.vertices.min(axis=0).tolist() for ring in sketch.solids]
    assert any((line.vertices[:, 0] == 50.0).all() for line in sketch.strokes)


def test_words_on_layers_of_dimensions_and_furniture_name_no_room():
    office = Text("Office", (25, 40), 3)
    others = (Text("4.52", (25, 60), 3, names=("Bemaßung",)), Text("Desk", (75, 40), 3, names=("A-FURN",)))

    def names(*texts):
        return {label.text for label in interpret(Sheet(WITH_GAP, texts)).sketch.labels}

    assert {"Office"} == names(office, *others)
    assert {"4.52", "Desk"} == names(*others)  # nothing is written elsewhere
    assert {"Office", "Cabinet"} == names(office, Text("Cabinet", (75, 40), 3, names=("7-Cabinet",)))


def test_outlines_of_rooms_along_walls_of_a_layer_of_their_own_close_no_door():
    walls = tuple(replace(mark, names=("A-WALL",)) for mark in WITH_GAP)
    rooms = [box(0, 0, 50, 80, pen=Pen(BLACK, 1.0)), box(50, 0, 100, 80, pen=Pen(BLACK, 1.0))]
    areas = tuple(replace(mark, names=("A-AREA",)) for mark in rooms)

    assert are_joined((*walls, *areas))
    assert not are_joined((*WITH_GAP, *areas))  # no layer says what is a wall
    assert not are_joined((walls[0], *areas))  # it holds the outer walls alone


def test_bare_numbers_are_lengths_where_most_rooms_have_several_and_else_name_rooms():
    rooms = [box(x, 0, x + 40, 80, pen=Pen(BLACK, 1.0)) for x in (0, 40, 80)]
    names = [Text(name, (x, 40), 3.0) for name, x in (("bath", 20), ("hall", 60), ("lab", 100))]
    lengths = [Text(f"{100 * x + y}", (x, y), 1.5) for x in (20, 60, 100) for y in (15, 65)]

    assert {"bath", "hall", "lab"} == {cell.label for cell in graph_of(rooms, (*names, *lengths)).cells}
    assert "hall, 6015" in {cell.label for cell in graph_of(rooms, (*names, *lengths[::2])).cells}


def test_words_that_are_only_called_words_are_of_what_holds_them():
    ticks = (Text(str(x), (x, -5), height=3.0, names=("axis", "text_1")) for x in (0, 50))
    found = interpret(Sheet(WITH_GAP, (*LABELS, *ticks)))

    assert [Role.LABEL, Role.LABEL, Role.IGNORE, Role.IGNORE] == [one.role for one in found.text_meanings]
