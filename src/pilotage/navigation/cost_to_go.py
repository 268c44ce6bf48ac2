"""The cost of the route to the goal from everywhere on the drawing, and the expected progress of a move.

While several places are possible, a move is worth what it saves on average over them (Q-MDP: Littman,
Cassandra and Kaelbling 1995). If they agree on the direction, the robot need not know which is true.
"""

import math
from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from pilotage.geometry import Array
from pilotage.localization.particles import LOG_SCALE, X, Y, displacements
from pilotage.maps import Atlas, Roadmap
from pilotage.maps.range_table import RangeTable
from pilotage.maps.routing.roadmap import Point


@dataclass(frozen=True, eq=False)
class CostToGo:
    """The cost of the route to the goal from each cell of the range table's grid."""

    table: RangeTable
    costs: Array  # (columns * rows,) [drawing units of easy walking]; inf where no route leads

    def at(self, points: Array) -> Array:
        """Look the cost up for points (n, 2) of the sketch, (n,)."""
        return np.asarray(self.costs[self.table.lines_at(points)])

    def expected_progress(self, points: Array, states: Array) -> Array:
        """Average over particles (6, m) how much nearer the goal is from points than from here.

        Points (n, 2) are in the robot's frame [m]; returns (n,) [m]. Particles without a route to the goal
        make no progress. The progress of a move is at most its length: if it seems longer, the move leads
        through a drawn wall.
        """
        here = self.at(states[[X, Y]].T)
        progress = np.zeros(len(points))
        for index, (x, y) in enumerate(points):
            there = self.at((states[[X, Y]] + displacements(states, x, y)).T)
            leads = np.isfinite(here) & np.isfinite(there)
            nearer = (here[leads] - there[leads]) / np.exp(states[LOG_SCALE, leads])
            progress[index] = np.clip(nearer, -math.hypot(x, y), math.hypot(x, y)).sum()
        return np.asarray(progress / states.shape[1])


def cost_to_go(atlas: Atlas, roadmap: Roadmap, goal: Point, blocked: Collection[str] = ()) -> CostToGo:
    """Find the cost of the route from everywhere to a goal of the sketch, not through `blocked` gateways.

    From each place of a cell the route leads straight to an exit in sight: a gateway, a corner, the goal.
    Where the grid is too coarse to see any, all count.
    """
    table, graph = atlas.range_table, roadmap.graph
    costs = np.full(len(table.middles), np.inf)
    exits = roadmap.exits_to(goal, blocked)
    for number, cell in enumerate(graph.cells):
        inside = np.flatnonzero(atlas.cell_indices == number)
        price = roadmap.settings.walking(cell.size)
        in_sight = np.full(len(inside), np.inf)
        for point, left in exits[cell.cell_id]:
            cost = price * np.hypot(*(table.middles[inside] - point).T) + left * graph.diameter
            costs[inside] = np.minimum(costs[inside], cost)
            in_sight = np.where(table.sees(inside, point), np.minimum(in_sight, cost), in_sight)
        costs[inside] = np.where(np.isfinite(in_sight), in_sight, costs[inside])
    costs[roadmap.zones.are_kept_out(table.middles)] = np.inf
    return CostToGo(table, costs)
