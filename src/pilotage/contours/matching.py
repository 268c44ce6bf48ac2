"""Match what is seen of a contour with what is known of it (Wolter 2001, sections 3.1 and 3.2).

match_partial(seen, known, settings) -> matches, best first
    Wherever the two may lie.
match_partial_near(seen, known, known_from_seen, settings) -> matches, best first
    Where an estimate of the pose puts them: the displacement error of section 3.2 counts.

Vertices may be dropped at any end of either. To drop all but one pair of segments would always be cheapest,
so matched length is rewarded (decision 0004). The product does not use this by default: see
docs/theory/paper.md.
"""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from pilotage import kernels
from pilotage.geometry import Array, Pose2, Span
from pilotage.shape import PartialShape

if TYPE_CHECKING:
    from pilotage.kernels.partial_matching import Chain


@dataclass(frozen=True, slots=True)
class Matching:
    """What a match costs and earns, beside eq. (2)."""

    displacement_weight: float = 0.2  # alpha [rad²/m²] a metre of match; half a metre off costs its reward
    reward: float = 0.05  # lambda [rad²] a metre of match; directions off by 13 degrees cost it
    largest_run: int = 5  # segments that may answer to a single one; a notch in a wall makes 5 of 1
    min_length: float = 0.5  # [m] a shorter match says nothing
    count: int = 5  # matches returned at most

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        for name in ("displacement_weight", "min_length"):
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must be >= 0, got {getattr(self, name)}")
        if not self.reward > 0.0:
            raise ValueError(f"reward must be > 0 rad², got {self.reward}")
        for name in ("largest_run", "count"):
            if getattr(self, name) < 1:
                raise ValueError(f"{name} must be >= 1, got {getattr(self, name)}")


@dataclass(frozen=True, slots=True)
class PartialMatch:
    """Which part of what is seen is which part of what is known."""

    seen: Span
    known: Span
    length: float  # [m] matched, of each pair of segments the shorter
    cost: float  # S + alpha |Delta T|² - lambda * length [rad² m]; the least is the best, all are negative
    known_from_seen: Pose2  # that lays the one on the other


def match_partial(seen: PartialShape, known: PartialShape, settings: Matching) -> tuple[PartialMatch, ...]:
    """Match wherever the two may lie (3.1): each segment seen is laid on each known, at either end of theirs.

    A corner in the scan and a corner of the map, of which the scan shows one wall in part:

    >>> from pilotage.geometry import Polyline
    >>> from pilotage.shape import EndCause
    >>> corner = PartialShape(Polyline.through([(0, 2), (0, 0), (1, 0)]), last_end=EndCause.OCCLUDED)
    >>> room = PartialShape(Polyline.through([(5, 9), (5, 5), (3, 5), (3, 0)]))
    >>> best = match_partial(corner, room, Matching())[0]
    >>> best.seen, best.known.first, best.known.last, best.known.trim_last
    (Span(first=0, last=2, trim_first=0.0, trim_last=0.0), 1, 3, 0.8)
    """
    a, b = _Side.of(seen, turns=1), _Side.of(known, turns=2)
    theta = _rotations(a, b)
    poses = [
        np.dstack([b.chain.vertices[None, at_b] - _turned(a.chain.vertices[at_a, None], theta), theta])
        for at_a, at_b in ((slice(None, -1), slice(None, -1)), (slice(1, None), slice(1, None)))
    ]
    return _match(a, b, np.concatenate(poses).reshape(-1, 3), settings)


def match_partial_near(
    seen: PartialShape, known: PartialShape, known_from_seen: Pose2, settings: Matching
) -> tuple[PartialMatch, ...]:
    """Match near an estimated pose, of which the position is believed and the heading is not (section 3.2).

    The frame of what is seen is the robot's: the displacement is that of the robot.
    """
    a, b = _Side.of(seen, turns=1), _Side.of(known, turns=2)
    theta = _rotations(a, b)
    position = np.broadcast_to(known_from_seen.position, (*theta.shape, 2))
    return _match(a, b, np.dstack([position, theta]).reshape(-1, 3), settings)


