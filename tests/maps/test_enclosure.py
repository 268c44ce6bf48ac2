from pilotage.geometry import Polyline
from pilotage.io import open_map
from pilotage.maps import DecompositionSettings, SchematicMap, decompose
from shared_data import SKETCHES, needs_sketches


def decomposed(*strokes):
    return decompose(
        SchematicMap(tuple(Polyline.through(stroke) for stroke in strokes)), DecompositionSettings()
    )


HALL = [(0, 0), (40, 0), (40, 20), (0, 20), (0, 0)]


def holds(graph, point):
    return graph.distance_to(graph.cell_at(point), point) == 0.0


def test_a_yard_between_two_wings_is_outside():
    wings = [(0, 0), (30, 0), (30, 20), (22, 20), (22, 8), (8, 8), (8, 20), (0, 20), (0, 0)]
    graph = decomposed(wings)

    assert holds(graph, (4.0, 15.0))
    assert not holds(graph, (15.0, 15.0))


def test_a_corridor_whose_end_is_open_is_inside():
    graph = decomposed([(50, 9), (40, 9), (40, 0), (0, 0), (0, 20), (40, 20), (40, 12), (50, 12)])

    assert holds(graph, (45.0, 10.5))
    assert 2 == len(graph.cells)


def test_a_closed_block_amid_a_hall_is_solid():
    graph = decomposed(HALL, [(10, 5), (30, 5), (30, 15), (10, 15), (10, 5)])

    assert holds(graph, (5.0, 10.0))
    assert not holds(graph, (20.0, 10.0))


def test_a_block_with_a_door_is_a_room():
    graph = decomposed(HALL, [(19, 5), (10, 5), (10, 15), (30, 15), (30, 5), (21, 5)])

    assert holds(graph, (20.0, 10.0))


def test_a_room_at_the_outer_wall_needs_no_door():
    graph = decomposed(HALL, [(30, 0), (30, 20)])

    assert holds(graph, (35.0, 10.0))


def test_where_most_rooms_are_closed_none_is_a_block():
    rows = [(0, 7), (40, 7)], [(0, 13), (40, 13)]
    columns = [(13, 0), (13, 3)], [(13, 5), (13, 20)], [(27, 0), (27, 20)]
    graph = decomposed(HALL, *rows, *columns)

    assert holds(graph, (20.0, 10.0))


@needs_sketches
def test_in_a_sketch_a_corridor_beyond_a_yard_is_inside_and_the_block_beside_it_is_not():
    graph = decompose(open_map(SKETCHES / "csail" / "quick.svg"), DecompositionSettings())

    assert holds(graph, (183.6, -257.3))
    assert not holds(graph, (187.2, -236.4))
