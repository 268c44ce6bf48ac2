"""Estimates for tests, and a localizer that knows: so that tests of driving do not depend on localizing."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np

from pilotage.geometry import Affine2, Pose2
from pilotage.localization import Estimate, PoseHypothesis, Status
from pilotage.maps import FileAxes


def hypothesis_at(pose, *, scale=1.0, cell_id="", probability=1.0, position_std=0.1, axis=(0.1, 0.0)):
    """Stand at a pose of the sketch, so many units a metre."""
    sketch_from_base = Affine2.from_state(pose.x, pose.y, pose.theta, np.log(scale), 0.0, 0.0)
    return PoseHypothesis(cell_id, sketch_from_base, probability, position_std, axis)


def estimate_of(*hypotheses, stamp=0.0, status=Status.LOCATED, cell_probability=1.0, fit=1.0, y_down=False):
    """Claim the first of these hypotheses."""
    return Estimate(
        stamp=stamp, status=status, hypotheses=hypotheses, cell_probability=cell_probability, fit=fit,
        place=hypotheses[0].cell_id, file_axes=FileAxes(y_down),
    )  # fmt: skip


def estimate_at(x, y, heading=0.0, *, scale=1.0, cell_id="c1", probability=1.0, position_std=0.1, **claim):
    """Claim one pose of the sketch."""
    one = hypothesis_at(
        Pose2(x, y, heading), scale=scale, cell_id=cell_id, probability=probability, position_std=position_std
    )
    return estimate_of(one, **claim)


class KnowingLocalizer:
    """Knows where the robot is, as its wheels do not slip; `changed` is what it claims instead."""

    def __init__(self, atlas, start, *, scale=1.0, changed=lambda estimate: estimate):
        self.atlas, self.start, self.scale, self.changed = atlas, start, scale, changed
        self.scan_matcher = SimpleNamespace(odom_from_base=Pose2.identity())
        self.estimate = None
        self.blocked = []  # ways, in the robot's frame

    def update(self, scan, odometry):
        """Claim the pose that the wheels tell."""
        self.scan_matcher.odom_from_base = odometry.odom_from_base
        pose = self.start @ odometry.odom_from_base
        pose = Pose2(self.scale * pose.x, self.scale * pose.y, pose.theta)
        cell_id = self.atlas.cell_at((pose.x, pose.y))
        known = estimate_of(hypothesis_at(pose, scale=self.scale, cell_id=cell_id), stamp=scan.stamp)
        self.estimate = self.changed(known)
        return self.estimate

    def add_blocked_way(self, way):
        """Take note of a way; who knows where it is has no use for it."""
        self.blocked.append(way)

    def sample(self, count):
        """Repeat the pose that it claims."""
        sketch_from_base = self.estimate.sketch_from_base
        pose = sketch_from_base.pose
        state = [pose.x, pose.y, pose.theta, np.log(sketch_from_base.scale), 0.0, 0.0]
        return np.tile(np.array(state)[:, np.newaxis], (1, count))


def with_leading(estimate, **changes):
    """Change the leading hypothesis."""
    return replace(
        estimate, hypotheses=(replace(estimate.hypotheses[0], **changes), *estimate.hypotheses[1:])
    )
