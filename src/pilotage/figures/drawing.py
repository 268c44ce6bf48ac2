"""A drawing before and after discrete curve evolution (Wolter 2001, figure 1)."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from pilotage.figures import style
from pilotage.geometry import Polyline
from pilotage.maps import SchematicMap

WIDE = 0.4
"""Drawings flatter than this stand one above the other."""
NARROW_PANEL, WIDE_PANEL, TALLEST = 5.8, 10.5, 10.0  # [inches]


def drawing_figure(sketch: SchematicMap, evolved: Sequence[Polyline]) -> Figure:
    """Draw the strokes as they were made, and beside them what is left of them."""
    left, bottom, right, top = sketch.bounds
    aspect = style.proportion(right - left, top - bottom)
    if aspect > WIDE:
        width = min(NARROW_PANEL, TALLEST / aspect)
        height = width * aspect
        figure = style.new_figure(2.0 * width + 0.9, height + 0.8)
        before = style.place(figure, 0.3, 0.3, width, height)
        after = style.place(figure, 0.6 + width, 0.3, width, height)
    else:
        height = WIDE_PANEL * aspect
        figure = style.new_figure(WIDE_PANEL + 0.6, 2.0 * height + 1.3)
        before = style.place(figure, 0.3, height + 0.8, WIDE_PANEL, height)
        after = style.place(figure, 0.3, 0.3, WIDE_PANEL, height)
    for axes, strokes, word in ((before, sketch.strokes, "As drawn"), (after, evolved, "After evolution")):
        draw_strokes(axes, strokes)
        count = sum(len(stroke) for stroke in strokes)
        style.frame(axes, np.array([left, bottom]), np.array([right, top]))
        style.bare(axes, f"{word}: {len(strokes)} strokes, {count} vertices")
    draw_vertices(after, evolved)
    draw_labels(before, sketch)
    return figure


def draw_strokes(
    axes: Axes, strokes: Sequence[Polyline], color: str = style.INK, linewidth: float = 1.8
) -> None:
    """Draw strokes with a round pen."""
    for stroke in strokes:
        axes.plot(
            *stroke.ring.T,
            color=color,
            linewidth=linewidth,
            solid_joinstyle="round",
            solid_capstyle="round",
            zorder=7,
        )


def draw_vertices(axes: Axes, strokes: Sequence[Polyline]) -> None:
    """Mark every vertex."""
    x, y = np.vstack([stroke.vertices for stroke in strokes]).T
    axes.scatter(x, y, s=15.0, color=style.ACCENT, edgecolor="white", linewidths=0.6, zorder=8)


def draw_labels(axes: Axes, sketch: SchematicMap) -> None:
    """Write the words of the drawing where they stand."""
    for label in sketch.labels:
        axes.text(
            *label.position, label.text, color=style.GRAY, fontsize=style.TEXT, style="italic",
            ha="center", va="center", zorder=6, parse_math=False,
            path_effects=[withStroke(linewidth=3.0, foreground="white")],
        )  # fmt: skip
