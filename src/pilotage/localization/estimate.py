"""What the localizer says: where the robot is on the drawing, how probable that is, and whether it fits."""

import math
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import cached_property

import numpy as np

from pilotage import kernels
from pilotage.geometry import Affine2, Array, Pose2
from pilotage.localization.particles import LOG_SCALE, Particles, X, Y, mean_state
from pilotage.localization.tracks import Tracks
from pilotage.maps import Atlas, FileAxes

RADIUS = 2.0
"""[m] Particles within this distance of the densest point are one hypothesis."""
DENSITY_BLOCK = 1.0
"""[m] The densest point is sought over three by three blocks of this size."""
MAX_BLOCKS = 1_000
"""Blocks along a side of the drawing, at most: on one that is longer than a kilometre they are larger."""
MAX_HYPOTHESES = 5
"""Number of hypotheses that are told, at most."""
MIN_PROBABILITY = 0.02
"""Probability of a further hypothesis that is worth telling."""

MORE_PROBABLE_THAN_NOT = 0.5
"""Probability from which on the robot claims a place."""

CALIBRATION = (-0.26, 0.55)
"""A probability with log-odds x is told as one with log-odds a + b x. The filter counts the errors of a
drawing, which persist for metres, as independent from keyframe to keyframe, so its log-odds are too large.
Fitted by maximum likelihood on aces, belgioioso, csail and freiburg-079."""


class Status(Enum):
    """Whether the robot knows where it is."""

    LOCATED = "located"  # one hypothesis is more probable than not
    LOST = "lost"  # the estimate is a best guess
    MISMATCH = "mismatch"  # drawings of other buildings explain the way better than this one


@dataclass(frozen=True)
class PoseHypothesis:
    """A cluster of particles: one place where the robot may be."""

    cell_id: str  # empty if the drawing has no cells
    sketch_from_base: Affine2  # robot frame [m] to sketch (y up) [drawing units]; holds near the robot only
    probability: float  # [0..1]
    position_std: float = 0.0  # [m] root mean square distance of the particles from their mean
    position_axis: tuple[float, float] = (0.0, 0.0)  # its largest spread, [drawing units]

    def moved(self, motion: Pose2, atlas: Atlas | None = None) -> "PoseHypothesis":
        """Carry the hypothesis along by a motion in the robot's frame."""
        sketch_from_base = self.sketch_from_base @ motion
        pose = sketch_from_base.pose
        cell_id = self.cell_id if atlas is None else atlas.cell_at((pose.x, pose.y))
        return replace(self, cell_id=cell_id, sketch_from_base=sketch_from_base)


@dataclass(frozen=True)
class Estimate:
    """Where the robot is on the drawing."""

    stamp: float  # [s]
    status: Status
    hypotheses: tuple[PoseHypothesis, ...]  # the most probable first, at least one
    cell_probability: float  # [0..1] that the robot is in the cell of the first hypothesis, anywhere in it
    fit: float  # [0..1] share of what was seen over the last metres that shows the drawn walls
    place: str  # the label of the cell if it has one, else its id
    log_evidence: float = 0.0  # [nats] of this drawing over other buildings, since the first scan
    file_axes: FileAxes = field(default_factory=FileAxes)  # of the drawing

    @property
    def probability(self) -> float:
        """Probability of the first hypothesis, [0..1]."""
        return self.hypotheses[0].probability

    @property
    def cell_id(self) -> str:
        """Cell of the first hypothesis."""
        return self.hypotheses[0].cell_id

    @property
    def sketch_from_base(self) -> Affine2:
        """Local affine map of the first hypothesis."""
        return self.hypotheses[0].sketch_from_base

    @cached_property
    def pose(self) -> Pose2:
        """Pose of the first hypothesis [drawing units, rad] in the axes of the drawing's file.

        The heading is counter-clockwise on the page from its x axis.
        """
        return self.file_axes.pose_from_sketch(self.sketch_from_base.pose)

    @property
    def x(self) -> float:
        """Position in the axes of the drawing's file [drawing units]."""
        return self.pose.x

    @property
    def y(self) -> float:
        """Position in the axes of the drawing's file [drawing units]."""
        return self.pose.y

    @property
    def heading(self) -> float:
        """Heading counter-clockwise on the page from its x axis [rad]."""
        return self.pose.theta

    @property
    def scale(self) -> float:
        """Drawing units per metre at the first hypothesis."""
        return self.sketch_from_base.scale

    @property
    def position_std(self) -> float:
        """Spread of the first hypothesis [m]."""
        return self.hypotheses[0].position_std

    @property
    def position_axis(self) -> tuple[float, float]:
        """Axis of the largest spread of the first hypothesis [drawing units]."""
        return self.hypotheses[0].position_axis

    def moved(self, motion: Pose2, atlas: Atlas | None = None) -> "Estimate":
        """Carry the estimate along by a motion in the robot's frame; an atlas names the cell there."""
        hypotheses = tuple(one.moved(motion, atlas) for one in self.hypotheses)
        place = self.place if atlas is None else atlas.place_name(hypotheses[0].cell_id)
        return replace(self, hypotheses=hypotheses, place=place)


