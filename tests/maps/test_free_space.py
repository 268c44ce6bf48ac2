import numpy as np
import pytest
import shapely

from pilotage.geometry import Polyline
from pilotage.maps import DecompositionSettings, NotEnclosedError, SchematicMap, decompose, free_space

ROOM = [(0, 0), (10, 0), (10, 5), (0, 5), (0, 0)]


def found(*strokes, settings=DecompositionSettings(), contours=False):  # noqa: B008  # frozen
    sketch = SchematicMap(
        tuple(Polyline.through(stroke, closed=contours) for stroke in strokes), contours=contours
    )
    return free_space(sketch, settings)


def test_a_closed_stroke_encloses_its_room():
    assert pytest.approx(50.0, rel=1e-6) == found(ROOM).region.area


def test_a_wall_amid_a_room_takes_nothing_from_it():
    assert pytest.approx(50.0, rel=1e-6) == found(ROOM, [(5, 1), (5, 4)]).region.area


def test_a_gap_at_a_corner_is_mended():
    assert (
        pytest.approx(50.0, rel=0.01) == found([(0.05, 0), (10, 0), (10, 5), (0, 5), (0, 0.05)]).region.area
    )


def test_overshooting_strokes_change_nothing():
    crossing = [[(-1, 0), (11, 0)], [(10, -1), (10, 6)], [(11, 5), (-1, 5)], [(0, 6), (0, -1)]]

    assert pytest.approx(50.0, rel=1e-6) == found(*crossing).region.area


def test_the_outside_stays_outside_of_an_open_door():
    assert pytest.approx(50.0, rel=1e-6) == found([(1, 0), (10, 0), (10, 5), (0, 5), (0, 0)]).region.area


def test_what_is_wide_open_is_outside():
    with pytest.raises(NotEnclosedError, match="no closed room"):
        found([(0, 0), (0, 5), (10, 5), (10, 0)])


def test_a_drawn_gate_closes_though_it_is_wide():
    yard, gate = Polyline.through([(0, 0), (0, 5), (10, 5), (10, 0)]), Polyline.through([(0, 0), (10, 0)])

    space = free_space(SchematicMap((yard,), doors=(gate,)), DecompositionSettings())

    assert pytest.approx(50.0, rel=1e-6) == space.region.area
    assert space.drawn.any()


def test_a_way_from_the_jamb_of_a_drawn_door_to_the_next_corner_is_no_door():
    wall, stair = [(5, 0), (5, 3.9)], [(4.5, 5), (4.5, 8), (8, 8), (8, 5)]
    strokes = tuple(map(Polyline.through, (ROOM, wall, stair)))
    door = Polyline.through([(5, 3.9), (5, 5)])

    space = free_space(SchematicMap(strokes, doors=(door,)), DecompositionSettings())
    cells = decompose(SchematicMap(strokes, doors=(door,)), DecompositionSettings()).cells

    assert space.tessellation.chords[space.drawn][:, :, 0] == pytest.approx(np.array([[5, 5]]), abs=0.01)
    assert 3 == len(cells)


def test_a_blot_is_no_wall():
    blot = [(5, 2), (5.05, 2), (5.05, 2.05), (5, 2.05), (5, 2)]
    space = found(ROOM, blot)

    assert 0 == shapely.get_num_interior_rings(space.region)


def test_contours_enclose_by_turns():
    outer, block, yard = (
        [(0, 0), (10, 0), (10, 10), (0, 10)],
        [(2, 2), (2, 8), (8, 8), (8, 2)],
        [(4, 4), (6, 4), (6, 6), (4, 6)],
    )
    space = found(outer, block, yard, contours=True)

    assert pytest.approx(100.0 - 36.0 + 4.0) == space.region.area


def test_nothing_is_outside_of_contours():
    space = found([(0, 0), (10, 0), (10, 10), (0, 10)], contours=True)

    assert not space.outside.any()
    assert np.array_equal([True], space.inside)


@pytest.mark.parametrize("name", ["detail", "gap", "outer_opening", "min_cell_area"])
def test_settings_refuse_what_cannot_be_meant(name):
    with pytest.raises(ValueError, match=name):
        DecompositionSettings(**{name: -1.0})
