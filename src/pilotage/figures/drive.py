"""A drive drawn twice: on the drawing as the robot believed it, and in the world as it was."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from pilotage.drives import Drive
from pilotage.figures import style
from pilotage.figures.drawing import draw_labels, draw_strokes
from pilotage.figures.trail import (
    COLORS,
    JUMP,
    LOCATED_WIDTH,
    LOST_WIDTH,
    STILL,
    draw_stretches,
    find_stretches,
)
from pilotage.figures.words import clock
from pilotage.figures.world import draw_segments, draw_world
from pilotage.geometry import Array
from pilotage.localization import Status
from pilotage.maps import CellGraph
from pilotage.navigation import Step
from pilotage.simulation import Scene

PANEL_WIDTH, TALLEST = 6.4, 8.0  # [inches]
FOOT = 0.8  # [inches] for the legend
CLOCK = (10.0, 15.0, 30.0, 60.0, 120.0, 300.0, 600.0, 1200.0, 3600.0)  # [s] between marks of time
MOST_MARKS = 10
BOX = {"boxstyle": "round,pad=0.22", "facecolor": "white", "edgecolor": style.GRAY, "linewidth": 0.6}
GUESSES = 8
"""Crosses on a stretch on which it was lost, about."""


def drive_figure(drive: Drive, title: str = "") -> Figure:
    """Draw a drive on the drawing and in the world, colored by behavior.

    Both pictures bear the same marks of time.
    """
    aspects = [style.proportion(*(high - low)) for low, high in drive.boxes]
    width = min(PANEL_WIDTH, TALLEST / max(aspects))
    height = width * max(aspects)
    figure = style.new_figure(2.0 * width + 0.9, height + FOOT + 0.45 + (0.4 if title else 0.0))
    believed = style.place(figure, 0.3, FOOT, width, height)
    true = style.place(figure, 0.6 + width, FOOT, width, height)
    draw_believed(believed, drive)
    draw_true(true, drive)
    names = ("On the drawing, as believed", "In the world, as it was")
    for axes, box, name in zip((believed, true), drive.boxes, names, strict=True):
        style.frame(axes, *box, margin=0.02)
        style.bare(axes, name)
        axes.set_anchor("NW")
    if title:
        figure.text(
            0.3 / figure.get_figwidth(), 1.0 - 0.3 / figure.get_figheight(), title, fontsize=style.TITLE,
            color=style.INK, weight="bold", va="center", parse_math=False,
        )  # fmt: skip
    add_legend(figure, drive.steps)
    return figure


def draw_believed(axes: Axes, drive: Drive) -> None:
    """Draw the path as believed, the gateways passed and those found blocked, first fix, end and goal."""
    size, steps = drive.sketch.diagonal, drive.steps
    draw_strokes(axes, drive.sketch.strokes, linewidth=1.6)
    draw_labels(axes, drive.sketch)
    if drive.graph is not None:
        draw_gateways(axes, drive.graph, steps)
    poses = [step.estimate.sketch_from_base.pose for step in steps]
    positions = np.array([pose.position for pose in poses])
    stretches = find_stretches(steps, positions, JUMP * size)
    draw_stretches(axes, [one for one in stretches if one.located], STILL * size)
    draw_guesses(axes, [one.points for one in stretches if not one.located])
    located = np.array([step.estimate.status is Status.LOCATED for step in steps])
    draw_marks(axes, drive.times, positions, located)
    if located.any():
        style.draw_ring(axes, positions[int(np.argmax(located))])
    for point in drive.goal_points.tolist():
        draw_goal(axes, point)
    style.draw_robot(axes, poses[-1], 0.03 * size)


def draw_guesses(axes: Axes, ways: Sequence[Array]) -> None:
    """Draw where the robot may have been while lost: some points of each path (n, 2)."""
    thinned = [np.empty((0, 2)), *(way[:: max(1, len(way) // GUESSES)] for way in ways)]
    x, y = np.vstack(thinned).T
    axes.scatter(x, y, marker="x", s=13.0, color=style.ACCENT, alpha=0.4, linewidths=0.8, zorder=6)


def draw_true(axes: Axes, drive: Drive) -> None:
    """Draw the true path, and the people and closed doors as they were at the end."""
    low, high = drive.boxes[1]
    size = float(np.hypot(*(high - low)))
    draw_world(axes, drive.world)
    draw_segments(axes, drive.scenes[-1].closed_doors, style.DOOR, 2.2)
    draw_people(axes, drive.scenes)
    poses = [scene.world_from_base for scene in drive.scenes]
    positions = np.array([pose.position for pose in poses])
    draw_stretches(axes, find_stretches(drive.steps, positions), STILL * size)
    draw_marks(axes, drive.times, positions, np.full(len(poses), fill_value=True))
    style.draw_ring(axes, positions[0])
    if drive.true_goal is not None:
        draw_goal(axes, drive.true_goal)
    style.draw_robot(axes, poses[-1], 0.03 * size)


def draw_people(axes: Axes, scenes: Sequence[Scene]) -> None:
    """Draw the ways of people, and where they ended."""
    for person in range(len(scenes[0].people)):
        way = np.array([scene.people[person] for scene in scenes])
        axes.plot(*way.T, color=style.PERSON, linewidth=0.8, alpha=0.6, zorder=3)
    x, y = scenes[-1].people.T
    axes.scatter(x, y, s=34.0, color=style.PERSON, edgecolor="white", linewidths=0.8, zorder=9)


def draw_gateways(axes: Axes, graph: CellGraph, steps: Sequence[Step]) -> None:
    """Draw the gateways that were passed, and cross out those that were found closed."""
    for gateway_id in passed_gateways(steps):
        axes.plot(*graph.gateway(gateway_id).segment.T, color=style.GATEWAY, linewidth=2.4, zorder=7.5)
    for gateway_id in steps[-1].closed_gateway_ids:
        gateway = graph.gateway(gateway_id)
        axes.plot(*gateway.segment.T, color=style.DOOR, linewidth=2.4, zorder=7.5)
        x, y = gateway.middle
        axes.scatter(x, y, marker="x", s=60.0, color=style.DOOR, linewidths=2.2, zorder=9)


def passed_gateways(steps: Sequence[Step]) -> tuple[str, ...]:
    """List the gateways by which the robot says that it came into the cell it was heading for, in order."""
    passed = []
    heading_for, gateway_id = "", ""
    for step in steps:
        if step.estimate.status is Status.LOCATED and heading_for == step.estimate.cell_id and gateway_id:
            passed.append(gateway_id)
        heading_for, gateway_id = step.next_cell_id, step.gateway_id
    return tuple(dict.fromkeys(passed))


def draw_marks(axes: Axes, times: Array, positions: Array, shown: NDArray[np.bool_]) -> None:
    """Mark round times (n,) [s] on a way (n, 2), the same on both pictures."""
    every = next((gap for gap in CLOCK if times[-1] / gap <= MOST_MARKS), CLOCK[-1])
    for mark in np.arange(every, times[-1], every).tolist():
        k = int(np.searchsorted(times, mark))
        if shown[k]:
            x, y = positions[k]
            axes.text(
                x, y, clock(mark), fontsize=5.8, color=style.INK, ha="center", va="center",
                zorder=10, bbox=BOX,
            )  # fmt: skip


def draw_goal(axes: Axes, goal: tuple[float, float]) -> None:
    """Draw where it should end."""
    axes.scatter(
        goal[0], goal[1], marker="*", s=190.0, color=style.GOAL, edgecolor="white", linewidths=1.0, zorder=9.5
    )


def add_legend(figure: Figure, steps: Sequence[Step]) -> None:
    """Explain colors and marks, in two rows below the pictures."""
    seen = {step.behavior for step in steps}
    behaviors = [
        Line2D([], [], color=color, linewidth=LOCATED_WIDTH, label=behavior.value)
        for behavior, color in COLORS.items()
        if behavior in seen
    ]
    marks = [
        Line2D([], [], color=style.GRAY, linewidth=LOCATED_WIDTH, label="located"),
        Line2D([], [], color=style.GRAY, linewidth=LOST_WIDTH, label="lost"),
        mark("x", style.ACCENT, 4.5, "best guess while lost", alpha=0.5),
        mark("o", "white", 7.0, "start, or first located", markeredgecolor=style.TRAIL, markeredgewidth=2.0),
        mark(">", style.ACCENT, 8.0, "end"),
        mark("*", style.GOAL, 12.0, "goal"),
    ]
    for handles, above in ((behaviors, 0.62), (marks, 0.36)):
        figure.legend(
            handles=handles, loc="upper left", ncols=len(handles), frameon=False, fontsize=style.SMALL,
            bbox_to_anchor=(0.3 / figure.get_figwidth(), above / figure.get_figheight()), borderaxespad=0.0,
            borderpad=0.0, columnspacing=1.6, handlelength=1.6,
        )  # fmt: skip


def mark(shape: str, color: str, size: float, label: str, **more: Any) -> Line2D:  # noqa: ANN401  # as given
    """Return a mark for the legend."""
    return Line2D([], [], marker=shape, linestyle="none", color=color, markersize=size, label=label, **more)
