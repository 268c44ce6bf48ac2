"""A drawing with all that is true about it: strokes, rooms, and points that are the same in the building."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Self

import numpy as np
import shapely

from pilotage.evaluation.rooms import Rooms, read_drawn_rooms
from pilotage.evaluation.warp import Warp, read_warp
from pilotage.geometry import Array, Polyline
from pilotage.io import open_map
from pilotage.maps import SchematicMap

CONTROL_SPACING = 1.5
"""Distance [m] between the control points that are added inside rooms."""
CARRIED_STEP = 0.25
"""Greatest length [m] of the pieces in which strokes are carried back to the building."""


@dataclass(frozen=True, eq=False)
class Plan:
    """A drawing, y up, in its own unit, and the truth about it."""

    strokes: shapely.MultiLineString
    rooms: Rooms
    warp: Warp

    @property
    def sketch(self) -> SchematicMap:
        """The drawing alone, as a localizer gets it."""
        return SchematicMap(
            tuple(Polyline(line.coords) for line in self.strokes.geoms), source="a deformed plan"
        )

    def moved(self, linear: Array) -> Self:
        """Carry everything on the sheet by a linear map (2, 2)."""

        def carry(points: Array) -> Array:
            return points @ linear.T

        rooms = Rooms(self.rooms.names, tuple(shapely.transform(room, carry) for room in self.rooms.polygons))
        warp = Warp(self.warp.in_world, carry(self.warp.in_sketch))
        return replace(self, strokes=shapely.transform(self.strokes, carry), rooms=rooms, warp=warp)

    def straightened(self) -> Self:
        """Take the true warp out: carry all strokes and rooms back to the building [m].

        What remains is what the drawing leaves out, adds and moves from its place, and the hand. Where the
        drawing folds over, strokes are carried by the nearest triangle that does not.
        """
        step = CARRIED_STEP * self.scale

        def carry(geometry: shapely.Geometry) -> shapely.Geometry:
            return shapely.transform(shapely.segmentize(geometry, step), self.warp.world_from_sketch)

        rooms = Rooms(self.rooms.names, tuple(carry(room) for room in self.rooms.polygons))
        return replace(
            self, strokes=carry(self.strokes), rooms=rooms, warp=Warp(self.warp.in_world, self.warp.in_world)
        )

    @property
    def scale(self) -> float:
        """Median local scale [drawing units per metre]."""
        return float(np.median(np.sqrt(np.abs(np.linalg.det(self.warp.there.maps[:, :2])))))


def read_plan(path: Path) -> Plan:
    """Read a drawing and the truth beside it; its unit becomes the metre, of the median scale."""
    sketch, truth = open_map(path), path.with_suffix(".json")
    warp, drawn = read_warp(truth, sketch), read_drawn_rooms(truth)
    polygons = tuple(shapely.transform(room, sketch.sketch_from_file) for room in drawn.polygons)
    lines = [np.vstack([one.vertices, one.vertices[: one.closed]]) for one in sketch.strokes]
    plan = Plan(shapely.MultiLineString(lines), Rooms(drawn.names, polygons), warp)
    return with_dense_control(plan.moved(np.eye(2) / plan.scale))


def with_dense_control(plan: Plan) -> Plan:
    """Add control points on a grid inside rooms, so that a map that bends within rooms is told [m]."""
    left, bottom, right, top = shapely.MultiPolygon(plan.rooms.polygons).bounds
    xs, ys = (np.arange(low, high, CONTROL_SPACING) + 0.1 for low, high in ((left, right), (bottom, top)))
    grid = np.stack(np.meshgrid(xs, ys), axis=-1).reshape(-1, 2)
    inside = grid[np.array(plan.rooms.names_at(grid)) != ""]
    warp = plan.warp
    return replace(
        plan,
        warp=Warp(
            np.vstack([warp.in_world, warp.world_from_sketch(inside)]), np.vstack([warp.in_sketch, inside])
        ),
    )
