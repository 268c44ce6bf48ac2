import itertools
import math
from collections import Counter

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from buildings import CORRIDOR_AND_FOUR_ROOMS
from pilotage.geometry import Polyline, Pose2, Similarity2
from pilotage.io.maps import open_map
from pilotage.maps import CellGraph, CellSize, DecompositionSettings, Label, SchematicMap, decompose
from shared_data import SKETCHES, needs_sketches


def drawing(*strokes, labels=()):
    return SchematicMap(tuple(Polyline.through(stroke) for stroke in strokes), labels=labels)


def decomposed(*strokes, labels=()):
    return decompose(drawing(*strokes, labels=labels), DecompositionSettings())


BOX = [(0, 0), (10, 0), (10, 5), (0, 5), (0, 0)]
TWO_ROOMS = (BOX, [(5, 0), (5, 2)], [(5, 3), (5, 5)])
L_CORRIDOR = ([(0, 0), (12, 0), (12, 10), (10, 10), (10, 2), (0, 2), (0, 0)],)
OFFICE = (*CORRIDOR_AND_FOUR_ROOMS, [(20, 0), (26, 0), (26, 5.5)], [(26, 6.5), (26, 12), (20, 12)])


def test_two_rooms_and_a_door_are_two_cells_and_a_gateway():
    graph = decomposed(*TWO_ROOMS)

    assert 2 == len(graph.cells)
    assert 1 == len(graph.gateways)
    assert pytest.approx(1.0) == graph.gateways[0].width
    assert [5.0, 2.5] == pytest.approx(graph.gateways[0].middle, abs=1e-4)


def test_a_corridor_and_four_rooms_hang_together_like_a_star():
    graph = decomposed(*CORRIDOR_AND_FOUR_ROOMS)
    corridor = graph.cell_at((10.0, 6.0))

    assert 5 == len(graph.cells)
    assert 4 == len(graph.gateways)
    assert all(corridor in gateway.cell_ids for gateway in graph.gateways)


def test_a_corridor_round_a_corner_is_one_cell():
    assert 1 == len(decomposed(*L_CORRIDOR).cells)


def test_a_corridor_keeps_what_lies_between_two_doors():
    walls = [[(0, y), (200, y)] for y in (400, 430)] + [[(220, y), (1200, y)] for y in (400, 430)]
    graph = decomposed([(0, 0), (1200, 0), (1200, 830), (0, 830), (0, 0)], *walls)

    assert len(graph.cells) == 3
    assert [gateway.width for gateway in graph.gateways] == pytest.approx([20.0, 20.0], abs=1e-3)


def test_a_hall_with_rows_of_columns_each_way_is_one_cell():
    columns = [
        [(x, y), (x + 0.5, y), (x + 0.5, y + 0.5), (x, y + 0.5), (x, y)]
        for x in range(6, 36, 6)
        for y in range(6, 30, 6)
    ]
    office = [[(0, 20), (4, 20)], [(5, 20), (5.7, 20), (5.7, 30)]]
    hall = [(0, 0), (40, 0), (40, 30), (0, 30), (0, 0)]

    assert 1 == len(decomposed(hall, *columns).cells)
    assert 2 == len(decomposed(hall, *columns, *office).cells)


def test_corridors_that_cross_are_one_cell():
    rooms = [
        shapely.box(x, y, X, Y)
        for y, Y in ((0, 140), (170, 400), (430, 500))
        for x, X in ((0, 130), (160, 500))
    ]
    doors = [
        [(x, y), (x + 20, y)] for y, x in ((140, 50), (140, 290), (170, 50), (400, 50), (400, 290), (430, 50))
    ]
    walls = shapely.boundary(rooms) - shapely.MultiLineString(doors)
    strokes = [line.coords for line in shapely.get_parts(shapely.line_merge(walls))]
    graph = decomposed([(0, 0), (500, 0), (500, 500), (0, 500), (0, 0)], *strokes)

    assert len(graph.cells) == len(rooms) + 1
    assert [gateway.width for gateway in graph.gateways] == pytest.approx([20.0] * len(doors), abs=1e-3)


def test_a_hall_and_the_corridor_that_opens_into_it_are_two_cells():
    hall_and_corridor = [(0, 0), (8, 0), (8, 3), (20, 3), (20, 5), (8, 5), (8, 8), (0, 8), (0, 0)]

    assert 2 == len(decomposed(hall_and_corridor).cells)


