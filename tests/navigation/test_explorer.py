"""Exploring rim by rim."""

import math

import numpy as np
import pytest

from buildings import coarse, scan_at
from pilotage.geometry import Polyline, Pose2
from pilotage.localization.belief import Belief
from pilotage.maps import Roadmap, RouteSettings, SchematicMap, build_atlas
from pilotage.navigation.explorer import Explorer
from pilotage.navigation.exploring import ExploringSettings
from pilotage.navigation.surroundings import Surroundings, SurroundingsSettings

RADIUS = 0.2
CORRIDOR = (Polyline.through([(-7, -1), (7, -1)]), Polyline.through([(-7, 1), (7, 1)]))
"""Open at both ends [m]."""
BOX = (Polyline.through([(-2, -2), (2, -2), (2, 2), (-2, 2)], closed=True),)
HALLS = SchematicMap(  # a corridor between two halls, each behind a door
    (
        Polyline.through([(-30, -1), (-10, -1), (-10, -0.5)]),
        Polyline.through([(-10, 0.5), (-10, 1), (-30, 1), (-30, -1)]),
        Polyline.through([(-10, -1), (10, -1), (10, -0.5)]),
        Polyline.through([(10, 0.5), (10, 1), (-10, 1)]),
        Polyline.through([(10, -1), (30, -1), (30, 1), (10, 1)]),
    )
)
COARSE = coarse(120, 60)
TRAIL = np.zeros((1, 2))


@pytest.fixture
def explorer():
    atlas = build_atlas(HALLS, COARSE)
    roads = Roadmap(atlas.cell_graph, RouteSettings())
    return Explorer(atlas, roads, (25.0, 0.0), ExploringSettings())


def reach_in(walls, pose):
    """Look all around once, and see where one can go."""
    surroundings = Surroundings.unseen(SurroundingsSettings(size=9.0))
    scan = scan_at(pose, walls=walls, beams=720, fov=math.tau * 719 / 720)
    return surroundings.seen(scan, pose).reach(RADIUS)


def believing(*poses):
    states = np.array([(x, y, heading, 0.0, 0.0, 0.0) for x, y, heading in poses]).T
    return Belief(states, np.zeros(len(poses)))


ACROSS = Pose2(0.0, 0.0, math.pi / 2.0)  # so that no end is nearer by turning
KNOWN = believing((0.0, 0.0, math.pi / 2.0))
TURNED = believing((0.0, 0.0, -math.pi / 2.0))


def chosen(explorer, belief=None, pose=ACROSS, **asked):
    reach = reach_in(CORRIDOR, pose)
    index, leads_on = explorer.choose(reach, TRAIL, (), belief=belief, **asked)
    assert leads_on
    return float(reach.points[index, 0])


def test_it_goes_where_belief_finds_the_goal(explorer):
    assert chosen(explorer, KNOWN) > 1.0


def test_it_keeps_to_what_was_begun_though_belief_turns(explorer):
    begun = chosen(explorer, KNOWN)

    assert chosen(explorer, TURNED) == pytest.approx(begun, abs=0.3)


def test_what_was_interrupted_is_chosen_anew(explorer):
    chosen(explorer, KNOWN)
    explorer.interrupt()

    assert chosen(explorer, TURNED) < -1.0


def test_where_it_could_not_get_to_it_does_not_go_again(explorer):
    begun = chosen(explorer)
    explorer.give_up()

    assert begun * chosen(explorer) < 0.0


def test_what_is_reached_is_done(explorer):
    reach = reach_in(CORRIDOR, ACROSS)
    begun = reach.points[explorer.choose(reach, TRAIL, (), belief=KNOWN)[0]]
    there = reach_in(CORRIDOR, Pose2(*begun, math.pi / 2.0))
    onward = there.points[explorer.choose(there, TRAIL, (), belief=TURNED)[0]]

    assert onward[0] < begun[0] - 0.5


def test_no_way_leads_on_in_a_closed_box(explorer):
    reach = reach_in(BOX, ACROSS)
    index, leads_on = explorer.choose(reach, TRAIL, ())

    assert not leads_on
    assert np.hypot(*reach.points[index]) > 1.0


def test_a_closed_gateway_leads_to_no_goal(explorer):
    gateways = [gateway.gateway_id for gateway in explorer.roads.graph.gateways]
    free = chosen(explorer, KNOWN)
    explorer.interrupt()
    shut = chosen(explorer, KNOWN, closed=gateways)
    explorer.interrupt()

    assert shut == pytest.approx(chosen(explorer))
    assert free > 1.0
