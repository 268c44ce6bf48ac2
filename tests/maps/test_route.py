import numpy as np
import pytest

from pilotage.geometry import Polyline
from pilotage.maps import (
    DecompositionSettings,
    Label,
    RouteError,
    RouteSettings,
    SchematicMap,
    check_place,
    check_reachable,
    decompose,
    find_labeled,
    find_route,
)


def decomposed(*strokes, labels=()):
    sketch = SchematicMap(tuple(Polyline.through(stroke) for stroke in strokes), labels=labels)
    return decompose(sketch, DecompositionSettings())


SUITE = (
    [(0, 0), (15, 0), (15, 5), (0, 5), (0, 0)],
    [(5, 0), (5, 2)],
    [(5, 3), (5, 5)],
    [(10, 0), (10, 2)],
    [(10, 3), (10, 5)],
)
RING = (
    [(0, 0), (20, 0), (20, 10), (0, 10), (0, 0)],
    [(3, 3), (17, 3), (17, 7), (3, 7), (3, 3)],
)


def test_a_route_leads_from_cell_to_cell_through_their_gateways():
    graph = decomposed(*SUITE)
    route = find_route(graph, (1.0, 2.5), (14.0, 2.5), RouteSettings())

    assert tuple(graph.cell_at(place) for place in [(1, 1), (7, 1), (14, 1)]) == route.cell_ids
    assert 2 == len(route.gateway_ids)
    assert pytest.approx(13.0, abs=0.01) == np.hypot(*np.diff(route.way, axis=0).T).sum()


def test_a_longer_way_costs_more_and_no_way_costs_nothing():
    graph = decomposed(*SUITE)
    near = find_route(graph, (1.0, 2.5), (7.0, 2.5), RouteSettings())
    far = find_route(graph, (1.0, 2.5), (14.0, 2.5), RouteSettings())
    here = find_route(graph, (1.0, 2.5), (1.0, 2.5), RouteSettings())

    assert here.cost == pytest.approx(0.0)
    assert here.cost < near.cost < far.cost


def test_a_way_goes_around_a_block_and_not_through_it():
    graph = decomposed(*RING)
    route = find_route(graph, (10.0, 1.5), (10.0, 8.5), RouteSettings())

    assert () == route.gateway_ids
    assert np.hypot(*np.diff(route.way, axis=0).T).sum() > 14.0


def test_a_closed_gateway_is_not_gone_through():
    graph = decomposed(*SUITE)
    (first, second) = find_route(graph, (1.0, 2.5), (14.0, 2.5), RouteSettings()).gateway_ids

    with pytest.raises(RouteError, match=r"no way leads.*: blocked gateways"):
        find_route(graph, (1.0, 2.5), (14.0, 2.5), RouteSettings(), closed={second})
    assert (first,) == find_route(graph, (1.0, 2.5), (7.0, 2.5), RouteSettings(), closed={second}).gateway_ids


def test_of_two_ways_the_one_through_the_wider_gateway_is_taken():
    two_doors = (
        [(0, 0), (10, 0), (10, 10), (0, 10), (0, 0)],
        [(5, 0), (5, 2.0)],
        [(5, 2.5), (5, 7)],
        [(5, 8.5), (5, 10)],
    )
    graph = decomposed(*two_doors)
    route = find_route(graph, (2.0, 5.0), (8.0, 5.0), RouteSettings(narrowness=0.01))

    assert 7.0 < graph.gateway(route.gateway_ids[0]).middle[1] < 8.5


def test_a_room_without_a_door_cannot_be_reached():
    graph = decomposed(*SUITE, [(15, 0), (20, 0), (20, 5), (15, 5)])

    with pytest.raises(RouteError, match=r"no way leads.*: no gateways join them"):
        find_route(graph, (1.0, 2.5), (18.0, 2.5), RouteSettings())


def test_a_label_names_a_place_in_its_cell():
    graph = decomposed(*SUITE, labels=(Label("Kitchen", (7.0, 1.0)),))

    assert graph.cell_at((7.0, 1.0)) == graph.cell_at(find_labeled(graph, "kitchen"))


def test_a_label_must_stand_in_one_cell():
    graph = decomposed(*SUITE, labels=(Label("office", (1.0, 1.0)), Label("office", (7.0, 1.0))))

    with pytest.raises(RouteError, match="stands in 2 cells"):
        find_labeled(graph, "office")
    with pytest.raises(RouteError, match="stands in no cell, labels in cells are: office"):
        find_labeled(graph, "kitchen")


@pytest.mark.parametrize(
    "words", ["SMITH,  J.", " smith, j. ", "Bu\N{COMBINING DIAERESIS}ro", "Smith, J., Büro"]
)
def test_case_blanks_commas_and_the_writing_of_accents_do_not_keep_a_label_from_being_found(words):
    graph = decomposed(*SUITE, labels=(Label("Smith, J.", (7.0, 1.0)), Label("Büro", (7.5, 2.0))))

    assert graph.cell_at((7.0, 1.0)) == graph.cell_at(find_labeled(graph, words))


def test_no_words_name_no_place():
    graph = decomposed(*SUITE, labels=(Label("a", (1.0, 1.0)), Label("b", (7.0, 1.0))))

    with pytest.raises(RouteError, match="needs a name or two numbers"):
        find_labeled(graph, " ")


def test_a_room_without_a_name_of_its_own_is_called_by_its_id():
    graph = decomposed(*SUITE, labels=(Label("WC", (1.0, 1.0)), Label("WC", (7.0, 1.0))))

    assert "wc-2" == graph.cell_at(find_labeled(graph, "wc-2"))
    with pytest.raises(RouteError, match="stands in 2 cells"):
        find_labeled(graph, "wc")


def test_a_place_must_be_free():
    graph = decomposed(*RING)

    check_place(graph, (1.0, 1.0), "goal")
    with pytest.raises(RouteError, match="goal lies in a wall"):
        check_place(graph, (10.0, 5.0), "goal")
    with pytest.raises(RouteError, match="start lies outside the drawing"):
        check_place(graph, (30.0, 5.0), "start")


APART = (
    [(0, 0), (10, 0), (10, 5), (0, 5), (0, 0)],
    [(5, 0), (5, 2)],
    [(5, 3), (5, 5)],
    [(20, 0), (24, 0), (24, 4), (20, 4), (20, 0)],
)
"""Two rooms that a door joins, and a smaller one apart."""


def test_a_goal_must_hang_together_with_the_start_or_with_most_of_the_drawing():
    graph = decomposed(*APART)
    check_reachable(graph, (1.0, 1.0))
    check_reachable(graph, (1.0, 1.0), start=(9.0, 1.0))
    check_reachable(graph, (22.0, 2.0), start=(21.0, 2.0))

    with pytest.raises(RouteError, match="no way leads from cell"):
        check_reachable(graph, (22.0, 2.0), start=(1.0, 1.0))
    with pytest.raises(RouteError, match="no gateways lead from the largest part"):
        check_reachable(graph, (22.0, 2.0))
