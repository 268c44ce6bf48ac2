"""The true building of a simulation, as seen from above."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from pilotage.figures import style
from pilotage.geometry import Array
from pilotage.simulation import World

LEAF = "#e3d3c6"
"""A door that may close, where it would stand."""


def draw_world(axes: Axes, world: World, linewidth: float = 1.4) -> None:
    """Draw what stands: walls and things, glass, and faintly where doors may close."""
    draw_segments(axes, world.segments, style.INK, linewidth)
    draw_segments(axes, world.glass, style.GLASS, linewidth)
    doors = np.array([door.segment for door in world.doors]).reshape(-1, 4)
    draw_segments(axes, doors, LEAF, 1.5 * linewidth).set_zorder(2)


def draw_segments(axes: Axes, segments: Array, color: str, linewidth: float) -> LineCollection:
    """Draw segments, rows x1, y1, x2, y2, (n, 4), and return what was drawn."""
    lines = LineCollection(
        list(segments.reshape(-1, 2, 2)), colors=color, linewidths=linewidth, capstyle="round", zorder=7
    )
    axes.add_collection(lines)
    return lines
