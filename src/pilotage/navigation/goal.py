"""Where a drive shall end: anywhere in a room that the drawing names, or at a point."""

import math
from dataclasses import dataclass

import numpy as np
import shapely

from pilotage.localization import Estimate
from pilotage.maps import Atlas, CellGraph, NotEnclosedError, check_place, find_labeled
from pilotage.maps.routing.roadmap import Point, check_allowed

CLEAR_OF_GATEWAY = 0.5
"""Distance [m] from all gateways of a room at which the robot is in it and out of the way of others."""

BESIDE = 1.0
"""Distance [m] from a goal at which the robot may stop if it can come no nearer; as much more each time that
it stalled on its route.

A niche that is drawn and not built, or a corridor that is drawn too long, ends before the goal. The robot
tries the other routes first, and stops at the dead end when they led nowhere, too (decision 0035).
"""


@dataclass(frozen=True, slots=True)
class Goal:
    """A point of the sketch (y up), and the room that counts if the goal is a name."""

    point: Point  # [drawing units]; of a room its innermost point
    cell_id: str  # the cell of the point
    name: str = ""  # as the user gave it; empty for a point

    @property
    def is_room(self) -> bool:
        """Whether the goal is reached anywhere in its cell."""
        return self.name != ""

    def is_missed_by(self, distance: float) -> bool:
        """Tell whether a robot that stops is that far off [m], along the route, because it came no nearer."""
        return not self.is_room and BESIDE <= distance < math.inf

    def is_room_around(self, estimate: Estimate, graph: CellGraph) -> bool:
        """Tell whether the leading pose stands in the goal's room, clear of its gateways."""
        if not self.is_room or estimate.cell_id != self.cell_id:
            return False
        position = shapely.Point(estimate.sketch_from_base.translation)
        if not graph.cell(self.cell_id).polygon.covers(position):
            return False
        clear = CLEAR_OF_GATEWAY * estimate.sketch_from_base.scale
        gateways = (shapely.LineString(gateway.segment) for gateway in graph.gateways_of(self.cell_id))
        return all(position.distance(gateway) >= clear for gateway in gateways)


def find_goal(atlas: Atlas, goal: Point | str) -> Goal:
    """Find a goal on a drawing: a name, or a point in the drawing's own units and axes.

    Raises NotEnclosedError if the drawing has no cells, RouteError if the name stands in no cell or in more
    than one, or if the point lies outside all cells or in a keep-out zone, ValueError if the point is not
    finite.
    """
    graph = atlas.cell_graph
    if graph is None:
        raise NotEnclosedError("a drawing to drive by must enclose free space, it has no closed room")
    point = find_labeled(graph, goal) if isinstance(goal, str) else sketch_point(atlas, goal, "goal")
    check_allowed(atlas.sketch.zones, point)
    return Goal(point, graph.cell_at(point), goal if isinstance(goal, str) else "")


def sketch_point(atlas: Atlas, point: Point, what: str) -> Point:
    """Carry a point from the drawing's own axes to the sketch (y up), and check that it lies in a cell."""
    if not all(map(math.isfinite, point)):
        raise ValueError(f"the {what} must be finite, got {tuple(point)}")
    x, y = atlas.sketch.sketch_from_file(np.array([point], dtype=np.float64))[0].tolist()
    if atlas.cell_graph is not None:
        check_place(atlas.cell_graph, (x, y), what)
    return x, y