def summarize(
    tracks: Tracks,
    fit: float,
    stamp: float,
    log_evidence: float,
    atlas: Atlas,
    *,
    is_mismatch: bool,
) -> Estimate:
    """Cluster the particles into pose hypotheses, and say how probable the first one is.

    `log_evidence` is that of the drawing over that of other buildings [nats], and `is_mismatch` what follows
    from it.
    """
    particles = tracks.particles
    hypotheses = calibrated(find_hypotheses(particles, atlas))
    first = hypotheses[0]
    inside = atlas.are_in((first.cell_id,), particles.states[:2].T) if first.cell_id else np.zeros(0, bool)
    in_cell = math.exp(particles.log_mass) * float(particles.shares[inside].sum()) if inside.any() else 0.0
    status = Status.LOCATED if first.probability >= MORE_PROBABLE_THAN_NOT else Status.LOST
    if is_mismatch:
        status = Status.MISMATCH
    return Estimate(
        stamp=stamp,
        status=status,
        hypotheses=hypotheses,
        cell_probability=max(calibrate(in_cell), first.probability),
        fit=fit,
        place=atlas.place_name(first.cell_id),
        log_evidence=log_evidence,
        file_axes=atlas.sketch.file_axes,
    )


def find_hypotheses(particles: Particles, atlas: Atlas) -> tuple[PoseHypothesis, ...]:
    """Gather particles around the densest points, the most probable first; at least one."""
    mass, remaining = math.exp(particles.log_mass), particles.shares
    table = atlas.range_table
    bounds = (*table.corner, table.columns * table.cell_size, table.rows * table.cell_size)
    found: list[PoseHypothesis] = []
    while len(found) < MAX_HYPOTHESES:
        members = kernels.density.gather_densest(
            particles.states, remaining, bounds, DENSITY_BLOCK, MAX_BLOCKS, RADIUS
        )
        if found and mass * float(remaining[members].sum()) < MIN_PROBABILITY:
            break
        found.append(_hypothesis(particles.states.compress(members, axis=1), remaining[members], mass, atlas))
        remaining = np.where(members, 0.0, remaining)
        if not remaining.any():
            break
    return tuple(sorted(found, key=lambda one: -one.probability))


def calibrate(probability: float) -> float:
    """Tell a probability of the filter as what it is worth.

    >>> calibrate(0.0), round(calibrate(0.99), 2), calibrate(1.0) < 1.0
    (0.0, 0.91, True)
    """
    if probability <= 0.0:
        return 0.0
    probability = min(probability, 1.0 - 1e-4)
    a, b = CALIBRATION
    return 1.0 / (1.0 + math.exp(-(a + b * math.log(probability / (1.0 - probability)))))


def calibrated(hypotheses: tuple[PoseHypothesis, ...]) -> tuple[PoseHypothesis, ...]:
    """Calibrate the first probability; the others share what it leaves, as before."""
    first, *others = hypotheses
    probability = calibrate(first.probability)
    left = (1.0 - probability) / max(1.0 - first.probability, 1e-9)
    rest = (replace(one, probability=min(one.probability * left, probability)) for one in others)
    return (replace(first, probability=probability), *rest)


def _hypothesis(states: Array, weights: Array, mass: float, atlas: Atlas) -> PoseHypothesis:
    """Sum up particles that stand close together; their weights are shares of this mass."""
    mean = mean_state(states, weights)
    offsets = states[[X, Y]] - mean[[X, Y], np.newaxis]
    covariance = np.einsum("in,jn,n->ij", offsets, offsets, weights / weights.sum())
    variances, axes = np.linalg.eigh(covariance)
    variances = np.maximum(variances, 0.0)
    axis = math.sqrt(float(variances[-1])) * axes[:, -1]
    return PoseHypothesis(
        atlas.cell_at((float(mean[X]), float(mean[Y]))),
        Affine2.from_state(*mean.tolist()),
        min(mass * float(weights.sum()), 1.0),
        math.sqrt(float(variances.sum())) / math.exp(float(mean[LOG_SCALE])),
        (float(axis[0]), float(axis[1])),
    )
