"""How far a disc can move straight on before it touches a segment or another disc."""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit
from pilotage.kernels.segment_grid import SegmentGrid

ALONG = 1e-9  # a motion that comes nearer by less than this share of its length goes along, not against


@njit(cache=True)
def share_before_point(
    x: float, y: float, move_x: float, move_y: float, reach: float, point_x: float, point_y: float
) -> float:
    """Return the share of a motion from (x, y) at which a point comes within reach; 1 if it never does.

    A point that is within reach already stops a motion that comes nearer, and no other.
    """
    from_x, from_y = x - point_x, y - point_y
    square = move_x * move_x + move_y * move_y
    nearing = -(from_x * move_x + from_y * move_y)
    if nearing <= ALONG * math.sqrt(square) * reach:
        return 1.0
    beyond = from_x * from_x + from_y * from_y - reach * reach
    if beyond <= 0.0:
        return 0.0
    discriminant = nearing * nearing - square * beyond
    if discriminant <= 0.0:
        return 1.0
    return min(beyond / (nearing + math.sqrt(discriminant)), 1.0)  # the smaller root, without cancellation


@njit(cache=True)
def share_before_segment(
    x: float, y: float, move_x: float, move_y: float, reach: float, segment: NDArray[np.float64]
) -> float:
    """Return the share of a motion from (x, y) at which a segment (4,) comes within reach; 1 if never."""
    share = min(
        share_before_point(x, y, move_x, move_y, reach, segment[0], segment[1]),
        share_before_point(x, y, move_x, move_y, reach, segment[2], segment[3]),
    )
    along_x, along_y = segment[2] - segment[0], segment[3] - segment[1]
    length = math.hypot(along_x, along_y)
    if length == 0.0:
        return share
    along_x, along_y = along_x / length, along_y / length
    from_x, from_y = x - segment[0], y - segment[1]
    away, moving_away = along_x * from_y - along_y * from_x, along_x * move_y - along_y * move_x
    if away < 0.0:
        away, moving_away = -away, -moving_away
    if moving_away < -ALONG * math.hypot(move_x, move_y):
        face = max((away - reach) / -moving_away, 0.0)
        if face < share:
            station = along_x * (from_x + face * move_x) + along_y * (from_y + face * move_y)
            if 0.0 <= station <= length:
                return float(face)
    return share


@njit(cache=True)
def share_before_grid(
    x: float, y: float, move_x: float, move_y: float, reach: float, grid: SegmentGrid
) -> float:
    """Return the share of a motion from (x, y) at which any segment comes within reach; 1 if never.

    A long motion is looked at piece by piece, so that only cells near it are.
    """
    pieces = max(1, math.ceil(math.hypot(move_x, move_y) / (2.0 * reach + 2.0 * grid.cell)))
    step_x, step_y = move_x / pieces, move_y / pieces
    for piece in range(pieces):
        from_x, from_y = x + piece * step_x, y + piece * step_y
        left, right = min(from_x, from_x + step_x) - reach, max(from_x, from_x + step_x) + reach
        bottom, top = min(from_y, from_y + step_y) - reach, max(from_y, from_y + step_y) + reach
        share = 1.0
        first, last = math.floor((left - grid.left) / grid.cell), math.floor((right - grid.left) / grid.cell)
        low, high = (
            math.floor((bottom - grid.bottom) / grid.cell),
            math.floor((top - grid.bottom) / grid.cell),
        )
        for column in range(max(first, 0), min(last, grid.columns - 1) + 1):
            for row in range(max(low, 0), min(high, grid.rows - 1) + 1):
                k = column * grid.rows + row
                for i in range(grid.starts[k], grid.starts[k + 1]):
                    segment = grid.segments[grid.members[i]]
                    share = min(share, share_before_segment(from_x, from_y, step_x, step_y, reach, segment))
        if share < 1.0:
            return (piece + share) / pieces
    return 1.0


@njit(cache=True)
def share_before_all(
    x: float,
    y: float,
    move_x: float,
    move_y: float,
    reach: float,
    grid: SegmentGrid,
    doors: NDArray[np.float64],
    discs: NDArray[np.float64],
) -> float:
    """Return the share of a motion at which anything comes within reach: a grid, doors (m, 4), discs (k, 3).

    Discs are rows x, y, radius.
    """
    share = share_before_grid(x, y, move_x, move_y, reach, grid)
    for j in range(len(doors)):
        share = min(share, share_before_segment(x, y, move_x, move_y, reach, doors[j]))
    for j in range(len(discs)):
        within = reach + discs[j, 2]
        share = min(share, share_before_point(x, y, move_x, move_y, within, discs[j, 0], discs[j, 1]))
    return share


@njit(cache=True)
def distance_to_segment(x: float, y: float, segment: NDArray[np.float64]) -> float:
    """Measure from a point to a segment (4,)."""
    along_x, along_y = segment[2] - segment[0], segment[3] - segment[1]
    from_x, from_y = x - segment[0], y - segment[1]
    square = along_x * along_x + along_y * along_y
    share = 0.0
    if square > 0.0:
        share = min(max((from_x * along_x + from_y * along_y) / square, 0.0), 1.0)
    return math.hypot(from_x - share * along_x, from_y - share * along_y)


@njit(cache=True)
def clearances(points: NDArray[np.float64], grid: SegmentGrid, farthest: float) -> NDArray[np.float64]:
    """Measure from each point (n, 2) to the nearest segment, (n,); `farthest` where none is nearer."""
    distances = np.full(len(points), farthest)
    for i in range(len(points)):
        x, y = points[i, 0], points[i, 1]
        first = math.floor((x - farthest - grid.left) / grid.cell)
        last = math.floor((x + farthest - grid.left) / grid.cell)
        low = math.floor((y - farthest - grid.bottom) / grid.cell)
        high = math.floor((y + farthest - grid.bottom) / grid.cell)
        for column in range(max(first, 0), min(last, grid.columns - 1) + 1):
            for row in range(max(low, 0), min(high, grid.rows - 1) + 1):
                k = column * grid.rows + row
                for member in range(grid.starts[k], grid.starts[k + 1]):
                    distance = distance_to_segment(x, y, grid.segments[grid.members[member]])
                    distances[i] = min(distances[i], distance)
    return distances
