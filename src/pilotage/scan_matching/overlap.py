"""Which perceived shapes lie on known ones, once the pose is known (Wolter 2001, section 3.3, step 2)."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array, Pose2
from pilotage.scan_matching.local_map import PerceptionMap, segment_owners, segments_of
from pilotage.scan_matching.registration import Correspondence
from pilotage.shape.partial import PartialShape


@dataclass(frozen=True, slots=True)
class OverlapSettings:
    """When a perceived shape is one that is known."""

    distance: float = 0.1  # [m] a part lies on a known shape that runs its way within this
    share: float = 0.95  # [0..1] of the length must lie on known shapes; less is new, and worth entering
    min_cosine: float = 0.7  # lines less than 45 degrees apart run the same way
    sample_step: float = 0.1  # [m] between the points looked at

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        for name in ("distance", "sample_step"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be > 0 m, got {getattr(self, name)}")
        if not 0.0 < self.share <= 1.0:
            raise ValueError(f"share must be in (0, 1], got {self.share}")


def find_correspondences(
    shapes: tuple[PartialShape, ...],
    perception_map: PerceptionMap,
    odom_from_base: Pose2,
    settings: OverlapSettings,
) -> tuple[Correspondence, ...]:
    """Pair each perceived shape that known ones cover with the one that covers most, in order of `seen`."""
    from pilotage.kernels.segment_field import NONE, find_nearest
    from pilotage.kernels.segment_sampling import sample_segments

    known = perception_map.segment_field
    points, directions, weights, owners = sample_segments(segments_of(shapes), settings.sample_step)
    points, directions = odom_from_base @ points, directions @ odom_from_base.rotation.T
    nearest = find_nearest(points, directions, known, settings.min_cosine)
    distance = np.where(nearest == NONE, np.inf, _distance(points, known.segments[nearest]))
    hit = distance <= settings.distance
    seen = segment_owners(shapes)[owners]
    lengths = weights * settings.sample_step
    whole = np.bincount(seen, lengths, len(shapes))
    covered = np.bincount(seen[hit], lengths[hit], len(shapes))
    pairs = _sum_by_pair(
        seen[hit], perception_map.shape_of_segment[nearest[hit]], lengths[hit], distance[hit]
    )
    best: dict[int, Correspondence] = {}
    for pair in pairs:
        is_known = covered[pair.seen] >= settings.share * whole[pair.seen]
        if is_known and (pair.seen not in best or best[pair.seen].overlap < pair.overlap):
            best[pair.seen] = pair
    return tuple(best[index] for index in sorted(best))


def _distance(points: Array, segments: Array) -> Array:
    """Return the distance of each point (n, 2) from its segment (n, 4), (n,) [m]."""
    along = segments[:, 2:] - segments[:, :2]
    offsets = points - segments[:, :2]
    squared_lengths = np.maximum((along**2).sum(axis=1), np.finfo(float).tiny)
    share = np.clip((offsets * along).sum(axis=1) / squared_lengths, 0.0, 1.0)
    gaps = offsets - share[:, None] * along
    distance: Array = np.hypot(gaps[:, 0], gaps[:, 1])
    return distance


def _sum_by_pair(
    seen: NDArray[np.intp], known: NDArray[np.intp], lengths: Array, distance: Array
) -> list[Correspondence]:
    """Sum up what lies on what, in order of pairs."""
    if len(seen) == 0:
        return []
    columns = int(known.max()) + 1
    keys, inverse = np.unique(seen * columns + known, return_inverse=True)
    overlap = np.bincount(inverse, lengths)
    squares = np.bincount(inverse, lengths * distance**2)
    return [
        Correspondence(key // columns, key % columns, length, math.sqrt(square / length))
        for key, length, square in zip(keys.tolist(), overlap.tolist(), squares.tolist(), strict=True)
    ]
