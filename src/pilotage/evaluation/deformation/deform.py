"""Make a drawing in people's manner from a plan, at a severity: 0 is the plan, 1 is as people draw."""

import math
from dataclasses import replace

import numpy as np
import shapely

from pilotage.evaluation.deformation.elastic import bend, nearest_room, node_grid, waves
from pilotage.evaluation.deformation.hand import STEP, shaky
from pilotage.evaluation.deformation.omissions import Changed, change
from pilotage.evaluation.deformation.plan import Plan
from pilotage.evaluation.rooms import Rooms
from pilotage.evaluation.warp import Warp
from pilotage.geometry import Array

ROOM = np.array([0.4, 0.38, 0.38, 0.15])
"""Standard deviations at severity 1 of what each room wants: log scale, p, q, turn [rad]."""
SMOOTH = np.array([0.2, 0.25, 0.25, 0.1])
"""Standard deviations of the same of a field that changes slowly over the sheet."""
SHEET = np.array([0.0, 0.12, 0.12, 0.0])
"""Standard deviations of the same of the whole sheet."""
LINE = math.log(0.15)
"""Logarithm of the factor by which a corridor that is drawn as a line is narrowed."""
STRAIGHT = 5.0
"""Length [m] over which walls stay straight: people bend rooms at their corners."""
TILT = math.radians(25.0)
"""Largest turn of the sheet at severity 1, beside quarter turns."""
UNIT = (4.0, 16.0)
"""Least and greatest scale [drawing units per metre]."""


def deform(plan: Plan, severity: float, seed: int) -> Plan:
    """Draw a plan [m] as a person would; equal seeds give the same person at any severity.

    Raises ValueError if the severity is negative or not finite.
    """
    if not 0.0 <= severity < math.inf:
        raise ValueError(f"severity must be >= 0 and finite, got {severity}")
    omitting, bending, drawing, laying = np.random.default_rng(seed).spawn(4)
    names = plan.rooms.names
    wish_of = {
        name: ROOM * rng.standard_normal(4)
        for name, rng in zip(names, bending.spawn(len(names)), strict=True)
    }
    bent = _bent(change(plan, severity, omitting), severity, wish_of, bending)
    lines = bent.strokes.geoms
    shaken = [shaky(line, severity, rng) for line, rng in zip(lines, drawing.spawn(len(lines)), strict=True)]
    return _laid(replace(bent, strokes=shapely.MultiLineString(shaken)), severity, laying)


def _bent(changed: Changed, severity: float, wish_of: dict[str, Array], rng: np.random.Generator) -> Plan:
    """Bend the sheet room by room; a corridor that becomes a line is no room any more."""
    plan = changed.plan
    corner, nodes = node_grid(tuple(shapely.total_bounds([plan.strokes, *plan.rooms.polygons]).tolist()))
    of_rooms = np.stack([wish_of[name] for name in plan.rooms.names])
    smooth = SMOOTH * np.stack([waves(nodes, rng) for _ in range(4)], axis=-1)
    wishes = severity * (SHEET * rng.standard_normal(4) + smooth)
    wishes += severity * of_rooms[nearest_room(nodes, plan.rooms.polygons)]
    for room in changed.lines:
        inside = shapely.intersects_xy(plan.rooms.polygons[room], nodes[..., 0], nodes[..., 1])
        wishes[inside] = narrowed(plan.rooms.polygons[room])
    sheet = bend(corner, wishes)
    kept = [k for k in range(len(plan.rooms.names)) if k not in changed.lines]

    def carry(geometry: shapely.Geometry, step: float) -> shapely.Geometry:
        return shapely.transform(shapely.segmentize(geometry, step), sheet.carry)

    rooms = Rooms(
        tuple(plan.rooms.names[k] for k in kept), tuple(carry(plan.rooms.polygons[k], STEP) for k in kept)
    )
    warp = Warp(plan.warp.in_world, sheet.carry(plan.warp.in_sketch))
    return Plan(carry(plan.strokes, STRAIGHT), rooms, warp)


def narrowed(corridor: shapely.Polygon) -> Array:
    """Return the wish of a corridor to be narrow across and as long as it is, (4,)."""
    corners = shapely.get_coordinates(shapely.minimum_rotated_rectangle(corridor))
    sides = np.diff(corners, axis=0)[:2]
    along = sides[np.argmax(np.hypot(*sides.T))]
    direction = 2.0 * math.atan2(along[1], along[0])
    return np.array([LINE / 2.0, -LINE / 2.0 * math.cos(direction), -LINE / 2.0 * math.sin(direction), 0.0])


def _laid(plan: Plan, severity: float, rng: np.random.Generator) -> Plan:
    """Turn the sheet and choose a unit."""
    quarters, tilt = int(rng.integers(4)), float(rng.uniform(-TILT, TILT))
    scale = math.exp(rng.uniform(*np.log(UNIT)))
    angle = quarters * math.pi / 2.0 + severity * tilt
    return plan.moved(
        scale * np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    )
