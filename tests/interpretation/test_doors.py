"""Doors, shut leaves and windows in walls of one line, of two and of paint."""

import math

import pytest
import shapely

from flats import BLACK, OUTSIDE, WHITE, WITH_GAP, arc, are_joined, box, graph_of, stroke
from pilotage.interpretation import Mark, Pen, Role, Sheet, Text, interpret
from pilotage.interpretation.paint import NOTHING
from pilotage.interpretation.windows import panes, windows, without_slivers

PEN = Pen(BLACK, 1.0)
WALL = stroke((50, 0), (50, 80))
OUTER = [(0, 0, 100, 4), (0, 76, 100, 80), (0, 0, 4, 80), (96, 0, 100, 80)]
INNER = [(48, 0, 52, 30), (48, 42, 52, 80)]


def roles(marks):
    return [meaning.role for meaning in interpret(Sheet(tuple(marks))).meanings]


def ends_of_gateways(marks):
    """List the pairs of names of the cells that gateways join; a doorway may be a cell without one."""
    graph = graph_of(marks)
    return [{graph.cell(name).label for name in gateway.cell_ids} for gateway in graph.gateways]


@pytest.mark.parametrize("opened", [30, 60, 90, 110])
def test_a_leaf_may_stand_ajar(opened):
    arced = arc((50, 30), 12, 90 - opened, 90)
    leaf = stroke((50, 30), arced.outlines[0].vertices[0])

    assert are_joined((OUTSIDE, WALL, leaf, arced))
    assert [Role.WALL, Role.WALL, Role.DOOR, Role.DOOR] == roles((OUTSIDE, WALL, leaf, arced))


@pytest.mark.parametrize("walls", [(OUTSIDE, WALL), WITH_GAP])
def test_an_arc_that_bends_the_wrong_way_is_a_door(walls):
    arced = arc((62, 42), 12, 180, 270)

    assert are_joined((*walls, arced))
    assert [*[Role.WALL] * len(walls), Role.DOOR] == roles((*walls, arced))


@pytest.mark.parametrize("opened", [15, 40, 70, -15, -60])
def test_a_leaf_without_an_arc_is_a_door_if_it_stands_ajar(opened):
    turn = math.radians(90 - opened)
    leaf = stroke((50, 30), (50 + 12 * math.cos(turn), 30 + 12 * math.sin(turn)))

    assert are_joined((OUTSIDE, WALL, leaf))
    assert [Role.WALL, Role.WALL, Role.DOOR] == roles((OUTSIDE, WALL, leaf))


@pytest.mark.parametrize("opened", [20, 65, -65])
def test_a_wall_and_the_leaf_at_its_end_may_be_one_line(opened):
    walls = walls_with_leaves(opened, places=(30, 80, 120))

    assert len(interpret(Sheet((OUTSIDE, *walls))).sketch.doors) == 3


def test_a_wall_that_ends_in_a_line_ajar_is_a_wall():
    sheet = Sheet((OUTSIDE, *walls_with_leaves(65, places=(30, 80))))

    assert interpret(sheet).sketch.doors == ()
    assert {Role.WALL} == set(roles(sheet.marks))


def walls_with_leaves(opened, places):
    """Draw walls up the sheet at some places; each ends in a leaf, and goes on behind the door."""
    turn = math.radians(90 - opened)
    step = 12 * math.cos(turn), 12 * math.sin(turn)
    return [
        line
        for x in places
        for line in (stroke((x, 0), (x, 30), (x + step[0], 30 + step[1])), stroke((x, 42), (x, 80)))
    ]


@pytest.mark.parametrize(("bends", "doors"), [(1, 1), (6, 0)])
def test_bends_of_a_hand_are_no_doors_even_if_one_seems_to_have_a_leaf(bends, doors):
    drawn = [arc((20 + 8 * k, 60), 10, 0, 90) for k in range(1, 1 + bends)]
    leaved = arc((50, 30), 12, 0, 90), stroke((50, 30), (62, 30)), stroke((50, 42), (50, 80))

    assert doors == len(interpret(Sheet((OUTSIDE, *drawn, *leaved))).sketch.doors)


