import numpy as np
import pytest

from pilotage.maps import Route
from pilotage.navigation.closures import Closures, ClosureSettings
from pilotage.navigation.guidance import Leg

SETTINGS = ClosureSettings(close_by=1.5, behind=0.8, before=3.0, lasting=100.0)
HERE = np.zeros(2)


def leg(away, gateway_id="g1"):
    way = np.array([[0.0, 0.0], [away, 0.0], [away + 1.0, 0.0]])
    route = Route(("c1", "c2"), ("g1",), 0.1, way)
    return Leg(route, way, np.array([away + 1.0, 0.0]), gateway_id, np.array([away, 0.0]))


def faced(seconds, *, gap=0.0, away=1.0, here=lambda _: HERE, gateways=("g1",)):
    closures = Closures()
    for step in range(int(seconds / 0.5)):
        ahead = leg(away, gateways[step % len(gateways)])
        closures = closures.faced(
            ahead, SETTINGS, here=here(step), gap=gap, stamp=0.5 * step, lasted=0.5, patience=8.0
        )
    return closures


def test_a_gateway_that_is_not_got_through_for_long_is_closed():
    assert () == faced(8.0).gateway_ids
    assert ("g1",) == faced(9.0).gateway_ids


def test_it_is_closed_sooner_where_nothing_behind_it_can_be_come_near_to():
    assert ("g1",) == faced(5.0, gap=2.0).gateway_ids


def test_going_to_and_fro_between_two_gateways_closes_both():
    assert {"g1", "g2"} == set(faced(18.0, gateways=("g1", "g2")).gateway_ids)


def test_a_gateway_far_off_is_not_closed_nor_one_that_the_robot_comes_by():
    assert () == faced(60.0, away=2.0).gateway_ids
    assert () == faced(60.0, here=lambda step: np.array([0.3 * step, 0.0])).gateway_ids


def test_the_gateway_near_by_is_blamed_where_the_robot_is_stuck():
    assert ("g1",) == Closures().blamed(leg(2.0), 5.0, SETTINGS).gateway_ids
    assert () == Closures().blamed(leg(4.0), 5.0, SETTINGS).gateway_ids
    assert () == Closures().blamed(leg(2.0, ""), 5.0, SETTINGS).gateway_ids


def test_what_was_closed_long_ago_is_tried_again():
    closed = Closures().blamed(leg(2.0), 5.0, SETTINGS)

    assert ("g1",) == closed.lasting(100.0, SETTINGS).gateway_ids
    assert () == closed.lasting(106.0, SETTINGS).gateway_ids
    assert () == closed.opened().gateway_ids


def test_what_cannot_be_meant_is_refused():
    with pytest.raises(ValueError, match="close_by must be >= 0, got -1"):
        ClosureSettings(close_by=-1.0)
