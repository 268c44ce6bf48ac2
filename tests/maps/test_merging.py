import numpy as np
import pytest
import shapely

from pilotage.geometry import Polyline
from pilotage.maps import DecompositionSettings, Label, SchematicMap, decompose
from pilotage.maps.cells.narrowings import find_jambs
from pilotage.maps.cells.tessellation import tessellate


def count_cells(*strokes, settings=None):
    sketch = SchematicMap(tuple(Polyline.through(stroke) for stroke in strokes))
    return len(decompose(sketch, settings or DecompositionSettings()).cells)


def test_a_row_of_columns_is_one_wide_opening():
    room = [(0, 0), (20, 0), (20, 10), (0, 10), (0, 0)]
    columns = [[(10, y), (10, y + 0.5)] for y in (1.5, 3.5, 5.5, 7.5)]

    assert 1 == count_cells(room, *columns)


def test_corridors_that_cross_are_one_cell_although_one_is_a_little_wider():
    """Where corridors 2 and 2.2 wide cross, free space is 1.49 times as wide as the first."""
    outline = [(0, 0), (34, 0), (34, 22), (0, 22), (0, 0)]
    rooms = [
        [(left, wall), (left + 3, wall), (left + 4, wall), (right, wall)]
        for wall in (10, 12)
        for left, right in ((0, 10), (12.2, 21.8), (24, 34))
    ]
    across = [[(x, y), (x, y + 10)] for x in (10, 12.2, 21.8, 24) for y in (0, 12)]

    assert 7 == count_cells(outline, *parted(rooms), *across)


def parted(lines):
    """Break lines at their gaps."""
    return [part for line in lines for part in (line[:2], line[2:])]


def test_the_space_in_the_wall_of_a_front_door_is_of_its_room_unless_it_has_a_name():
    free = [(0, 0, 6, 5), (6.5, 0, 12, 5), (6, 2, 6.5, 3), (2, 5, 3, 5.5)]
    walls = shapely.box(-0.5, -0.5, 12.5, 5.5) - shapely.union_all([shapely.box(*sides) for sides in free])
    porch = within(outline_of(walls), (Label("Porch", (2.5, 5.25)),))

    assert 2 == len(within(outline_of(walls)).cells)
    assert 3 == len(porch.cells)
    assert "porch" in porch.index_from_id


def test_a_niche_in_a_thick_wall_is_of_its_room_unless_it_has_a_name():
    free = [(0, 0, 12, 8), (2, 8, 3.5, 8.6), (6, 8, 8, 9.5)]
    alcove = (Label("Alcove", (2.7, 8.3)),)

    assert 2 == len(thick(free).cells)
    assert 3 == len(thick(free, alcove).cells)


def test_two_doors_of_one_room_are_no_wide_opening_between_lines():
    rooms = [(0, 0), (20, 0), (20, 9), (0, 9), (0, 0)]
    wall = [[(0, 4), (3, 4)], [(5, 4), (15, 4)], [(17, 4), (20, 4)]]

    assert 2 == count_cells(rooms, *wall)


def test_a_hollow_of_a_wall_belongs_to_its_room():
    window = [(0, 0), (20, 0), (20, 10), (12, 10), (12, 10.4), (9, 10.4), (9, 10), (0, 10), (0, 0)]

    assert 1 == count_cells(window)


def test_an_alcove_as_deep_as_wide_is_a_cell_of_its_own():
    alcove = [(0, 0), (20, 0), (20, 10), (12, 10), (12, 13), (9, 13), (9, 10), (0, 10), (0, 0)]

    assert 2 == count_cells(alcove)


def test_a_niche_wider_than_deep_is_cut_at_its_mouth():
    niche = [(0, 0), (20, 0), (20, 10), (13, 10), (13, 12.2), (7, 12.2), (7, 10), (0, 10), (0, 0)]

    assert 2 == count_cells(niche)


def test_a_gap_between_jambs_is_a_door_although_it_is_wide():
    rooms = [(0, 0), (20, 0), (20, 6), (0, 6), (0, 0)]

    assert 2 == count_cells(rooms, [(10, 0), (10, 1)], [(10, 5), (10, 6)])
    assert 1 == count_cells(rooms, [(10, 0), (10, 0.3)], [(10, 5.7), (10, 6)])


def test_cells_below_the_least_area_are_merged():
    suite = [(0, 0), (20, 0), (20, 10), (0, 10), (0, 0)], [(0, 2), (1.2, 2), (1.2, 1.2)]

    assert 2 == count_cells(*suite)
    assert 1 == count_cells(*suite, settings=DecompositionSettings(min_cell_area=0.05))


def test_jambs_tell_a_door_from_the_cut_of_a_corridor():
    walls = np.array(
        [(0, 0, 20, 0), (20, 0, 20, 6), (20, 6, 0, 6), (0, 6, 0, 0), (10, 0, 10, 2), (10, 4, 10, 6)],
        dtype=np.float64,
    )
    door, cut = np.array([[[10, 2], [10, 4]], [[5, 0], [5, 6]]], dtype=np.float64)

    assert [3.0, 1.0] == pytest.approx(find_jambs(np.stack([door, cut]), walls), abs=1e-6)


