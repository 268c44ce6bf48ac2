"""Routes to the goal over the cells of the drawing, around the gateways that are blocked (4.2)."""

from functools import lru_cache

from pilotage.localization import Estimate
from pilotage.maps import Atlas, Roadmap, RouteError, RouteSettings
from pilotage.maps.routing.roadmap import Point
from pilotage.navigation.blocked_gateways import BlockedGateways
from pilotage.navigation.cost_to_go import CostToGo, cost_to_go
from pilotage.navigation.goal import find_goal
from pilotage.navigation.route_leg import RouteLeg, next_waypoint


class RoutePlanner:
    """Knows the drawing, its routes and the goal; raises as `find_goal` does."""

    def __init__(self, atlas: Atlas, goal: Point | str, settings: RouteSettings) -> None:
        self.atlas = atlas
        self.goal = find_goal(atlas, goal)
        assert atlas.joined is not None  # else there is no goal
        self.graph = atlas.joined.graph
        self.roadmap = Roadmap(self.graph, settings, atlas.sketch.zones)
        self._cost_to_go = lru_cache(maxsize=1)(self._find_costs)

    def leg(self, estimate: Estimate, blocked: BlockedGateways) -> tuple[RouteLeg | None, BlockedGateways]:
        """Find the next leg of the route, and the gateways that stay blocked.

        If all routes are blocked, all gateways are open again; None if there is still no route.
        """
        leg = self._leg(estimate, blocked)
        if leg is None and blocked.gateway_ids:
            blocked = blocked.all_reopened()
            leg = self._leg(estimate, blocked)
        return leg, blocked

    def _leg(self, estimate: Estimate, blocked: BlockedGateways) -> RouteLeg | None:
        """Find the next leg of the route; None if no route avoids the blocked gateways."""
        try:
            return next_waypoint(
                estimate.sketch_from_base, self.roadmap, self.goal.point, blocked.gateway_ids
            )
        except RouteError:
            return None

    def cost_to_go(self, blocked: BlockedGateways) -> CostToGo:
        """Find the cost of the route from everywhere; kept while the same gateways are blocked."""
        return self._cost_to_go(blocked.gateway_ids)

    def _find_costs(self, blocked: tuple[str, ...]) -> CostToGo:
        """Find the cost of the route from everywhere."""
        return cost_to_go(self.atlas, self.roadmap, self.goal.point, blocked)
