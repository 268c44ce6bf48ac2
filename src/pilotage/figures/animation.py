"""A drive as an animation: what the robot believes beside what is true."""

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray
from PIL import Image

from pilotage.drives import Drive
from pilotage.figures import style
from pilotage.figures.drawing import draw_labels, draw_strokes
from pilotage.figures.drive import draw_goal
from pilotage.figures.views import BelievedView, TrueView
from pilotage.figures.words import clock, describe
from pilotage.figures.world import draw_world
from pilotage.geometry import Array
from pilotage.io.files import replacing

PANEL_WIDTH, TALLEST = 4.6, 4.4  # [inches]
HEAD, FOOT, MARGIN = 0.34, 0.42, 0.12  # [inches]
DPI = 120
MOST_FRAMES = 200
LEAST_STEP = 0.5  # [s] of the simulation from frame to frame
FRAME_TIME, LAST_FRAME_TIME = 100, 3000  # [ms] a frame is shown
FREQUENT, RARE = 48, 80
"""Colors of the palette that are the most frequent ones, and those that all others share."""


def animate(drive: Drive, path: Path | str) -> None:
    """Write a drive as an animated GIF, whole or not at all: no more than 200 frames, ten a second.

    On the left the drawing with all places held possible, the scan as it would lie there, the cell, the next
    gateway and the route; on the right the world.
    """
    frames = [Image.fromarray(frame) for frame in render(drive, chosen_frames(drive.times))]
    palette = common_palette(frames)
    first, *others = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    durations = [FRAME_TIME] * len(others) + [LAST_FRAME_TIME]
    with replacing(path) as beside:
        first.save(beside, format="GIF", save_all=True, append_images=others, duration=durations, loop=0)


def chosen_frames(times: Array) -> list[int]:
    """Choose which steps, taken at times (n,) [s], become frames: the first, the last, and evenly between."""
    gap = max(LEAST_STEP, times[-1] / (MOST_FRAMES - 2))
    wanted = np.arange(0.0, times[-1], gap)
    return sorted({*np.searchsorted(times, wanted - 1e-9).tolist(), len(times) - 1})


def common_palette(frames: Sequence[Image.Image]) -> Image.Image:
    """Find colors for all frames; rare ones count for more than their area: the robot is small."""
    shown = np.vstack([np.asarray(frame).reshape(-1, 3) for frame in frames[:: max(1, len(frames) // 8)]])
    codes, counts = np.unique(shown @ np.array([65536, 256, 1], dtype=np.uint32), return_counts=True)
    order = np.argsort(-counts, kind="stable")
    colors = np.stack([codes >> 16, codes >> 8 & 255, codes & 255], axis=1).astype(np.uint8)[order]
    others = np.repeat(colors, np.ceil(np.sqrt(counts[order])).astype(np.intp), axis=0)
    blended = Image.fromarray(others[np.newaxis]).quantize(RARE, method=Image.Quantize.MEDIANCUT)
    palette = Image.new("P", (1, 1))
    palette.putpalette([*colors[:FREQUENT].ravel().tolist(), *(blended.getpalette() or [])[: 3 * RARE]])
    return palette


def render(drive: Drive, chosen: Sequence[int]) -> Iterator[NDArray[np.uint8]]:
    """Draw what stays once, and on it, frame by frame, what moves; yields (height, width, 3) of 0..255."""
    figure, left, right = open_stage(drive)
    canvas = FigureCanvasAgg(figure)
    believed, true = BelievedView(left, drive), TrueView(right, drive)
    caption = figure.text(
        MARGIN / figure.get_figwidth(), 0.14 / figure.get_figheight(), "", fontsize=9.0, color=style.INK,
        animated=True, parse_math=False,
    )  # fmt: skip
    style.show_all_literally(figure)
    with style.missing_glyphs_ignored():
        canvas.draw()
    background = canvas.copy_from_bbox(figure.bbox)
    for k in chosen:
        believed.show(k)
        true.show(k)
        canvas.restore_region(background)
        for artist in (*believed.artists, *true.artists):
            figure.draw_artist(artist)
        caption.set_text(caption_of(drive, k))
        style.show_literally(caption)
        with style.missing_glyphs_ignored():
            figure.draw_artist(caption)
        yield np.asarray(canvas.buffer_rgba())[..., :3].copy()


def open_stage(drive: Drive) -> tuple[Figure, Axes, Axes]:
    """Lay out both pictures and draw all that never moves."""
    aspects = [style.proportion(*(high - low)) for low, high in drive.boxes]
    width = min(PANEL_WIDTH, TALLEST / max(aspects))
    height = width * max(aspects)
    figure = style.new_figure(2.0 * width + 3.0 * MARGIN, height + HEAD + FOOT)
    figure.set_dpi(DPI)
    left, right = (style.place(figure, x, FOOT, width, height) for x in (MARGIN, width + 2.0 * MARGIN))
    for page, box, words in zip(
        (left, right), drive.boxes, ("What it believes", "What is true"), strict=True
    ):
        style.frame(page, *box, margin=0.02)
        style.bare(page)
        page.set_anchor("NW")
        page.set_title(words, fontsize=style.TEXT, color=style.INK, loc="left", pad=5)
    draw_strokes(left, drive.sketch.strokes, linewidth=1.5)
    draw_labels(left, drive.sketch)
    for point in drive.goal_points.tolist():
        draw_goal(left, point)
    draw_world(right, drive.world, linewidth=1.1)
    if drive.true_goal is not None:
        draw_goal(right, drive.true_goal)
    return figure, left, right


def caption_of(drive: Drive, k: int) -> str:
    """Say in a line what happens at a step."""
    step, seconds = drive.steps[k], drive.times[k]
    if step.outcome is None:
        return describe(step, seconds, drive.graph)
    return f"{clock(seconds)}   {step.outcome.value}: {step.reason}"
