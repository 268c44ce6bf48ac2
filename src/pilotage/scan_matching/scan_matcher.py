"""Scan by scan: perceive, register, merge into the local map (Wolter 2001, sections 2.1, 2.2 and 3.3)."""

import math
from dataclasses import dataclass, field

import numpy as np

from pilotage.geometry import Pose2
from pilotage.perception import LaserScan, Odometry, PerceptionSettings, perceive
from pilotage.scan_matching.local_map import LocalMap
from pilotage.scan_matching.odometry import MotionPrior, OdometryNoise, reported_motion, update_noise
from pilotage.scan_matching.register import Method, Registration, find_unmatched, register
from pilotage.shape import PartialShape

LONGEST_INERTIA = 1.0
"""[s] A robot without odometry is expected to keep its speed for no longer."""

ELSEWHERE = 0.3
"""A scan shows another place than those before if it has less than this share of their inliers."""

REMEMBERED = 20
"""So many scans tell how many inliers are usual."""

MIN_LEARNING_INLIERS = 0.25
"""With a smaller share of inliers, registration cannot judge odometry."""


@dataclass(frozen=True, slots=True)
class ScanMatchingSettings:
    """How scans are perceived and registered, and what the local map keeps."""

    perception: PerceptionSettings = field(default_factory=PerceptionSettings)
    method: Method = Method.SEGMENTS  # "segments", or "shapes": the paper's own, slower and less exact
    window: float = 10.0  # [m] of travel that the local map keeps; over 10 m it drifts by less than 10 cm
    keyframe_distance: float = 0.3  # [m] a scan is entered once the robot has moved this far ...
    keyframe_turn: float = math.radians(10.0)  # [rad] ... or turned so much since the last one entered

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        if not self.window > 0.0:
            raise ValueError(f"window must be > 0 m, got {self.window}")
        for name in ("keyframe_distance", "keyframe_turn"):
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must be >= 0, got {getattr(self, name)}")


@dataclass(frozen=True, slots=True, eq=False)
class ScanMotion:
    """What one scan told of the robot's motion.

    The frame `odom` is the one of the local map: poses in it are continuous and drift. It is odometry as
    registration corrected it, not the raw one.
    """

    last_from_base: Pose2  # the motion since the last reading
    odom_from_base: Pose2
    shapes: tuple[PartialShape, ...]  # what the scan shows, in the base frame
    inlier_share: float  # [0..1] share of the length of all shapes that lies on the local map
    was_carried: bool  # hardly any of it does, though there is something to compare
    odometry_refused: bool  # it reported a motion that no robot makes, and was not used


