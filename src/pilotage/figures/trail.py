"""A drive as a line: cut where the behavior changes, and left open where the estimate jumps."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from pilotage.figures import style
from pilotage.geometry import Array
from pilotage.localization import Status
from pilotage.navigation import Behavior, Step

COLORS = {
    Behavior.LOOK_AROUND: "#e39b2d",
    Behavior.EXPLORE: "#c8553d",
    Behavior.DRIVE_ON: "#d98c7a",
    Behavior.CROSS: style.TRAIL,
    Behavior.GO_THROUGH: "#4f9d69",
    Behavior.BACK_OUT: "#8a5a9e",
    Behavior.WAIT: "#b7a58a",
    Behavior.REST: style.INK,
}
LOCATED_WIDTH, LOST_WIDTH = 3.2, 1.1  # [points]
STILL = 0.002
"""A stretch shorter than this share of the picture is a turn on the spot, and drawn as a dot."""
JUMP = 0.04
"""A step longer than this share of the drawing's diagonal is a jump of the estimate, not a motion."""


@dataclass(frozen=True, eq=False)
class Stretch:
    """A part of a drive of one behavior, located all along or lost all along."""

    first: int  # number of the step at its first point
    behavior: Behavior
    located: bool
    points: Array  # (n >= 1, 2)

    @property
    def length(self) -> float:
        """From its first to its last point, along it."""
        return float(np.hypot(*np.diff(self.points, axis=0).T).sum())

    @property
    def color(self) -> str:
        """The color of the behavior."""
        return COLORS[self.behavior]


def find_stretches(steps: Sequence[Step], positions: Array, jump: float = np.inf) -> list[Stretch]:
    """Cut the positions (n, 2) of steps into stretches; each ends where the next begins, but for jumps."""
    kinds = [(step.behavior, step.estimate.status is Status.LOCATED) for step in steps]
    leaps = np.hypot(*np.diff(positions, axis=0).T) > jump
    cuts = [k for k in range(1, len(steps)) if kinds[k] != kinds[k - 1] or leaps[k - 1]]
    stretches = []
    for first, last in pairwise([0, *cuts, len(steps)]):
        end = last + 1 if last < len(steps) and not leaps[last - 1] else last
        stretches.append(Stretch(first, *kinds[first], positions[first:end]))
    return stretches


def draw_stretches(axes: Axes, stretches: Sequence[Stretch], still: float) -> None:
    """Draw stretches in the colors of their behaviors: thick where located, thin where lost.

    Those shorter than `still` [axes' units] become dots.
    """
    for located, width in ((False, LOST_WIDTH), (True, LOCATED_WIDTH)):
        chosen = [one for one in stretches if one.located == located]
        colors = [one.color for one in chosen]
        lines = [one.points for one in chosen]
        axes.add_collection(
            LineCollection(lines, colors=colors, linewidths=width, capstyle="round", zorder=8)
        )
        dots = [one for one in chosen if one.length < still and one.behavior is not Behavior.REST]
        x, y = np.array([one.points[0] for one in dots]).reshape(-1, 2).T
        faces = [one.color for one in dots]
        axes.scatter(x, y, s=9.0 * width, facecolor=faces, edgecolor="white", linewidths=0.5, zorder=8.5)
