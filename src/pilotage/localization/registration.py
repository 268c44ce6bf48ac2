"""Register a scan into the perception map (Wolter 2001, sections 3.2 and 3.3; decision 0006).

register(shapes, perception_map, odometry, RegistrationSettings()) -> Registration
    One scan, as the shapes that `perceive` returned. Then `perception_map.merged(registration)`.

A robot that moves calls both for every reading:

    perception_map = PerceptionMap()
    for reading in log:
        shapes = perceive(reading.scan, PerceptionSettings())
        registration = register(shapes, perception_map, reading.odometry, RegistrationSettings())
        perception_map = perception_map.merged(registration)
        registration.last_from_base   # the motion since the last reading
        perception_map.shapes         # the local map of the last 10 m, in `odom`
"""

import math
from dataclasses import dataclass, field

import numpy as np

from pilotage.geometry import Array, Pose2, frozen_array
from pilotage.perception import Correspondence, Odometry, PerceptionMap, Registration
from pilotage.perception.perception_map import segments_of
from pilotage.shape.partial import PartialShape


@dataclass(frozen=True, slots=True)
class OdometryNoise:
    """How far odometry errs on the way between two scans (standard deviations)."""

    place: float = 0.03  # [m] standing still
    place_per_meter: float = 0.3  # [m/m]
    turn: float = math.radians(1.0)  # [rad] standing still
    turn_per_meter: float = math.radians(20.0)  # [rad/m]
    turn_per_turn: float = 0.3  # [rad/rad]

    def deviations(self, motion: Pose2) -> tuple[float, float]:
        """Return the deviation of place [m] and of heading [rad] after a motion."""
        distance = math.hypot(motion.x, motion.y)
        return (
            self.place + self.place_per_meter * distance,
            self.turn + self.turn_per_meter * distance + self.turn_per_turn * abs(motion.theta),
        )


@dataclass(frozen=True, slots=True)
class RegistrationSettings:
    """How a scan is registered."""

    noise: OdometryNoise = field(default_factory=OdometryNoise)
    sample_step: float = 0.1  # [m] between the points that stand for a shape
    search_points: int = 80  # as many of them, at most, are tried at many poses
    search_turns: int = 7  # headings tried: that of odometry and the best by direction histogram
    search_bins: int = 120  # of the direction histogram: 3 degrees each
    search_step: float = 0.15  # [m] between places tried
    search_width: float = 0.3  # [m] at which a point counts half
    search_deviations: float = 3.0  # how many deviations of odometry away poses are tried
    search_penalty: float = 0.01  # share of points that outweighs one squared deviation
    starts: int = 4  # poses found by search that are refined
    max_turn: float = math.pi / 2  # [rad] never search farther
    max_place: float = 1.6  # [m] never search farther
    widths: tuple[float, ...] = (0.5, 0.35, 0.25, 0.2, 0.15, 0.1, 0.08, 0.06, 0.05, 0.05, 0.05, 0.05)  # [m]
    deviation: float = 0.1  # [m] of one sampled point; neighbors err alike, so it is more than a range's
    min_cosine: float = 0.5  # lines less than 60 degrees apart may be the same
    overhang: float = 0.1  # [m] a point may lie this far past the end of its segment


def register(
    shapes: tuple[PartialShape, ...],
    perception_map: PerceptionMap,
    odometry: Odometry,
    settings: RegistrationSettings,
) -> Registration:
    """Find where a scan was taken, from its shapes, the map and the motion that odometry reports.

    With an empty map, or shapes that match nothing, the motion is that of odometry.
    """
    from pilotage.kernels.point_to_segment import refine_pose
    from pilotage.kernels.segment_sampling import sample_segments

    before = perception_map.odometry
    motion = before.odom_from_base.inverse() @ odometry.odom_from_base if before else Pose2.identity()
    guess_pose = perception_map.odom_from_base @ motion
    guess = np.array([guess_pose.x, guess_pose.y, guess_pose.theta])
    place, turn = settings.noise.deviations(motion)
    information = np.diag([place**-2, place**-2, turn**-2]) * settings.deviation**2
    points, directions, weights, _ = sample_segments(segments_of(shapes), settings.sample_step)
    if len(points) == 0 or len(perception_map.segments) == 0:
        return _unregistered(shapes, perception_map, odometry, guess_pose, (place, turn))

    known = perception_map.segment_field
    starts = np.vstack(
        [guess, _search((points, directions, weights), perception_map, guess, (place, turn), settings)]
    )
    refined = [
        refine_pose(
            points,
            directions,
            weights,
            known,
            start,
            guess,
            information,
            np.array(settings.widths),
            settings.min_cosine,
            settings.overhang,
        )
        for start in starts
    ]
    pose, hessian, support, error = max(refined, key=lambda result: result[2])
    odom_from_base = Pose2(*pose.tolist())
    correspondences = _correspondences(shapes, perception_map, odom_from_base, settings)
    matched = {correspondence.seen for correspondence in correspondences}
    return Registration(
        odometry,
        odom_from_base,
        perception_map.odom_from_base.inverse() @ odom_from_base,
        shapes,
        correspondences,
        unmatched=tuple(index for index in range(len(shapes)) if index not in matched),
        support=float(support / weights.sum()),
        residual=math.sqrt(error / support) if support > 0.0 else 0.0,
        covariance=frozen_array(np.linalg.inv(hessian + information) * settings.deviation**2),
    )


