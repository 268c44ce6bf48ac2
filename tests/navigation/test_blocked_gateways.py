import numpy as np

from pilotage.maps import Route
from pilotage.navigation.blocked_gateways import BlockedGateways
from pilotage.navigation.route_leg import RouteLeg

HERE = np.zeros(2)


def leg(away, gateway_id="g1"):
    way = np.array([[0.0, 0.0], [away, 0.0], [away + 1.0, 0.0]])
    route = Route(("c1", "c2"), ("g1",), 0.1, way)
    return RouteLeg(route, way, np.array([away + 1.0, 0.0]), gateway_id, np.array([away, 0.0]))


def stayed(seconds, *, away=1.0, here=lambda _: HERE, gateways=("g1",)):
    blocked = BlockedGateways()
    for step in range(int(seconds / 0.5)):
        ahead = leg(away, gateways[step % len(gateways)])
        blocked = blocked.stayed_near(ahead, here(step), stamp=0.5 * step, lasted=0.5, patience=8.0)
    return blocked


def test_a_gateway_that_is_not_got_through_for_long_is_closed():
    assert () == stayed(10.5).gateway_ids
    assert ("g1",) == stayed(11.0).gateway_ids


def test_going_to_and_fro_between_two_gateways_closes_both():
    assert {"g1", "g2"} == set(stayed(22.0, gateways=("g1", "g2")).gateway_ids)


def test_a_gateway_far_off_is_not_closed_nor_one_that_the_robot_comes_by():
    assert () == stayed(60.0, away=2.0).gateway_ids
    assert () == stayed(60.0, here=lambda step: np.array([0.3 * step, 0.0])).gateway_ids


def test_the_gateway_near_by_is_blocked_where_the_robot_is_stalled():
    assert ("g1",) == BlockedGateways().close(leg(2.0), 5.0).gateway_ids
    assert () == BlockedGateways().close(leg(4.0), 5.0).gateway_ids
    assert () == BlockedGateways().close(leg(2.0, ""), 5.0).gateway_ids


def test_what_was_closed_long_ago_is_tried_again():
    closed = BlockedGateways().close(leg(2.0), 5.0)

    assert ("g1",) == closed.reopened(100.0, 100.0).gateway_ids
    assert () == closed.reopened(106.0, 100.0).gateway_ids
    assert () == closed.all_reopened().gateway_ids
