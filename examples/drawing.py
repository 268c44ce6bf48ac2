"""Draw a building as a hand does: from memory, with tremor, on a sheet that lies a little askew."""

import math
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from floors.plan import Memory, Points
from pilotage.geometry import Array


@dataclass(frozen=True)
class Hand:
    """How steadily a hand draws, in metres of the building."""

    tremor: float  # [m]
    sway: float  # [m] by which lines stray over some metres
    overshoot: float  # [m] by which a stroke ends too early or too late
    pen: float  # width of the pen [drawing units]
    ink: str
    paper: str


CAREFUL = Hand(tremor=0.012, sway=0.03, overshoot=0.05, pen=2.2, ink="#1f3a5f", paper="#ffffff")
QUICK = Hand(tremor=0.05, sway=0.12, overshoot=0.12, pen=3.0, ink="#2f3136", paper="#fbf8f1")


@dataclass(frozen=True)
class Sheet:
    """Where a memory comes to lie on a sheet of paper [drawing units, y down]."""

    memory: Memory
    hand: Hand
    scale: float  # [drawing units / m]
    turn: float  # [rad] clockwise
    waves: Array  # (2,) phases of the sway
    corner: tuple[float, float] = (0.0, 0.0)  # [drawing units] where the memory's origin lies

    def moved(self, by: Array) -> "Sheet":
        """Move the drawing on the sheet by (2,) [drawing units]."""
        return replace(self, corner=(self.corner[0] + by[0], self.corner[1] + by[1]))

    def __call__(self, points: Array) -> Array:
        """Carry points (n, 2) of the building [m, y down] to the sheet."""
        x, y = points[:, 0], points[:, 1]
        phases = 0.35 * x[:, np.newaxis] + 0.5 * y[:, np.newaxis] * np.array([1, -1]) + self.waves
        drawn = self.memory(points) + self.hand.sway * np.sin(phases)
        c, s = math.cos(self.turn), math.sin(self.turn)
        return np.asarray(np.array(self.corner) + self.scale * drawn @ np.array([[c, s], [-s, c]]))


def trembling(stroke: Points, hand: Hand, rng: np.random.Generator) -> Array:
    """Draw a stroke with points close together, none quite in its place, and ends a little off, (n, 2)."""
    corners = np.array(stroke, dtype=np.float64)
    first, last = corners[0] - corners[1], corners[-1] - corners[-2]
    corners[0] += first / np.hypot(*first) * rng.uniform(-hand.overshoot / 2, hand.overshoot)
    corners[-1] += last / np.hypot(*last) * rng.uniform(-hand.overshoot / 2, hand.overshoot)
    pieces = [corners[:1]]
    for a, b in pairwise(corners):
        count = max(2, round(float(np.hypot(*(b - a))) / 0.8))
        shares = np.concatenate([[0.12 / count], np.arange(1, count) / count, [1.0 - 0.12 / count, 1.0]])
        pieces.append(a + shares[:, np.newaxis] * (b - a))
    points = np.vstack(pieces)
    shaking = rng.normal(0.0, hand.tremor, points.shape)
    return points + shaking * np.minimum(1.0, 0.3 + rng.random(len(points)))[:, np.newaxis]


def smooth(points: Array) -> str:
    """Write points as a path of quadratic curves through the middles between them."""
    middles = (points[:-1] + points[1:]) / 2.0
    text = f"M{points[0, 0]:.1f} {points[0, 1]:.1f} L{middles[0, 0]:.1f} {middles[0, 1]:.1f}"
    for control, end in zip(points[1:-1], middles[1:], strict=True):
        text += f" Q{control[0]:.1f} {control[1]:.1f} {end[0]:.1f} {end[1]:.1f}"
    return text + f" L{points[-1, 0]:.1f} {points[-1, 1]:.1f}"
