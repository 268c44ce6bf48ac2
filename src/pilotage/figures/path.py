"""Where the robot has been on the drawing, as far as it knows."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from pilotage.figures import style
from pilotage.figures.drawing import draw_labels, draw_strokes
from pilotage.figures.trail import JUMP
from pilotage.geometry import Array, Polyline
from pilotage.localization import Estimate, Explanation, Status, Verdict
from pilotage.maps import SchematicMap

PAGE_WIDTH, PAGE_TALLEST, SIDE_WIDTH = 9.6, 9.0, 2.9  # [inches]

VERDICTS = {
    Verdict.SEEN: style.GATEWAY,
    Verdict.HIDDEN: style.GOAL,
    Verdict.LOOKED_THROUGH: style.ACCENT,
}
"""Colors of walls by what is seen of them."""

VIEWED_SHARE = 0.9  # of the vertices of the local map lie in the close view
CLOSEST_VIEW = 4.0  # [m] from the robot to the edge of the close view, at least


def path_figure(
    sketch: SchematicMap,
    estimates: Sequence[Estimate],
    *,
    local_map: Sequence[Polyline] = (),
    truth: Array | None = None,
    explanation: Explanation | None = None,
    title: str = "",
) -> Figure:
    """Draw the estimated path on the drawing, and beside it what the laser saw last, laid over the drawing.

    `local_map` holds what the robot saw on the last metres, in its base frame [m]; `truth` the true path,
    where it is known, in the sketch frame, (n, 2) [drawing units]. An `explanation` of the last place colors
    the walls in view by what they say.
    """
    if not estimates:
        raise ValueError("a path needs at least one estimate, got none")
    left, bottom, right, top = sketch.bounds
    aspect = style.proportion(right - left, top - bottom)
    width = min(PAGE_WIDTH, PAGE_TALLEST / aspect)
    height = max(width * aspect, SIDE_WIDTH + 2.2)
    figure = style.new_figure(width + SIDE_WIDTH + 1.1, height + 0.9)
    page = style.place(figure, 0.3, 0.3, width, height)
    draw_page(page, sketch, estimates, truth)
    if explanation is not None:
        draw_explanation(page, explanation)
    style.frame(page, np.array([left, bottom]), np.array([right, top]), margin=0.03)
    style.bare(page, title)
    page.set_anchor("NW")
    side = width + 0.7
    if local_map:
        view = style.place(figure, side, height + 0.3 - SIDE_WIDTH, SIDE_WIDTH, SIDE_WIDTH)
        draw_close_view(view, sketch, estimates[-1], local_map)
    add_confidence_bar(figure, style.place(figure, side, height - SIDE_WIDTH - 0.15, SIDE_WIDTH, 0.1))
    figure.legend(
        *page.get_legend_handles_labels(), loc="upper left", frameon=False, fontsize=style.SMALL,
        labelspacing=0.7,
        bbox_to_anchor=(side / (width + SIDE_WIDTH + 1.1), (height - SIDE_WIDTH - 0.55) / (height + 0.9)),
        borderaxespad=0.0, borderpad=0.0,
    )  # fmt: skip
    return figure


def draw_page(axes: Axes, sketch: SchematicMap, estimates: Sequence[Estimate], truth: Array | None) -> None:
    """Draw walls, words, the path, and the last place with its rivals."""
    draw_strokes(axes, sketch.strokes, linewidth=2.4)
    draw_labels(axes, sketch)
    if truth is not None:
        axes.plot(
            *truth.T, color=style.GRAY, linewidth=1.0, linestyle=(0, (4, 3)), zorder=3, label="true path"
        )
    draw_path(axes, estimates, JUMP * sketch.diagonal)
    draw_rivals(axes, estimates[-1], sketch.diagonal)
    located = [estimate for estimate in estimates if estimate.status is Status.LOCATED]
    if located:
        style.draw_ring(axes, located[0].sketch_from_base.pose.position, label="first located")
    style.draw_robot(axes, estimates[-1].sketch_from_base.pose, 0.03 * sketch.diagonal)
    axes.scatter([], [], marker=">", s=60.0, color=style.ACCENT, label="the robot now")


def draw_path(axes: Axes, estimates: Sequence[Estimate], jump: float) -> None:
    """Draw located parts as a line colored by probability, lost ones as faint crosses; jumps are gaps."""
    positions = np.array([estimate.sketch_from_base.pose.position for estimate in estimates])
    confidence = np.array([estimate.probability for estimate in estimates])
    located = np.array([estimate.status is Status.LOCATED for estimate in estimates])
    pieces = np.stack([positions[:-1], positions[1:]], axis=1)
    steps = np.hypot(*(positions[1:] - positions[:-1]).T)
    joined = located[:-1] & located[1:] & (steps < jump)
    lines = LineCollection(
        list(pieces[joined]), cmap=style.CONFIDENCE, norm=Normalize(0.0, 1.0), linewidths=3.4,
        capstyle="round", zorder=5,
    )  # fmt: skip
    lines.set_array(np.minimum(confidence[:-1], confidence[1:])[joined])
    axes.add_collection(lines)
    axes.plot([], [], color=style.CONFIDENCE(0.9), linewidth=3.4, label="path, while located")
    if (~located).any():
        axes.scatter(
            positions[~located, 0], positions[~located, 1], marker="x", s=16.0, color=style.ACCENT,
            alpha=0.45, linewidths=0.9, zorder=4, label="best guess, while lost",
        )  # fmt: skip


def draw_rivals(axes: Axes, estimate: Estimate, diagonal: float) -> None:
    """Ring the places that the last estimate holds possible, the more probable the larger."""
    rivals = [
        hypothesis
        for hypothesis in estimate.hypotheses
        if np.hypot(*(hypothesis.sketch_from_base.pose.position - estimate.sketch_from_base.pose.position))
        > JUMP * diagonal
    ]
    if rivals:
        places = np.array([rival.sketch_from_base.pose.position for rival in rivals])
        sizes = np.array([rival.probability for rival in rivals])
        axes.scatter(
            places[:, 0], places[:, 1], s=30.0 + 400.0 * sizes, facecolor="none", edgecolor=style.ACCENT,
            linewidths=1.4, zorder=9, label="other places held possible",
        )  # fmt: skip


def draw_explanation(axes: Axes, explanation: Explanation) -> None:
    """Color the walls in view by what the last metres say of them."""
    for verdict, color in VERDICTS.items():
        ends = [wall.ends for wall in explanation.having(verdict)]
        if ends:
            axes.add_collection(
                LineCollection(ends, colors=color, linewidths=5.0, alpha=0.8, capstyle="round", zorder=2.5)
            )
            axes.plot([], [], color=color, linewidth=5.0, alpha=0.8, label=f"wall: {verdict.value}")


def add_confidence_bar(figure: Figure, axes: Axes) -> None:
    """Explain the colors of the path."""
    bar = figure.colorbar(
        ScalarMappable(Normalize(0.0, 1.0), style.CONFIDENCE), cax=axes, orientation="horizontal"
    )
    bar.outline.set_visible(False)
    bar.set_ticks([0.0, 0.5, 1.0], labels=["0", "confidence", "1"])
    bar.ax.tick_params(labelsize=style.SMALL, length=0)


def draw_close_view(
    axes: Axes, sketch: SchematicMap, estimate: Estimate, local_map: Sequence[Polyline]
) -> None:
    """Lay what the robot saw last over the drawing around it, in the estimate's own scale."""
    here = estimate.sketch_from_base
    draw_strokes(axes, sketch.strokes, linewidth=2.4)
    draw_strokes(axes, [shape.moved(here) for shape in local_map], color=style.ACCENT, linewidth=1.4)  # type: ignore[arg-type]
    reach = np.quantile(np.abs(np.vstack([shape.vertices for shape in local_map])), VIEWED_SHARE)
    half = here.scale * max(CLOSEST_VIEW, float(reach))
    axes.set_xlim(here.pose.x - half, here.pose.x + half)
    axes.set_ylim(here.pose.y - half, here.pose.y + half)
    style.draw_robot(axes, here.pose, 0.12 * half)
    style.bare(axes, "What it saw last")
    axes.spines[:].set_visible(True)
    axes.spines[:].set_color(style.PALE)
