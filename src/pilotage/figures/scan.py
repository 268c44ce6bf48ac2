"""A scan, and the partial shapes that are seen in it (Wolter 2001, figure 2)."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from pilotage.figures import style
from pilotage.geometry import Array, Pose2
from pilotage.perception import LaserScan
from pilotage.shape import PartialShape, relevances

FORWARD_UP = Pose2(0.0, 0.0, np.pi / 2)
"""The page from the robot: what is ahead of it is above it."""

TICKS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)  # [rad·m]
BAR_HEIGHT = 1.7  # [inches]
PANEL_WIDTH, PANEL_HEIGHTS = 5.4, (2.4, 7.0)  # [inches]


def scan_figure(scan: LaserScan, shapes: Sequence[PartialShape]) -> Figure:
    """Draw the returns of a scan, and beside them its shapes with vertices colored by relevance, eq. (1)."""
    points = FORWARD_UP @ scan.points_in_base
    low, high = extent(points)
    width, height = high - low
    panel = float(np.clip(PANEL_WIDTH * style.proportion(width, height), *PANEL_HEIGHTS))
    figure = style.new_figure(2.0 * PANEL_WIDTH + 1.9, panel + 1.4)
    left = style.place(figure, 0.3, 0.75, PANEL_WIDTH, panel)
    right = style.place(figure, 0.6 + PANEL_WIDTH, 0.75, PANEL_WIDTH, panel)
    draw_returns(left, scan)
    colored = draw_shapes(right, shapes)
    for axes in (left, right):
        style.frame(axes, low, high)
        style.draw_robot(axes, FORWARD_UP, 0.035 * max(width, height))
    style.bare(left, f"One scan: {int(scan.returned.sum())} returns of {len(scan)} beams")
    style.bare(
        right, f"{len(shapes)} partial shapes of {sum(len(shape.polyline) for shape in shapes)} vertices"
    )
    bar = style.round_length(0.2 * width)
    style.draw_scale_bar(left, bar, f"{bar:g} m")
    if colored is not None:
        add_relevance_bar(
            figure, style.place(figure, 2.0 * PANEL_WIDTH + 0.85, 0.75, 0.12, BAR_HEIGHT), colored
        )
    return figure


def extent(points: Array) -> tuple[Array, Array]:
    """Return the corners of the box around the returns and the robot, one metre at least."""
    all_points = np.vstack([points, np.zeros((1, 2))])
    low, high = all_points.min(axis=0), all_points.max(axis=0)
    lacking = np.maximum(1.0 - (high - low), 0.0) / 2.0
    return low - lacking, high + lacking


def draw_returns(axes: Axes, scan: LaserScan) -> None:
    """Draw the beams that came back as a fan, and where they came back from."""
    points = FORWARD_UP @ scan.points_in_base
    laser = FORWARD_UP @ scan.base_from_laser.position[np.newaxis]
    beams = np.stack([np.broadcast_to(laser, points.shape), points], axis=1)
    axes.add_collection(LineCollection(list(beams), colors=style.PALE, linewidths=0.5, zorder=1))
    axes.scatter(points[:, 0], points[:, 1], s=7.0, color=style.INK, linewidths=0.0, zorder=3)


def draw_shapes(axes: Axes, shapes: Sequence[PartialShape]) -> PathCollection | None:
    """Draw shapes as lines, their inner vertices by relevance, and their ends by whether they go on unseen.

    Returns the colored vertices, None if there are none.
    """
    vertices: list[Array] = [np.empty((0, 2))]
    relevance: list[Array] = [np.empty(0)]
    for shape in shapes:
        line = shape.polyline.moved(FORWARD_UP)
        axes.plot(*line.ring.T, color=style.GRAY, linewidth=1.6, solid_joinstyle="round", zorder=2)
        values = relevances(shape.polyline)
        vertices.append(line.vertices[np.isfinite(values)])
        relevance.append(values[np.isfinite(values)])
    draw_ends(axes, shapes)
    x, y = np.vstack(vertices).T
    values = np.concatenate(relevance)
    if not len(values):
        return None
    norm = LogNorm(max(values.min(), TICKS[0]), max(values.max(), TICKS[1]))
    return axes.scatter(
        x, y, c=values, cmap=style.RELEVANCE, norm=norm, s=26.0, edgecolor="white", linewidths=0.5, zorder=4
    )


def draw_ends(axes: Axes, shapes: Sequence[PartialShape]) -> None:
    """Mark the ends of shapes: filled where the true contour ends, hollow where it may go on."""
    ends = [
        (vertex, cause.goes_on)
        for shape in shapes
        if not shape.polyline.closed
        for vertex, cause in zip(
            shape.polyline.vertices[[0, -1]], (shape.first_end, shape.last_end), strict=True
        )
    ]
    for going_on, face, name in (
        (False, style.GRAY, "ends at a true edge"),
        (True, "white", "goes on unseen"),
    ):
        points = np.array([vertex for vertex, goes_on in ends if goes_on == going_on]).reshape(-1, 2)
        x, y = (FORWARD_UP @ points).T
        axes.scatter(x, y, s=16.0, facecolor=face, edgecolor=style.GRAY, linewidths=1.1, zorder=3, label=name)
    axes.legend(
        loc="upper left", bbox_to_anchor=(0.0, 0.0), ncols=2, frameon=False, fontsize=style.SMALL,
        handletextpad=0.2, borderaxespad=0.2, borderpad=0.2, columnspacing=1.5,
    )  # fmt: skip


def add_relevance_bar(figure: Figure, axes: Axes, colored: PathCollection) -> None:
    """Explain the colors."""
    bar = figure.colorbar(colored, cax=axes)
    bar.outline.set_visible(False)
    low, high = bar.ax.get_ylim()
    bar.set_ticks([tick for tick in TICKS if low <= tick <= high])
    bar.ax.yaxis.set_major_formatter("{x:g}")
    bar.ax.minorticks_off()
    bar.ax.tick_params(labelsize=style.SMALL, length=2)
    bar.ax.set_title("relevance\n[rad·m]", fontsize=style.SMALL, loc="left", pad=8)
