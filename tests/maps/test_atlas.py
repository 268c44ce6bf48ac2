import math

import numpy as np
import pytest

from buildings import coarse, flat
from pilotage.geometry import Polyline, Pose2, Similarity2
from pilotage.kernels.visibility import LOG_STEP, LOG_ZERO
from pilotage.maps import NotEnclosedError, RangeTableSettings, SchematicMap, build_atlas
from pilotage.maps.range_table import build_range_table


def test_places_are_inside_and_clear_of_walls():
    table = build_range_table(flat(), RangeTableSettings(cells=60))

    x, y = table.places.T
    cut_off = (x > 8) & (y < 3)
    assert (~cut_off & (x > 0) & (x < 10) & (y > 0) & (y < 7)).all()
    assert (table.clearances > 0.3 * table.cell_size).all()


def test_levels_are_the_logarithms_of_ranges():
    square = SchematicMap((Polyline.through([(0, 0), (4, 0), (4, 4), (0, 4)], closed=True),))
    table = build_range_table(square, RangeTableSettings(cells=40, directions=4))

    column, row = 10, 30
    right = table.log_ranges[column * table.rows + row, 0]

    assert round(math.log((4.0 - 1.05) / table.cell_size) / LOG_STEP + LOG_ZERO) == right


def test_where_nothing_is_enclosed_the_robot_can_be_anywhere():
    table = build_range_table(
        SchematicMap((Polyline.through([(0, 0), (4, 1)]),)), RangeTableSettings(cells=20)
    )

    assert table.columns * table.rows == len(table.places)


def test_an_atlas_turns_and_grows_with_its_drawing():
    first = build_atlas(flat(), coarse())
    second = build_atlas(flat(5.0, Pose2(9.0, -4.0, math.pi / 2)), coarse())

    assert len(first.cell_graph.cells) == len(second.cell_graph.cells)
    assert math.isclose(math.log(5.0), second.log_scale - first.log_scale, abs_tol=0.02)
    moved = Similarity2(5.0, Pose2(9.0, -4.0, math.pi / 2)) @ first.corners.vertices
    distances = np.hypot(*(moved[:, None] - second.corners.vertices[None]).transpose(2, 0, 1))
    assert distances.min(axis=1).max() < 0.5


def test_a_drawing_that_encloses_nothing_has_no_cells():
    atlas = build_atlas(SchematicMap((Polyline.through([(0, 0), (4, 1)]),)), coarse())

    assert atlas.cell_graph is None
    assert "" == atlas.cell_at((1.0, 1.0))
    assert [False] == atlas.are_in((), np.ones((1, 2))).tolist()


def test_a_drawing_that_is_all_one_point_is_refused():
    with pytest.raises(NotEnclosedError, match="encloses none"):
        build_atlas(SchematicMap((Polyline.through([(3, 4), (3, 4)]),)), coarse())


def test_points_are_in_the_cells_that_they_lie_in():
    atlas = build_atlas(flat(), coarse())
    points = atlas.range_table.places
    ids = np.array([atlas.cell_at((x, y)) for x, y in points])
    first, second, *_ = atlas.cell_graph.cells

    for chosen in ((first.cell_id,), (first.cell_id, second.cell_id), ()):
        np.testing.assert_array_equal(np.isin(ids, chosen), atlas.are_in(chosen, points))


@pytest.mark.parametrize("cells", [7, 60])
def test_the_middle_of_each_grid_cell_is_on_its_own_line(cells):
    table = build_range_table(flat(3.0, Pose2(-4.0, 9.0, 0.4)), RangeTableSettings(cells=cells, directions=4))

    np.testing.assert_array_equal(np.arange(table.columns * table.rows), table.lines_at(table.middles))
    assert len(table.log_ranges) == len(table.middles)
    assert {tuple(place) for place in table.places} <= {tuple(middle) for middle in table.middles}


def test_points_are_looked_up_where_they_lie_and_off_the_grid_at_its_rim():
    table = build_range_table(flat(), RangeTableSettings(cells=20, directions=4))
    left, bottom, cell, columns, rows = table.grid
    off = np.array([(-50.0, -50.0), (50.0, 50.0), (-50.0, 3.0)])

    beside = table.lines_at(np.array([(left + 2.9 * cell, bottom + 1.1 * cell)]))
    assert [2 * rows + 1] == beside.tolist()
    row = int((3.0 - bottom) / cell)
    assert [0, columns * rows - 1, row] == table.lines_at(off).tolist()


def test_grid_cells_know_which_cell_of_the_drawing_they_lie_in():
    atlas = build_atlas(flat(), coarse())
    table, graph = atlas.range_table, atlas.cell_graph

    assert len(graph.cells) > 1
    found = atlas.cell_indices[table.lines_at(table.places)]
    names = [graph.cells[index].cell_id for index in found]
    assert [atlas.cell_at(tuple(place)) for place in table.places] == names


def test_where_there_are_no_cells_all_grid_cells_are_the_first():
    atlas = build_atlas(SchematicMap((Polyline.through([(0, 0), (4, 1)]),)), coarse())

    assert {0} == set(atlas.cell_indices.tolist())
    assert atlas.range_table.columns * atlas.range_table.rows == len(atlas.cell_indices)