def test_pieces_cover_what_walls_enclose_and_openings_lie_between_them():
    walls = np.array(
        [(0, 0, 20, 0), (20, 0, 20, 6), (20, 6, 0, 6), (0, 6, 0, 0), (10, 0, 10, 2), (10, 4, 10, 6)],
        dtype=np.float64,
    )
    tessellation = tessellate(walls)

    assert 120.0 == pytest.approx(tessellation.areas.sum())
    assert [2.0] == pytest.approx(tessellation.widths)
    left, right = (tessellation.pieces[side].centroid for side in tessellation.sides[0])
    along = tessellation.chords[0, 1] - tessellation.chords[0, 0]
    assert along[0] * (left.y - right.y) - along[1] * (left.x - right.x) > 0.0


def thick(free, labels=()):
    """A plan of thick walls about what is free: rectangles, by left, bottom, right and top."""
    space = shapely.union_all([shapely.box(*sides) for sides in free])
    outer = shapely.box(*space.bounds).buffer(0.5, join_style="mitre")
    return within(
        [outer.exterior, *(ring for part in shapely.get_parts(space) for ring in outline_of(part))], labels
    )


def within(rings, labels=()):
    lines = tuple(Polyline(shapely.get_coordinates(ring)[:-1], closed=True) for ring in rings)
    return decompose(SchematicMap(lines, solids=lines, labels=labels), DecompositionSettings())


def outline_of(shape):
    return shape.exterior, *shape.interiors


CORRIDOR = [(0, 0, 12, 2), (12, 0, 16, 4), (14, 4, 16, 14)]  # it widens, and turns
OFFICES = [(0, 2.5, 5, 8), (5.5, 2.5, 11, 8), (8, 8.5, 13.5, 13.5)]
DOORS = [(2, 2, 3, 2.5), (8, 2, 9, 2.5), (13.5, 10, 14, 11)]


def test_a_corridor_that_widens_and_turns_is_one_cell_between_thick_walls():
    graph = thick([*CORRIDOR, *OFFICES, *DOORS])

    assert 4 == len(graph.cells)
    assert 3 == max(len(graph.gateways_of(cell.cell_id)) for cell in graph.cells)


def test_two_doors_of_one_room_are_no_wide_opening_but_gaps_between_columns_are():
    rooms = [(0, 0, 12, 2), (2, 2.5, 10, 5)]
    doors = [(3, 2, 4.2, 2.5), (7.8, 2, 9, 2.5)]
    halls = [(0, 0, 12, 2.8), (0, 3.2, 12, 6)]
    between_columns = [(2.0 * k, 2.8, 2.0 * k + 1.6, 3.2) for k in range(6)]

    assert 2 == len(thick([*rooms, *doors]).cells)
    assert 1 == len(thick([*halls, *between_columns]).cells)


def test_a_free_standing_wall_parts_rooms_between_thick_walls_and_a_screen_none_between_lines():
    halls, openings = [(0, 0, 8, 5), (0, 5.4, 8, 10)], [(0, 5, 2.2, 5.4), (5.8, 5, 8, 5.4)]
    outline = [(0, 0), (8, 0), (8, 10), (0, 10), (0, 0)]

    assert 2 == len(thick([*halls, *openings]).cells)
    assert 1 == count_cells(outline, [(2.2, 5), (5.8, 5)])


def test_two_names_in_a_corridor_keep_its_pieces_apart():
    labels = (Label("east", (2.0, 1.0)), Label("lobby", (14.0, 2.0)))

    assert 4 < len(thick([*CORRIDOR, *OFFICES, *DOORS], labels).cells)


def test_a_closet_with_a_name_is_a_cell_however_small():
    closet = [(11.4, 4, 11.74, 4.34), (11, 4.04, 11.4, 4.3)]
    name = Label("closet", (11.6, 4.2))
    office = Label("office", (8.0, 5.0))

    assert "closet" in {
        cell.label for cell in thick([*CORRIDOR, *OFFICES, *DOORS, *closet], (name, office)).cells
    }


def test_a_corridor_that_narrows_for_a_while_is_one_cell():
    corridor = [(0, 0, 10, 2.4), (10, 0.4, 18, 1.9), (18, 0, 28, 2.4)]
    rooms = [(1, 2.9, 8, 8), (19, 2.9, 27, 8), (4, 2.4, 5, 2.9), (22, 2.4, 23, 2.9)]

    assert 3 == len(thick([*corridor, *rooms]).cells)


def test_a_door_between_two_corridors_parts_them_in_a_wall_as_thick_as_half_of_it():
    corridors = [(0, 0, 10, 2.2), (10.7, 0, 20, 2.2), (10, 0.4, 10.7, 1.8)]
    rooms = [(1, 2.7, 8, 8), (12, 2.7, 19, 8), (4, 2.2, 5, 2.7), (15, 2.2, 16, 2.7)]

    assert 4 == len(thick([*corridors, *rooms]).cells)


@pytest.mark.parametrize("turns", range(4))
def test_what_lies_before_a_door_is_of_the_corridor_however_small(turns):
    rooms = [(20 * k, 2.5, 20 * k + 19, 22) for k in range(6)]
    doors = [(20 * k + x, 2, 20 * k + x + 0.8, 2.5) for k in range(6) for x in (3, 15)]
    graph = thick([turned(sides, turns) for sides in ((0, 0, 119, 2), *rooms, *doors)])
    areas = sorted(cell.polygon.area for cell in graph.cells)

    assert [238.0] + [19 * 19.5] * 6 == pytest.approx(areas, abs=1.5)


def turned(sides, turns):
    """A rectangle after quarter turns about the origin."""
    for _ in range(turns):
        left, bottom, right, top = sides
        sides = (-top, left, -bottom, right)
    return sides