def test_a_hall_half_as_wide_again_as_what_opens_into_it_is_a_cell_only_where_doors_are_rare():
    hall = [(0, 0), (6, 0), (6, 1), (20, 1), (20, 5), (6, 5), (6, 6), (0, 6)]
    room = [(0, 5), (-10, 5), (-10, 0), (0, 0)]

    assert 2 == len(decomposed([*hall, (0, 0)]).cells)
    assert 2 == len(decomposed([*hall, (0, 3)], [(0, 2), (0, 0)], room).cells)


def test_an_unclosed_corner_is_mended_and_a_door_is_not():
    ragged = [(0.05, 0), (10, 0), (10, 5), (0, 5), (0, 0.05)]
    graph = decomposed(ragged, [(5, 0.06), (5, 2)], [(5, 3), (5, 5.2)])

    assert 2 == len(graph.cells)
    assert 1 == len(graph.gateways)


def test_an_opening_in_the_outer_wall_does_not_let_the_outside_in():
    graph = decomposed([(5, 0), (10, 0), (10, 5), (0, 5), (0, 0), (4, 0)], [(5, 0), (5, 2)], [(5, 3), (5, 5)])

    assert 2 == len(graph.cells)
    assert pytest.approx(50.0, rel=1e-3) == sum(cell.polygon.area for cell in graph.cells)


def test_a_block_that_a_corridor_runs_around_is_solid():
    graph = decomposed(BOX, [(2, 1.5), (8, 1.5), (8, 3.5), (2, 3.5), (2, 1.5)])

    assert 1 == len(graph.cells)
    assert 1 == len(graph.cells[0].holes)


def test_words_name_the_cell_in_which_they_stand():
    graph = decomposed(*TWO_ROOMS, labels=(Label("kitchen", (2.0, 2.0)), Label("outside", (-5.0, 0.0))))

    assert "kitchen" == graph.cell(graph.cell_at((1.0, 1.0))).label
    assert "" == graph.cell(graph.cell_at((9.0, 1.0))).label


def test_a_name_that_is_told_replaces_what_is_written_in_its_cell_and_nowhere_else():
    written = (Label("bedroom", (2.0, 2.0)), Label("bedroom", (9.0, 2.0)))
    graph = decomposed(*TWO_ROOMS, labels=(*written, Label("guests", (1.0, 1.0), told=True)))

    assert (
        {"guests", "bedroom"}
        == {cell.label for cell in graph.cells}
        == {cell.cell_id for cell in graph.cells}
    )


def test_sizes_are_relative_to_the_drawing():
    graph = decomposed(*CORRIDOR_AND_FOUR_ROOMS)

    assert Counter({CellSize.MEDIUM: 4, CellSize.LARGE: 1}) == Counter(cell.size for cell in graph.cells)


def test_a_cell_is_defined_everywhere():
    graph = decomposed(*TWO_ROOMS)

    assert graph.cell_at((1.0, 1.0)) == graph.cell_at((-100.0, 2.5))
    assert graph.cell_at((9.0, 1.0)) == graph.cell_at((100.0, 2.5))


def test_neighbors_tell_the_way_through_each_gateway():
    graph = decomposed(*TWO_ROOMS)
    left, right = graph.cell_at((1.0, 1.0)), graph.cell_at((9.0, 1.0))

    (neighbor,) = graph.neighbors(left)

    assert right == neighbor.cell_id
    assert pytest.approx(0.0, abs=0.1) == neighbor.direction
    assert pytest.approx(2.5 / math.hypot(10, 5), rel=0.1) == neighbor.distance


def test_a_drawing_that_encloses_nothing_is_refused():
    with pytest.raises(ValueError, match="encloses none"):
        decomposed([(0, 0), (10, 0)], [(0, 5), (10, 5)])


@st.composite
def similarities(draw):
    angle = draw(st.floats(-math.pi, math.pi))
    scale = draw(st.floats(0.01, 100.0))
    shift = draw(st.tuples(st.floats(-100, 100), st.floats(-100, 100)))
    return Similarity2(scale, Pose2(*shift, angle))


@settings(max_examples=40)
@given(similarities())
def test_turning_and_scaling_the_drawing_changes_nothing_but_coordinates(b_from_a):
    graph = decomposed(*OFFICE)
    moved = decompose(
        SchematicMap(tuple(stroke.moved(b_from_a) for stroke in drawing(*OFFICE).strokes)),
        DecompositionSettings(),
    )

    assert len(graph.cells) == len(moved.cells)
    assert len(graph.gateways) == len(moved.gateways)
    for cell in graph.cells:
        center = b_from_a @ np.array([cell.center])
        twin = moved.cell(moved.cell_at(tuple(center[0])))
        assert pytest.approx(cell.polygon.area * b_from_a.scale**2, rel=1e-3) == twin.polygon.area
        assert len(graph.neighbors(cell.cell_id)) == len(moved.neighbors(twin.cell_id))