class _Side(NamedTuple):
    """One of the two polylines, laid out for the kernel, repeated vertices left out."""

    chain: "Chain"
    vertices: NDArray[np.intp]  # which of the polyline each of the chain is; counts on around closed ones
    size: int  # vertices of the polyline

    @classmethod
    def of(cls, shape: PartialShape, *, turns: int) -> Self:
        """Lay out a shape; a closed one several times around."""
        line = shape.polyline
        points = np.vstack([*[line.vertices] * (turns - 1), line.ring]) if line.closed else line.vertices
        steps = np.diff(points, axis=0)
        lengths = np.hypot(steps[:, 0], steps[:, 1])
        kept = np.concatenate([[True], lengths > 0.0])
        chain = kernels.partial_matching.Chain(
            points[kept],
            lengths[kept[1:]],
            np.arctan2(steps[:, 1], steps[:, 0])[kept[1:]],
            shape.first_end.goes_on and not line.closed,
            shape.last_end.goes_on and not line.closed,
        )
        return cls(chain, np.flatnonzero(kept), len(line))

    def lengths(self, path: NDArray[np.int64]) -> Array:
        """Length of the run of segments between each two vertices of a path, (k - 1,) [m]."""
        way = np.concatenate([[0.0], np.cumsum(self.chain.lengths)])
        return np.asarray(np.diff(way[path]))

    def points(self, path: NDArray[np.int64], trims: Array) -> Array:
        """Vertices of a path (k, 2) [m], the ends cut by a share of their segments."""
        points = self.chain.vertices[path]
        first = points[0] + trims[0] * (points[1] - points[0])
        last = points[-1] + trims[1] * (points[-2] - points[-1])
        return np.vstack([first, points[1:-1], last])

    def span(self, path: NDArray[np.int64], trims: Array) -> Span:
        """Name what a path covers by the vertices of the polyline."""
        first = int(self.vertices[path[0] + 1]) - 1  # of repeated vertices the last
        turn = first // self.size * self.size
        return Span(first - turn, int(self.vertices[path[-1]]) - turn, float(trims[0]), float(trims[1]))


def _rotations(seen: _Side, known: _Side) -> Array:
    """By how much each segment seen must be turned to run along each known, (n, m) [rad]."""
    return known.chain.directions[None, :] - seen.chain.directions[:, None]


def _turned(points: Array, theta: Array) -> Array:
    """Turn points, (n, m, 2) [m]."""
    c, s = np.cos(theta), np.sin(theta)
    x, y = points[..., 0], points[..., 1]
    return np.stack([c * x - s * y, s * x + c * y], axis=-1)


def _match(seen: _Side, known: _Side, poses: Array, settings: Matching) -> tuple[PartialMatch, ...]:
    """Collect what is best at each pose (h, 3), each match once."""
    prices = kernels.partial_matching.Prices(
        settings.displacement_weight, settings.reward, settings.largest_run
    )
    found = kernels.partial_matching.match_at_poses(
        seen.chain, known.chain, np.ascontiguousarray(poses), prices
    )
    matches: list[PartialMatch] = []
    collected: set[bytes] = set()
    for h in np.argsort(found.costs, kind="stable"):
        if found.costs[h] == 0.0 or len(matches) == settings.count:
            break
        paths, cuts = found.paths[h, : found.sizes[h]].T, found.cuts[h]
        name = paths.tobytes() + cuts.tobytes()
        if name not in collected:
            collected.add(name)
            match = _cut_and_fit((seen, known), paths, cuts, float(found.costs[h]))
            if match.length >= settings.min_length:
                matches.append(match)
    return tuple(matches)


def _cut_and_fit(
    sides: tuple[_Side, _Side], paths: NDArray[np.int64], cuts: NDArray[np.bool_], cost: float
) -> PartialMatch:
    """Cut the longer of the segments at either end to the length of the other, and lay part on part."""
    lengths = np.stack([side.lengths(path) for side, path in zip(sides, paths, strict=True)])
    shared = lengths.min(axis=0)
    trims = np.where(cuts, 1.0 - shared[[0, -1]] / lengths[:, [0, -1]], 0.0)
    seen, known = sides
    return PartialMatch(
        seen.span(paths[0], trims[0]),
        known.span(paths[1], trims[1]),
        float(shared.sum()),
        cost,
        _fit(seen.points(paths[0], trims[0]), known.points(paths[1], trims[1])),
    )


def _fit(seen: Array, known: Array) -> Pose2:
    """Lay points on points by least squares (section 3.2, Lu and Milios 1994), (k, 2) each."""
    p, q = seen - seen.mean(axis=0), known - known.mean(axis=0)
    theta = math.atan2(float((p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]).sum()), float((p * q).sum()))
    turned = Pose2(0.0, 0.0, theta) @ seen
    x, y = known.mean(axis=0) - turned.mean(axis=0)
    return Pose2(float(x), float(y), theta)
