"""Which drawn walls speak for a place and which against, as the sensor model weighs them.

Each reading of the last metres is set against the drawn wall that it faces from the place. The sensor model
tells how probably it shows that wall, and what it adds to the evidence of the place. The filter sums up the
same log-ratios, but gives all readings of a scan together the weight of a few (`effective_beams`).
"""

import math
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from pilotage import kernels
from pilotage.geometry import Affine2, Array
from pilotage.localization.keyframes import Keyframe
from pilotage.localization.sensor_model import NO_RETURN_BEYOND, NO_RETURN_RATIO, SensorModel

FEWEST = 3
"""Readings that a wall needs: fewer say nothing about it."""


class Verdict(Enum):
    """What the readings towards a wall say about the place."""

    SEEN = "seen where drawn"
    HIDDEN = "hidden by something nearer"
    LOOKED_THROUGH = "looked through"


@dataclass(frozen=True, eq=False)
class WallEvidence:
    """What the readings of the last metres say about one drawn wall, a segment of the simplified drawing."""

    ends: Array  # (2, 2) in the sketch frame, y up [drawing units]
    readings: int
    log_ratio: float  # [nats] a reading, on average: the likelihood over that of the null model
    shown: float  # [0..1] share of the readings that show it
    through: float  # [0..1] share of the readings that end behind it

    @property
    def hidden(self) -> float:
        """Share of the readings that end before it, [0..1]."""
        return 1.0 - self.shown - self.through

    @property
    def verdict(self) -> Verdict:
        """What most of the readings say."""
        if self.shown >= max(self.hidden, self.through):
            return Verdict.SEEN
        return Verdict.LOOKED_THROUGH if self.through > self.hidden else Verdict.HIDDEN


@dataclass(frozen=True, eq=False)
class Explanation:
    """The drawn walls in view from a place over the last metres."""

    place: str
    walls: tuple[WallEvidence, ...]  # those that add most to the evidence first

    def having(self, verdict: Verdict) -> tuple[WallEvidence, ...]:
        """Pick the walls of a verdict."""
        return tuple(wall for wall in self.walls if wall.verdict is verdict)

    @property
    def summary(self) -> str:
        """Say in one sentence what speaks for the place and what against.

        >>> Explanation("the kitchen", ()).summary
        'No wall in view from the kitchen.'
        """
        if not self.walls:
            return f"No wall in view from {self.place}."
        counts = {verdict: len(self.having(verdict)) for verdict in Verdict}
        told = [f"{counts[verdict]} {verdict.value}" for verdict in Verdict if counts[verdict]]
        walls = "wall" if len(self.walls) == 1 else "walls"
        return f"{len(self.walls)} {walls} in view from {self.place}: {', '.join(told)}."


def explain(
    place: str,
    sketch_from_base: Affine2,
    keyframes: tuple[Keyframe, ...],
    walls: Array,
    model: SensorModel,
) -> Explanation:
    """Set the readings of keyframes, the newest first, against the walls in view.

    `walls` are rows x1, y1, x2, y2 in the sketch frame, (k, 4) [drawing units]. The newest keyframe was taken
    at `sketch_from_base`; the earlier ones follow by registered motion.
    """
    base_from_odom = keyframes[0].odom_from_base.inverse()
    seen = [
        _readings(sketch_from_base @ (base_from_odom @ keyframe.odom_from_base), keyframe, walls, model)
        for keyframe in keyframes
    ]
    facing, errors, log_ratios, shares = (np.concatenate(column) for column in zip(*seen, strict=True))
    return Explanation(place, _summed(walls, facing, errors, log_ratios, shares))


def _readings(
    sketch_from_base: Affine2, keyframe: Keyframe, walls: Array, model: SensorModel
) -> tuple[NDArray[np.intp], Array, Array, Array]:
    """Return for each reading the wall that it faces, e, its log-ratio and its probability of a hit, (m,).

    Here e is log(predicted / measured). Readings that face no wall are left out, and so are beams without
    return where none was to be expected.
    """
    scan, visibility = keyframe.scan, kernels.visibility
    angles = scan.beams / visibility.HEADINGS * math.tau
    ahead = np.column_stack([np.cos(angles), np.sin(angles)]) @ sketch_from_base.linear.T
    eyes = np.tile(sketch_from_base.translation, (len(angles), 1))
    ways, numbers = kernels.raycast.first_met(eyes, np.arctan2(ahead[:, 1], ahead[:, 0]), walls)
    faces = (numbers >= 0) & (ways > 0.0)
    numbers, levels, classes = numbers[faces], scan.levels[faces], scan.classes[faces]
    log_predicted = np.log(ways[faces] / np.hypot(ahead[faces, 0], ahead[faces, 1]))  # in metres
    returned = levels != visibility.NO_RETURN
    error = log_predicted - np.where(returned, levels * visibility.LOG_STEP, np.inf)
    middle = model.log_ratios.shape[1] // 2
    steps = np.clip(np.nan_to_num(error / visibility.LOG_STEP, neginf=-middle), -middle, middle)
    columns = np.round(steps).astype(np.intp) + middle
    near = log_predicted < math.log(NO_RETURN_BEYOND)
    missing = np.where(near, NO_RETURN_RATIO, 0.0)
    log_ratio = np.where(returned, model.log_ratios[classes, columns], missing)
    shown = np.where(returned, model.hit_shares[classes, columns], 0.0)
    counts = returned | near
    return numbers[counts], error[counts], log_ratio[counts], shown[counts]


def _summed(
    walls: Array, facing: NDArray[np.intp], errors: Array, log_ratios: Array, shares: Array
) -> tuple[WallEvidence, ...]:
    """Gather the readings wall by wall."""
    through = (1.0 - shares) * (errors < 0.0)
    size = len(walls)
    counts = np.bincount(facing, minlength=size)
    sums, shown, behind = (
        np.bincount(facing, values, minlength=size) for values in (log_ratios, shares, through)
    )
    found = np.flatnonzero(counts >= FEWEST)
    found = found[np.argsort(-sums[found], kind="stable")]
    return tuple(
        WallEvidence(
            walls[number].reshape(2, 2),
            int(counts[number]),
            float(sums[number] / counts[number]),
            float(shown[number] / counts[number]),
            float(behind[number] / counts[number]),
        )
        for number in found.tolist()
    )