def test_a_chart_beside_the_plan_does_not_tell_how_wide_doors_are():
    turn = math.radians(30)
    leaves = [stroke((50, y), (50 + 8 * math.cos(turn), y + 8 * math.sin(turn))) for y in (10, 30, 50)]
    chart = [arc((150, 40), 25, 90 * k, 90 * k + 90) for k in (0, 1)]
    spokes = [stroke((150, 40), end) for end in ((175, 40), (150, 65), (125, 40))]

    assert len(interpret(Sheet((OUTSIDE, WALL, *leaves, *chart, *spokes))).sketch.doors) == 3


@pytest.mark.parametrize(
    "lines",
    [
        [((50, 30), (62, 30))],  # a short wall
        [((50, 30), (58, 39)), ((58, 39), (66, 39))],  # it goes on: a corner cupboard
        [((50, 30), (56, 36)), ((50, 30), (44, 36))],  # an arrow
        [((60, 30), (66, 36))],  # far from any wall
    ],
)
def test_what_is_upright_goes_on_or_is_an_arrow_is_no_leaf(lines):
    assert Role.DOOR not in roles((OUTSIDE, WALL, *(stroke(*points) for points in lines)))


def test_a_leaf_may_have_a_thickness():
    leaf = box(50, 29.5, 62, 30.5, pen=PEN)

    assert are_joined((OUTSIDE, WALL, leaf, arc((50, 30), 12, 0, 90)))


@pytest.mark.parametrize("angles", [(0, 90), (90, 0)])
def test_a_leaf_that_leans_on_a_wall_is_no_opening(angles):
    walls = [box(*bounds, fill=BLACK) for bounds in [*OUTER, (48, 0, 52, 5.5), (48, 17.5, 52, 80)]]
    leaf, threshold = (stroke((52, 5.5), end) for end in ((64, 5.5), (52, 17.5)))
    door = arc((52, 5.5), 12, *angles)

    sketch = interpret(Sheet((*walls, leaf, threshold, door))).sketch

    assert [sorted(line.vertices.round(3).tolist()) for line in sketch.doors] == [[[52, 5.5], [52, 17.5]]]


def test_a_leaf_that_leans_on_a_wall_stands_open_though_the_outline_of_its_room_runs_along_the_opening():
    walls = [box(*bounds, fill=BLACK) for bounds in [*OUTER, (48, 0, 52, 5.2), (48, 17.2, 52, 80)]]
    room = box(52, 4, 96, 76, pen=PEN)
    leaf, swing = stroke((52, 5.2), (64, 5.2)), arc((52, 5.2), 12, 0, 90)

    sketch = interpret(Sheet((*walls, room, leaf, swing))).sketch

    assert [sorted(line.vertices.round(3).tolist()) for line in sketch.doors] == [[[52, 5.2], [52, 17.2]]]


def test_a_leaf_that_is_drawn_in_the_gap_of_its_wall_is_shut():
    walls = [box(*bounds, fill=BLACK) for bounds in [*OUTER, (48, 0, 52, 64), (48, 76, 52, 80)]]
    leaf, swing = stroke((52, 76), (52, 64)), arc((52, 76), 12, -90, 0)

    assert are_joined((*walls, leaf, swing))


@pytest.mark.parametrize("beyond", [(), (stroke((65, 0), (65, 80)),)])
def test_a_leaf_in_the_gap_of_a_line_is_shut_if_nothing_or_a_wall_across_lies_beyond_the_open_door(beyond):
    leaf, swing = stroke((50, 30), (50, 42)), arc((50, 30), 12, 0, 90)
    sketch = interpret(Sheet((*WITH_GAP, *beyond, leaf, swing))).sketch

    assert [sorted(line.vertices.round(3).tolist()) for line in sketch.doors] == [[[50, 30], [50, 42]]]