class ScanMatcher:
    """Follow the robot's motion scan by scan, and keep the local map of the last metres.

    An update that raises leaves the state as it was.
    """

    def __init__(self, settings: ScanMatchingSettings | None = None) -> None:
        self.settings = settings if settings is not None else ScanMatchingSettings()
        self.local_map = LocalMap()
        self.odom_from_base = Pose2.identity()
        self.noise = OdometryNoise()  # as learned so far
        self.refused_count = 0  # readings of odometry that were refused so far
        self._odometry: Odometry | None = None  # the last reading; None before the first
        self._traveled = 0.0  # [m]
        self._speed = (0.0, 0.0, 0.0)  # [m/s, m/s, rad/s] at the last reading, in the base frame
        self._inlier_shares: tuple[float, ...] = ()  # of the last scans that showed a place known
        self._odom_from_keyframe = Pose2.identity()  # where the last scan was entered

    def update(self, scan: LaserScan, odometry: Odometry) -> ScanMotion:
        """Take in one scan, and the odometry at its moment."""
        settings = self.settings
        shapes = perceive(scan, settings.perception)  # sections 2.1, 2.2
        prior = self._motion_prior(odometry)
        registration = register(shapes, self.local_map, prior, settings.method)  # 3.3, steps 1 and 3
        was_carried = registration.fit is not None and self._is_elsewhere(registration)
        odom_from_base, last_from_base = prior.odom_from_base, prior.motion
        inlier_shares = self._inlier_shares
        if registration.fit is not None and not was_carried:
            odom_from_base = registration.odom_from_base
            last_from_base = self.odom_from_base.inverse() @ odom_from_base
            inlier_shares = (*inlier_shares, registration.inlier_share)[-REMEMBERED:]
        traveled = self._traveled + math.hypot(last_from_base.x, last_from_base.y)
        noise = self._updated_noise(prior, registration) if odometry.is_known else self.noise
        local_map, odom_from_keyframe = self.local_map, self._odom_from_keyframe
        if was_carried or self._is_keyframe(odom_from_base):
            unmatched = find_unmatched(shapes, local_map, odom_from_base)  # 3.3, step 2, at that pose
            new = tuple(shapes[index].moved(odom_from_base) for index in unmatched)
            local_map = local_map.extended(new, traveled, settings.window)  # 3.3, step 4
            odom_from_keyframe = odom_from_base

        self.local_map, self.odom_from_base, self.noise = local_map, odom_from_base, noise
        self._inlier_shares = inlier_shares
        self._speed = self._speed_of(last_from_base, odometry.stamp)
        self._odometry, self._traveled, self._odom_from_keyframe = odometry, traveled, odom_from_keyframe
        self.refused_count += not prior.is_known
        return ScanMotion(
            last_from_base,
            odom_from_base,
            shapes,
            registration.inlier_share,
            was_carried,
            not prior.is_known,
        )

    def stood_still(self) -> None:
        """Take the next reading of odometry as being at the pose of now: its frame may have begun anew."""
        self._odometry, self._speed = None, (0.0, 0.0, 0.0)

    def _is_elsewhere(self, registration: Registration) -> bool:
        """Tell whether a scan shows another place: far fewer inliers than usual."""
        usual = float(np.median(self._inlier_shares)) if self._inlier_shares else 0.0
        return registration.inlier_share < ELSEWHERE * usual

    def _motion_prior(self, odometry: Odometry) -> MotionPrior:
        """Carry the last pose on by what odometry reports."""
        if self._odometry is None:
            return MotionPrior.of(Pose2.identity(), self.odom_from_base, self.noise)
        if not (odometry.is_known and self._odometry.is_known):
            seconds = odometry.stamp - self._odometry.stamp
            ahead = seconds if 0.0 < seconds < LONGEST_INERTIA else 0.0
            as_before = Pose2(*(ahead * speed for speed in self._speed))
            return MotionPrior.going_on(as_before, self.odom_from_base, seconds)
        motion = reported_motion(self._odometry, odometry)
        if motion is None:
            return MotionPrior.unknown(self.odom_from_base)
        return MotionPrior.of(motion, self.odom_from_base, self.noise)

    def _speed_of(self, motion: Pose2, stamp: float) -> tuple[float, float, float]:
        """Return the speed in the base frame since the last reading; 0 if it tells nothing."""
        seconds = 0.0 if self._odometry is None else stamp - self._odometry.stamp
        if not 0.0 < seconds < LONGEST_INERTIA:
            return 0.0, 0.0, 0.0
        return motion.x / seconds, motion.y / seconds, motion.theta / seconds

    def _updated_noise(self, prior: MotionPrior, registration: Registration) -> OdometryNoise:
        """Learn from what registration found, if it can judge odometry."""
        fit = registration.fit
        if fit is None or not prior.is_known or registration.inlier_share < MIN_LEARNING_INLIERS:
            return self.noise
        return update_noise(self.noise, prior, fit.pose, fit.hessian)

    def _is_keyframe(self, odom_from_base: Pose2) -> bool:
        """Tell whether the robot moved far enough for a new scan to be worth entering."""
        if not self.local_map.shapes:
            return True
        motion = self._odom_from_keyframe.inverse() @ odom_from_base
        return (
            math.hypot(motion.x, motion.y) >= self.settings.keyframe_distance
            or abs(motion.theta) >= self.settings.keyframe_turn
        )
