"""A drawing beside what became of it: in metres, seen walls drawn through, the others dashed."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pilotage.correction import CorrectedDrawing, PassageState
from pilotage.figures import style
from pilotage.figures.drawing import draw_labels, draw_strokes
from pilotage.geometry import Array
from pilotage.maps import SchematicMap

HEIGHT, WIDEST = 4.6, 6.4
"""Greatest height and width [inches] of each of the two pictures."""
NARROWEST = 7.5
"""Least width [inches] of the page, for title and legend."""
BAR = 5.0
"""Length [m] of the scale bar."""


def corrected_figure(
    sketch: SchematicMap, corrected: CorrectedDrawing, *, true_hits: Array | None = None
) -> Figure:
    """Draw both side by side.

    `true_hits` are points of true walls, if known, in the frame of the corrected drawing, (n, 2) [m].
    """
    sizes = [box_size(one) for one in (sketch, corrected.sketch)]
    heights = [min(HEIGHT, WIDEST * tall / wide) for wide, tall in sizes]
    widths = [height * wide / tall for height, (wide, tall) in zip(heights, sizes, strict=True)]
    figure = style.new_figure(max(sum(widths) + 1.1, NARROWEST), max(heights) + 1.2)
    before = style.place(figure, 0.3, 0.7, widths[0], max(heights))
    draw_strokes(before, sketch.strokes, linewidth=2.0)
    draw_labels(before, sketch)
    show_whole(before, sketch, "as drawn")
    after = style.place(figure, widths[0] + 0.8, 0.7, widths[1], max(heights))
    draw_corrected(after, corrected, true_hits)
    show_whole(after, corrected.sketch, f"as found, {corrected.scale:.3g} units a metre")
    figure.legend(
        *after.get_legend_handles_labels(), loc="lower center", frameon=False, fontsize=style.SMALL, ncols=5
    )
    return figure


def draw_corrected(axes: Axes, corrected: CorrectedDrawing, true_hits: Array | None) -> None:
    """Draw the corrected drawing, the robot's way, gateways and a scale bar."""
    if true_hits is not None:
        axes.plot(*true_hits.T, ",", color=style.GRAY, alpha=0.6, zorder=1)
    axes.plot(*corrected.path[:, :2].T, color=style.TRAIL, linewidth=0.7, zorder=2, label="the robot's way")
    for lines, dashes, name in ((corrected.seen, "-", "seen"), (corrected.unseen, (0, (2, 2)), "never seen")):
        for number, line in enumerate(lines):
            axes.plot(
                *line.ring.T, color=style.INK, linewidth=1.6, linestyle=dashes, zorder=5,
                label=name if number == 0 else None,
            )  # fmt: skip
    for state, color in ((PassageState.OPEN, style.GATEWAY), (PassageState.CLOSED, style.ACCENT)):
        chosen = [passage for passage in corrected.passages if passage.state is state]
        for number, passage in enumerate(chosen):
            label = f"found {state.value}" if number == 0 else None
            axes.plot(*passage.segment.T, color=color, linewidth=2.4, zorder=6, label=label)
    draw_labels(axes, corrected.sketch)
    left, bottom, right, _ = corrected.sketch.bounds
    below = bottom - 0.03 * (right - left)
    axes.plot([left, left + BAR], [below, below], color=style.INK, linewidth=2.0)
    axes.text(left + 1.1 * BAR, below, f"{BAR:g} m", va="center", fontsize=style.SMALL, color=style.INK)


def show_whole(axes: Axes, sketch: SchematicMap, title: str) -> None:
    """Frame a drawing."""
    left, bottom, right, top = sketch.bounds
    style.frame(axes, np.array([left, bottom]), np.array([right, top]), margin=0.06)
    style.bare(axes, title)


def box_size(sketch: SchematicMap) -> tuple[float, float]:
    """Return width and height of a drawing, neither far smaller than the other."""
    left, bottom, right, top = sketch.bounds
    least = max(right - left, top - bottom) / style.MOST_EXTREME
    return max(right - left, least), max(top - bottom, least)
