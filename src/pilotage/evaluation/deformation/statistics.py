"""How far a drawing is from the truth, in the numbers that tell people's drawings from imitations."""

from dataclasses import dataclass

import numpy as np
import shapely

from pilotage.evaluation.deformation.plan import Plan
from pilotage.evaluation.rooms import Rooms
from pilotage.geometry import Array, fit_similarity
from pilotage.kernels.visibility import LOG_STEP
from pilotage.maps.range_table import RangeTable, RangeTableSettings, build_range_table

SPAN = 2.0
"""Length [m] over which local scale and stretch are measured."""
STEP = 0.5
"""Length [m] of a step of the way that is tested for drawn walls."""


@dataclass(frozen=True, slots=True)
class Statistics:
    """Scales are relative to the median one; shares are of the robot's way."""

    scale_p10: float
    scale_p90: float
    stretch_median: float  # ratio of the singular values of the local map
    stretch_p90: float
    similarity_miss: float  # [m] of control points from the best similarity, root mean square
    crossing: float  # share of steps that cross a drawn stroke
    undrawn: float  # share of the way in rooms that are not drawn
    rooms_missing: float  # share of rooms
    shortening: float  # of drawn views along their longer axis, as `shortening` tells


def statistics_of(plan: Plan, way: Array, rooms: Rooms) -> Statistics:
    """Measure a drawing of these rooms along a way (n, 2) [m] through the building."""
    way = thinned(way)
    names = rooms.names_at(way)
    drawn = np.array([name in plan.rooms.names for name in names])
    maps = local_maps(plan, way[drawn])
    values = np.linalg.svd(maps, compute_uv=False)
    values = values[values[:, 1] > 0.0]
    scales, stretches = np.sqrt(values.prod(axis=1)), values[:, 0] / values[:, 1]
    relative = scales / np.median(scales)
    on_sheet = plan.warp.sketch_from_world(way)
    steps = shapely.linestrings(np.stack([on_sheet[:-1], on_sheet[1:]], axis=1))
    shapely.prepare(plan.strokes)
    crossing = shapely.intersects(plan.strokes, steps)[drawn[:-1] & drawn[1:]]
    return Statistics(
        float(np.quantile(relative, 0.1)),
        float(np.quantile(relative, 0.9)),
        float(np.median(stretches)),
        float(np.quantile(stretches, 0.9)),
        similarity_miss(way[drawn], on_sheet[drawn]),
        float(crossing.mean()),
        float(1.0 - drawn.mean()),
        1.0 - sum(name in plan.rooms.names for name in rooms.names) / len(rooms.names),
        shortening(plan, maps, on_sheet[drawn]),
    )


def thinned(way: Array) -> Array:
    """Keep points of a way (n, 2) that are a step apart."""
    kept = [0]
    for index in range(1, len(way)):
        if np.hypot(*(way[index] - way[kept[-1]])) >= STEP:
            kept.append(index)
    return way[kept]


def local_maps(plan: Plan, points: Array) -> Array:
    """Return the linear map around each point (n, 2) [m], over the span, (n, 2, 2)."""
    half = SPAN / 2.0 * np.eye(2)
    sides = [
        (plan.warp.sketch_from_world(points + one) - plan.warp.sketch_from_world(points - one)) / SPAN
        for one in half
    ]
    return np.stack(sides, axis=-1)


def shortening(plan: Plan, maps: Array, on_sheet: Array) -> float:
    """Return by how much drawn views are shortened along their longer axis.

    `maps` (n, 2, 2) are the local maps at the places `on_sheet` (n, 2). A map is a scale, a stretch and a
    rotation; the figure is the regression coefficient of the stretch on the elongation of the drawn view,
    negated: 0 where proportions are true, 1 where a hall that is drawn 2 : 1 is 4 : 1.
    """
    rotated, values, _ = np.linalg.svd(maps)
    kept = np.linalg.det(maps) > 0.0  # elsewhere the drawing folds over
    sizes = 0.5 * np.log(values[kept, 0] / values[kept, 1])
    angles = 2.0 * np.arctan2(rotated[kept, 1, 0], rotated[kept, 0, 0])
    stretches = sizes * np.stack([np.cos(angles), np.sin(angles)])
    table = build_range_table(plan.sketch, RangeTableSettings())
    views = elongations(table, on_sheet[kept])
    return float(-np.sum(stretches * views) / np.sum(views**2))


def elongations(table: RangeTable, points: Array) -> Array:
    """Return how much longer the view from points (n, 2) is one way than across, as a stretch p, q, (2, n).

    It is the second harmonic of the logarithm of the ranges. To first order that is the stretch of
    `Affine2.from_state` that makes this view of a round one; in the middle of a rectangle it is half the
    logarithm of length over width.
    """
    directions = table.log_ranges.shape[1]
    angles = np.arange(directions) * 4.0 * np.pi / directions
    waves = np.stack([np.cos(angles), np.sin(angles)]) * (2.0 * LOG_STEP / directions)
    return np.asarray(np.einsum("wd,nd->wn", waves, table.log_ranges[table.lines_at(points)]))


def similarity_miss(in_world: Array, in_sketch: Array) -> float:
    """Return how far points (n, 2) [m] are from where the best similarity has them, root mean square."""
    off = fit_similarity(in_sketch, in_world) @ in_sketch - in_world
    return float(np.sqrt(np.mean(np.sum(off**2, axis=1))))