def test_where_leaves_are_drawn_on_walls_so_they_are_in_corners():
    rooms = [box(*bounds, pen=PEN) for bounds in [(0, 0, 50, 40), (50, 0, 100, 40), (0, 40, 100, 80)]]
    plain = (stroke((20, 40), (32, 40)), arc((20, 40), 12, -90, 0))
    in_corner = (stroke((50, 40), (50, 28)), arc((50, 40), 12, 180, 270))

    sketch = interpret(Sheet((*rooms, *plain, *in_corner))).sketch

    assert sorted(sorted(line.vertices.round(3).tolist()) for line in sketch.doors) == [
        [[20, 40], [32, 40]],
        [[50, 28], [50, 40]],
    ]


def test_a_symbol_that_is_turned_the_wrong_way_opens_the_wall_that_it_touches():
    leaf, swing = stroke((62, 30), (62, 42)), arc((62, 30), 12, 90, 180)
    threshold = stroke((62, 30), (50, 30))

    for symbol in ((leaf, swing), (leaf, swing, threshold)):
        doors = interpret(Sheet((OUTSIDE, WALL, *symbol))).sketch.doors
        assert [sorted(line.vertices.round(3).tolist()) for line in doors] == [[[50, 30], [50, 42]]]


def test_two_leaves_make_one_double_door():
    lower = (stroke((50, 30), (57, 30)), arc((50, 30), 7, 0, 90))
    upper = (stroke((50, 44), (57, 44)), arc((50, 44), 7, -90, 0))

    marks = (OUTSIDE, WALL, *lower, *upper)

    assert are_joined(marks)
    assert [Role.DOOR] * 4 == roles(marks)[2:]


def gated(top):
    """Draw two rooms with five doors between them, and a gate whose upper leaf may hang too high."""
    jambs = [0, 6, 14, 20, 28, 34, 42, 48, 56, 62, 70, 80]
    inner = [(48, jambs[k], 52, jambs[k + 1]) for k in range(0, len(jambs), 2)]
    walls = [*OUTER[:3], (96, 0, 100, 24), (96, 56, 100, 80), *inner]
    doors = [part for y in jambs[1:-1:2] for part in (arc((52, y), 8, 0, 90), stroke((52, y), (60, y)))]
    lower = arc((98, 24), 16, 0, 90), stroke((98, 24), (114, 24))
    upper = arc((98, top), 16, 270, 360), stroke((98, top), (114, top))
    return [*(box(*bounds, fill=BLACK) for bounds in walls), *doors, *lower, *upper]


@pytest.mark.parametrize(("top", "doors"), [(56, 7), (70, 5)])
def test_two_leaves_that_meet_are_a_gate_though_far_wider_than_the_doors(top, doors):
    assert len(interpret(Sheet(tuple(gated(top)))).sketch.doors) == doors


def test_an_arc_far_from_any_wall_is_no_door():
    lamp = arc((20, 20), 8, 0, 90)

    assert Role.DOOR not in roles((OUTSIDE, WALL, lamp))