@pytest.mark.parametrize("corner", [(5e5, 5.4e6), (-3e7, 2e7)])
def test_a_drawing_in_coordinates_of_a_survey_has_the_same_cells(corner):
    there = np.array(corner)
    graph = decomposed(*OFFICE)
    surveyed = decomposed(*(there + np.array(stroke) for stroke in OFFICE))

    areas, found = ([cell.polygon.area for cell in one.cells] for one in (graph, surveyed))
    assert areas == pytest.approx(found, rel=1e-3)
    middles, same = (sorted(gateway.middle.tolist() for gateway in one.gateways) for one in (graph, surveyed))
    np.testing.assert_allclose(middles + there, same, atol=1e-3, rtol=0.0)


def assert_sound(graph: CellGraph) -> None:
    polygons = np.array([cell.polygon for cell in graph.cells])
    tolerance = 1e-5 * graph.diameter
    assert shapely.is_valid(polygons).all()
    assert shapely.union_all(polygons).area == pytest.approx(shapely.area(polygons).sum(), rel=1e-6)
    for gateway in graph.gateways:
        line = shapely.LineString(gateway.segment)
        touching = {
            cell.cell_id
            for cell in graph.cells
            if cell.polygon.distance(shapely.Point(gateway.middle)) < tolerance
        }
        assert set(gateway.cell_ids) == touching
        assert line.length > 0.0


@st.composite
def floors(draw):
    """Boxes of rooms in rows, with a door in some of the walls."""
    columns, rows = draw(st.integers(1, 4)), draw(st.integers(1, 3))
    xs = np.cumsum([0.0] + [draw(st.floats(3.0, 9.0)) for _ in range(columns)])
    ys = np.cumsum([0.0] + [draw(st.floats(3.0, 9.0)) for _ in range(rows)])
    strokes = [[(xs[0], ys[0]), (xs[-1], ys[0]), (xs[-1], ys[-1]), (xs[0], ys[-1]), (xs[0], ys[0])]]
    walls = [((x, y0), (x, y1)) for x in xs[1:-1] for y0, y1 in itertools.pairwise(ys)]
    walls += [((x0, y), (x1, y)) for y in ys[1:-1] for x0, x1 in itertools.pairwise(xs)]
    for first, last in walls:
        start, stop = np.array(first), np.array(last)
        along = (stop - start) / np.hypot(*(stop - start))
        door = start + draw(st.floats(0.6, 1.4)) * along
        strokes += [[first, tuple(door)], [tuple(door + draw(st.floats(0.7, 1.0)) * along), last]]
    return strokes


@settings(max_examples=40)
@given(floors())
def test_cells_do_not_overlap_and_gateways_border_their_two_cells(strokes):
    graph = decomposed(*strokes)
    box = shapely.box(*drawing(*strokes).bounds)

    assert_sound(graph)
    assert pytest.approx(box.area, rel=1e-3) == sum(cell.polygon.area for cell in graph.cells)


def test_the_same_drawing_gives_the_same_cells():
    once, twice = decomposed(*OFFICE), decomposed(*OFFICE)

    assert [cell.outline.tolist() for cell in once.cells] == [cell.outline.tolist() for cell in twice.cells]
    assert [gate.segment.tolist() for gate in once.gateways] == [
        gate.segment.tolist() for gate in twice.gateways
    ]


@needs_sketches
@pytest.mark.parametrize(
    "name", ["aces/draftsman", "belgioioso/quick", "csail/schematic", "freiburg-079/quick"]
)
def test_drawn_buildings_fall_into_sound_cells(name):
    graph = decompose(open_map(SKETCHES / f"{name}.svg"), DecompositionSettings())

    assert_sound(graph)
    assert 10 <= len(graph.cells) <= 35


@needs_sketches
@pytest.mark.parametrize("name", ["aces/quick", "fhw/draftsman", "freiburg-079/quick"])
def test_drawn_buildings_fall_into_the_same_cells_when_the_sheet_is_turned(name):
    sketch = open_map(SKETCHES / f"{name}.svg")
    turned_from_drawn = Similarity2(0.5, Pose2(5.0, 7.0, 0.7))
    turned = SchematicMap(tuple(stroke.moved(turned_from_drawn) for stroke in sketch.strokes))
    areas, turned_areas = (
        [cell.polygon.area for cell in decompose(drawn, DecompositionSettings()).cells]
        for drawn in (sketch, turned)
    )

    assert [area / 4.0 for area in areas] == pytest.approx(turned_areas, rel=1e-2)