def _unregistered(
    shapes: tuple[PartialShape, ...],
    perception_map: PerceptionMap,
    odometry: Odometry,
    odom_from_base: Pose2,
    deviations: tuple[float, float],
) -> Registration:
    """Believe odometry alone."""
    place, turn = deviations
    return Registration(
        odometry,
        odom_from_base,
        perception_map.odom_from_base.inverse() @ odom_from_base,
        shapes,
        correspondences=(),
        unmatched=tuple(range(len(shapes))),
        support=0.0,
        residual=0.0,
        covariance=np.diag([place**2, place**2, turn**2]),
    )


def _search(
    samples: tuple[Array, Array, Array],
    perception_map: PerceptionMap,
    guess: Array,
    deviations: tuple[float, float],
    settings: RegistrationSettings,
) -> Array:
    """Find poses from which refinement may start, (n, 3)."""
    from pilotage.kernels.pose_search import likely_turns, search_poses

    place, turn = deviations
    every = max(1, len(samples[0]) // settings.search_points)
    chosen = slice(every // 2, None, every)
    points, directions, weights = (np.ascontiguousarray(a[chosen]) for a in samples)
    turns = likely_turns(
        directions,
        weights,
        perception_map.segment_field,
        guess[2],
        min(settings.search_deviations * turn, settings.max_turn),
        settings.search_bins,
        settings.search_turns,
    )
    return search_poses(
        points,
        directions,
        weights,
        perception_map.segment_field,
        guess,
        turns,
        turn,
        place,
        min(settings.search_deviations * place, settings.max_place),
        settings.search_step,
        settings.search_width,
        settings.min_cosine,
        settings.search_penalty,
        settings.starts,
    )


def _correspondences(
    shapes: tuple[PartialShape, ...],
    perception_map: PerceptionMap,
    odom_from_base: Pose2,
    settings: RegistrationSettings,
) -> tuple[Correspondence, ...]:
    """Pair each perceived shape with the known shape that most of it lies on, if any does."""
    from pilotage.kernels.segment_field import NONE, find_nearest
    from pilotage.kernels.segment_sampling import sample_segments

    moved = tuple(shape.moved(odom_from_base) for shape in shapes)
    points, directions, weights, owners = sample_segments(segments_of(moved), settings.sample_step)
    known = perception_map.segment_field
    nearest = find_nearest(points, directions, known, settings.min_cosine)
    offsets = points - known.segments[nearest, :2]
    ways = known.directions[nearest]
    distance = np.abs(ways[:, 0] * offsets[:, 1] - ways[:, 1] * offsets[:, 0])
    hit = (nearest != NONE) & (distance <= perception_map.settings.cover_distance)
    seen = np.repeat(np.arange(len(shapes)), [len(shape.polyline.segment_lengths) for shape in shapes])[
        owners
    ]
    pairs = np.stack([seen, perception_map.shape_of_segment[nearest]])[:, hit]
    columns = len(perception_map.shapes)
    keys, inverse = np.unique(pairs[0] * columns + pairs[1], return_inverse=True)
    overlap = np.bincount(inverse, weights[hit], len(keys)) * settings.sample_step
    squares = np.bincount(inverse, weights[hit] * distance[hit] ** 2, len(keys)) * settings.sample_step
    best: dict[int, Correspondence] = {}
    for key, length, square in zip(keys.tolist(), overlap.tolist(), squares.tolist(), strict=True):
        found = Correspondence(key // columns, key % columns, length, math.sqrt(square / length))
        if found.seen not in best or best[found.seen].overlap < length:
            best[found.seen] = found
    return tuple(best[index] for index in sorted(best))