def test_many_small_arcs_of_a_plant_do_not_make_doors_small():
    door = (WALL, stroke((50, 30), (62, 30)), arc((50, 30), 12, 0, 90))
    leaves = [
        mark
        for k in range(15)
        for x, y in [(60.0 + 6.0 * (k % 5), 50.0 + 6.0 * (k // 5))]
        for mark in (stroke((x, y), (x + 2, y)), arc((x, y), 2, 0, 30))
    ]

    assert [Role.WALL, Role.WALL, Role.DOOR, Role.DOOR] == roles((OUTSIDE, *door, *leaves))[:4]
    assert Role.DOOR not in roles((OUTSIDE, *door, *leaves))[4:]


def test_walls_of_two_lines_have_a_thickness_and_doors_cut_both():
    faces = (OUTSIDE, box(3, 3, 48.5, 77, pen=PEN), box(51.5, 3, 97, 77, pen=PEN))
    door = (stroke((51.5, 30), (63.5, 30)), arc((51.5, 30), 12, 0, 90))

    assert interpret(Sheet(faces)).sketch.solids
    assert not are_joined(faces)
    assert are_joined((*faces, *door))


def test_painted_walls_are_cut_where_a_door_is_drawn_over_them():
    outer = [box(*sides, fill=BLACK) for sides in OUTER]
    door = (stroke((52, 30), (64, 30)), arc((52, 30), 12, 0, 90))

    assert not are_joined((*outer, box(48, 0, 52, 80, fill=BLACK)))
    assert are_joined((*outer, box(48, 0, 52, 80, fill=BLACK), *door))


def test_a_window_in_an_outer_wall_closes():
    broken = [(0, 0, 20, 4), (32, 0, 100, 4), *OUTER[1:]]
    painted = [box(*sides, fill=BLACK) for sides in broken + INNER]
    glass = [stroke((20, y), (32, y)) for y in (0.0, 2.0, 4.0)]

    whole = [box(*sides, fill=BLACK) for sides in OUTER + INNER]

    assert are_joined((*painted, *glass))
    assert len(graph_of(whole).cells) == len(graph_of((*painted, *glass)).cells)
    solid = interpret(Sheet((*painted, *glass))).sketch.solids
    assert any(line.vertices[:, 0].min() < 20 and line.vertices[:, 0].max() > 32 for line in solid)


def test_a_door_drawn_shut_opens_although_the_front_door_stands_open():
    broken = [(0, 0, 20, 4), (32, 0, 100, 4), *OUTER[1:]]
    painted = [box(*sides, fill=BLACK) for sides in broken + INNER]
    front = (stroke((20, 4), (20, 16)), arc((20, 4), 12, 0, 90))
    shut = [stroke((x, 30), (x, 42)) for x in (48.0, 52.0)]

    assert {"bath", "hall"} in ends_of_gateways((*painted, *front, *shut))


def test_a_thin_panel_in_a_color_of_its_own_is_a_sliding_door_inside_and_a_pane_outside():
    cyan = (0.0, 0.6, 0.6)
    walls = [box(*sides, fill=BLACK) for sides in ((0, 0, 4, 80), (0, 0, 4, 4), (96, 0, 100, 80), *INNER)]
    panes = [box(*sides, fill=cyan) for sides in ((4, 1.5, 96, 2.5), (4, 77.5, 96, 78.5))]
    front = (stroke((96, 20), (84, 20)), arc((96, 20), 12, 90, 180))
    panel = box(49.5, 30, 50.5, 42, fill=cyan)

    assert {"bath", "hall"} in ends_of_gateways((*walls, *panes, *front, panel))


@pytest.mark.parametrize(
    ("color", "names", "closed"),
    [((0.5, 0.7, 0.85), (), True), ((0.8, 0.8, 0.8), ("window",), True), ((0.8, 0.7, 0.6), (), False)],
)
def test_a_window_that_is_painted_over_a_wall_closes_it(color, names, closed):
    walls = [box(*sides, fill=BLACK) for sides in (*OUTER, *INNER)]
    pane = box(20, -0.3, 36, 4.3, fill=color, names=names)

    outlines = interpret(Sheet((*walls, pane))).sketch.solids

    assert (2 if closed else 1) == len(outlines)


def test_what_is_named_a_window_closes_though_it_does_not_reach_the_next_wall():
    wall, pane = shapely.box(0, 0, 10, 2), shapely.box(10, 0, 20, 2)
    filled = shapely.union(wall, pane)

    glazed, shut = windows(filled, wall, shapely.LineString([(12, 1), (18, 1)]), 3.0, 12.0)
    nothing, _ = windows(filled, wall, NOTHING, 3.0, 12.0)

    assert 19.9 < glazed.area < 24.0
    assert shut.is_empty
    assert nothing.is_empty


@pytest.mark.parametrize(
    ("depths", "are_panes"),
    [((0.0, 0.7, 1.3, 2.0), True), ((0.0, 2.0), False), ((0.0, 1.5, 3.0, 4.5), False)],
)
def test_three_lines_or_more_within_a_wall_from_jamb_to_jamb_are_a_window(depths, are_panes):
    wall = shapely.union_all([shapely.box(0, 0, 10, depths[-1]), shapely.box(16, 0, 30, depths[-1])])
    lines = shapely.multilinestrings([[(0, depth), (30, depth)] for depth in depths])

    found = panes(lines, wall, 2.2, 12.0)

    assert are_panes is found.buffer(0.1).covers(shapely.box(10, 0, 16, 2))
    assert are_panes is not found.is_empty


def test_windows_close_a_house_within_a_wall_around_its_plot():
    plot = [box(*sides, fill=BLACK) for sides in ((-60, -60, 160, -56), (-60, 136, 160, 140))]
    plot += [box(*sides, fill=BLACK) for sides in ((-60, -60, -56, 140), (156, -60, 160, 140))]
    walls = [box(*sides, fill=BLACK) for sides in ((0, 0, 100, 4), (0, 0, 4, 80), (96, 0, 100, 80), *INNER)]
    walls += [box(*sides, fill=BLACK) for sides in ((0, 76, 20, 80), (40, 76, 100, 80))]
    door = (stroke((96, 20), (84, 20)), arc((96, 20), 12, 90, 180))
    panes = [stroke((20, depth), (40, depth)) for depth in (76.0, 77.3, 78.7, 80.0)]

    graph = graph_of((*plot, *walls, *door, *panes))

    assert graph.gateways
    assert all(shapely.Point(30, 78).distance(shapely.LineString(g.segment)) > 8 for g in graph.gateways)


def test_a_small_building_on_a_large_sheet_has_walls_of_two_faces():
    faces = (box(0, 0, 100, 80, pen=PEN), box(3, 3, 48.5, 77, pen=PEN), box(51.5, 3, 97, 77, pen=PEN))
    road = stroke((900, 900), (1000, 1000))

    assert interpret(Sheet((*faces, road))).sketch.solids


def test_an_outline_with_a_notch_has_a_door():
    swing = arc((50, 30), 12, 0, 90).outlines[0].vertices
    outline = stroke((50, 0), (50, 30), *swing, (50, 80))

    assert are_joined((OUTSIDE, outline))


def test_a_rounded_corner_is_no_door():
    corner = arc((62, 42), 12, 180, 270).outlines[0].vertices
    outline = stroke((50, 80), *corner, (100, 30))

    assert Role.DOOR not in roles((OUTSIDE, outline))


def test_doors_of_a_large_building_with_thick_walls_are_no_slips_of_the_pen():
    walls = [box(*corners, fill=BLACK) for corners in (*OUTER, *INNER)]
    hall = [(100, 0, 1600, 4), (100, 76, 1600, 80), (1596, 0, 1600, 80)]
    wing = [box(*corners, fill=BLACK) for corners in hall]

    assert {"bath", "hall"} in ends_of_gateways((*walls, *wing))


FACES = [(0, 0, 100, 80), (3, 3, 47, 77), (53, 3, 97, 77)]
SHELF = [stroke((6, y), (44, y)) for y in (12, 16, 20)]


def named_flat(*names):
    """Two rooms between double lines, a door with its arc, and a shelf of lines as far apart as a wall's."""
    faces = [box(*corners, pen=PEN, names=names) for corners in FACES]
    door = (stroke((50, 30), (62, 30)), arc((50, 30), 12, 0, 90))
    return (*faces, *SHELF, *door)


def test_where_walls_are_named_and_doors_stand_in_them_there_are_no_others():
    assert roles(named_flat("A-WALL"))[3:6] == [Role.FURNITURE] * 3
    assert are_joined(named_flat("A-WALL"))


def test_where_no_walls_are_named_lines_beside_each_other_are_walls():
    assert roles(named_flat())[3:6] == [Role.WALL] * 3


def test_arcs_on_a_layer_of_furniture_are_no_doors():
    arced = arc((50, 30), 12, 0, 90)
    leaf = stroke((50, 30), (62, 30))
    cupboard = [Mark(mark.outlines, mark.pen, names=("Storage Fittings",)) for mark in (leaf, arced)]

    assert roles((OUTSIDE, WALL, *cupboard)) == [Role.WALL, Role.WALL, Role.FURNITURE, Role.FURNITURE]
    assert not are_joined((OUTSIDE, WALL, *cupboard))


HATCHED = [(0, 0, 100, 80), (2, 2, 49, 78), (51, 2, 98, 78)]


def hatched_flat(*, pause, across=True):
    """Two rooms in double walls, hatched but from y = 32 to 40 in the inner wall or an outer one."""
    inner = [(49, y, 51, y) for y in range(2, 79, 2)]
    outer = [(x, y, x, y + 2) for x in range(2, 99, 2) for y in (0, 78)]
    outer += [(x, y, x + 2, y) for x in (0, 98) for y in range(2, 79, 2)]
    lines = [line for line in inner + outer if line[0] != pause or not 32 < line[1] < 40] if across else []
    return (
        *(box(*corners, pen=PEN) for corners in HATCHED),
        *(stroke(line[:2], line[2:]) for line in lines),
    )


@pytest.mark.parametrize("across", [True, False])
@pytest.mark.parametrize("pause", [49, 0, None])
def test_where_hatching_pauses_between_rooms_there_is_a_door(pause, across):
    doors = ends_of_gateways(hatched_flat(pause=pause, across=across))

    assert doors == ([{"bath", "hall"}] if pause == 49 and across else [])


@pytest.mark.parametrize(
    ("frame", "joined"),
    [((49, 32, 51, 40), True), ((49, 32, 51, 34), False), ((0, 32, 2, 40), False), ((49, 2, 51, 10), False)],
    ids=["door", "column", "window", "at a corner"],
)
def test_a_frame_that_is_laid_over_a_wall_between_rooms_is_a_door(frame, joined):
    flat = tuple(box(*corners, pen=PEN) for corners in HATCHED)

    doors = ends_of_gateways((*flat, box(*frame, pen=PEN, fill=WHITE)))

    assert doors == ([{"bath", "hall"}] if joined else [])


def test_a_door_that_is_drawn_shut_in_a_wall_of_two_faces_leads_from_jamb_to_jamb():
    flat = tuple(box(*corners, pen=PEN) for corners in HATCHED)

    (door,) = interpret(Sheet((*flat, box(49, 32, 51, 40, pen=PEN, fill=WHITE)))).sketch.doors

    assert door.vertices[:, 0] == pytest.approx(50.0, abs=0.1)
    assert sorted(door.vertices[:, 1]) == pytest.approx([32.0, 40.0], abs=0.1)


def test_walls_of_two_faces_enclose_rooms_although_windows_with_two_leaves_stand_open():
    leaves = [
        mark
        for left in (10, 60)
        for hinge, start in ((left, 0), (left + 28, 90))
        for mark in (stroke((hinge, 3), (hinge, 17)), arc((hinge, 3), 14, start, start + 90))
    ]
    faces = [box(*corners, pen=PEN) for corners in ((0, 0, 100, 80), (3, 3, 48.5, 77), (51.5, 3, 97, 77))]

    assert interpret(Sheet((*faces, *leaves))).sketch.solids


PASSAGE = (box(0, 0, 100, 12, pen=PEN), stroke((50, 0), (50, 1)), stroke((50, 11), (50, 12)))
IN_PASSAGE = (Text("bath", (25.0, 6.0), 2.0), Text("hall", (75.0, 6.0), 2.0))


def test_a_door_that_is_drawn_parts_even_where_a_corridor_hardly_narrows():
    door = (stroke((50, 1), (60, 1)), arc((50, 1), 10, 0, 90))

    assert {cell.label for cell in graph_of((*PASSAGE, *door), IN_PASSAGE).cells} == {"bath", "hall"}
    assert [cell.label for cell in graph_of(PASSAGE, IN_PASSAGE).cells] == ["bath, hall"]


def test_walls_without_their_slivers_are_areas_where_they_touch_one_along_a_line():
    solid = shapely.multipolygons([shapely.box(0, 0, 8, 8), shapely.box(8.0078125, 0, 8.03125, 8)])

    body = without_slivers(solid, 0.78125)

    assert {2} == set(shapely.get_dimensions(shapely.get_parts(body)).tolist())
    assert body.area == pytest.approx(64.0)
