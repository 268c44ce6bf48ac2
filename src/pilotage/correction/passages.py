"""Which gateways of a drawing were found open, and which closed."""

from collections.abc import Sequence

import numpy as np
import shapely

from pilotage.correction.corrected import Passage, PassageState
from pilotage.correction.sighting import Sighting
from pilotage.correction.spline import ElasticMap
from pilotage.correction.trajectory import Path
from pilotage.geometry import Array
from pilotage.maps import CellGraph

THROUGH = 0.3
"""[m] behind a gateway, from which on a beam that ends there went through."""
ON = 0.25
"""[m] from a gateway, up to which a beam that ends there met what fills it."""
MIDDLE = 0.25
"""Share of a gateway's width at each side that beams through it are not counted in: jambs are there."""
FEWEST_THROUGH = 5
"""Beams through a gateway that show that it is open."""
BESIDE = 0.5
"""Share of a gateway's width beside it where the robot's way still goes through it: it may be drawn aside."""
BINS = 8
"""Parts of a gateway's width ..."""
FILLED = 6
"""... of which so many must be filled if it is closed."""


def find_passages(
    graph: CellGraph, sightings: Sequence[Sighting], path: Path, elastic: ElasticMap
) -> tuple[Passage, ...]:
    """Judge all gateways by the beams of sightings."""
    counts = [len(one.ends) for one in sightings]
    owners = np.repeat(np.arange(len(sightings)), counts)
    ends = path.from_base(np.vstack([one.ends for one in sightings]), owners)
    lasers = path.from_base(np.array([one.laser for one in sightings]), np.arange(len(sightings)))[owners]
    return tuple(
        Passage(gateway.gateway_id, segment, state_of(segment, lasers, ends, path.places))
        for gateway in graph.gateways
        for segment in [elastic @ gateway.segment]
    )


def state_of(segment: Array, lasers: Array, ends: Array, way: Array) -> PassageState:
    """Judge a gateway (2, 2) by beams from lasers (m, 2) to ends (m, 2) and the robot's way (n, 2) [m]."""
    if is_crossed(segment, way):
        return PassageState.OPEN
    along = segment[1] - segment[0]
    width = max(float(np.hypot(*along)), 1e-6)
    along = along / width
    across = np.array([-along[1], along[0]])
    before, behind = (lasers - segment[0]) @ across, (ends - segment[0]) @ across
    facing = np.sign(before)
    span = before - behind
    share = np.where(span == 0.0, 0.0, before / np.where(span == 0.0, 1.0, span))
    meeting = lasers + np.clip(share, 0.0, 1.0)[:, np.newaxis] * (ends - lasers)
    middle = np.abs((meeting - segment[0]) @ along / width - 0.5) < 0.5 - MIDDLE
    if np.count_nonzero(middle & (behind * facing < -THROUGH)) >= FEWEST_THROUGH:
        return PassageState.OPEN
    at = (ends - segment[0]) @ along / width
    on = (np.abs(behind) < ON) & (at >= 0.0) & (at < 1.0)
    bins = np.unique((at[on] * BINS).astype(np.int64))
    return PassageState.CLOSED if len(bins) >= FILLED else PassageState.UNSEEN


def is_crossed(segment: Array, way: Array) -> bool:
    """Tell whether the robot's way (n, 2) leads through a gateway (2, 2), or just beside it."""
    reach = BESIDE * (segment[1] - segment[0])
    opening = shapely.LineString([segment[0] - reach, segment[1] + reach])
    return len(way) > 1 and bool(opening.intersects(shapely.LineString(way)))
