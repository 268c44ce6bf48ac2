"""What all figures share: ink, paper, and a pen that needs no screen."""

import logging
import math
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import Colormap, LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.text import Text

from pilotage.figures.formats import format_of
from pilotage.geometry import Array, Pose2
from pilotage.io.files import replacing

INK = "#20262e"
GRAY = "#8b939e"
PALE = "#e6e9ed"
TRAIL = "#1f6f8b"
ACCENT = "#d1495b"
GOAL = "#e0a100"
GATEWAY = "#4f9d69"
DOOR = "#8c4a2f"
PERSON = "#7b6ca8"
GLASS = "#7cc4dc"

CONFIDENCE: Colormap = LinearSegmentedColormap.from_list("confidence", ["#f2b134", "#5fa777", "#12587a"])
"""From doubt to certainty."""
RELEVANCE: Colormap = LinearSegmentedColormap.from_list(
    "relevance", ["#f6d9a8", "#e07a3f", "#8c2d2d", "#2b0f1e"]
)
"""Darker is more relevant, as in the paper."""

ARROW = np.array([[0.6, 0.0], [-0.4, 0.36], [-0.2, 0.0], [-0.4, -0.36]])
"""From tip to wing to tail to wing, forward along x."""

FONTS = (
    "DejaVu Sans", "Noto Sans CJK SC", "Noto Sans CJK JP", "Noto Sans CJK KR", "Microsoft YaHei", "Yu Gothic",
    "Malgun Gothic", "PingFang SC", "Hiragino Sans", "Apple SD Gothic Neo", "WenQuanYi Zen Hei",
    "WenQuanYi Micro Hei", "Noto Sans Devanagari", "Nirmala UI", "Noto Sans Thai", "Arial Unicode MS",
)  # fmt: skip
"""Fonts that systems bring with them: what the first cannot show, the next may."""

DPI = 160
MOST_EXTREME = 8.0  # of the proportions of a picture
SMALL, TEXT, TITLE = 8.5, 10.0, 12.0  # [points]


def new_figure(width: float, height: float) -> Figure:
    """Open a sheet of paper [inches]."""
    figure = Figure(figsize=(width, height), facecolor="white")
    FigureCanvasAgg(figure)
    return figure


def place(figure: Figure, left: float, bottom: float, width: float, height: float) -> Axes:
    """Open axes at a place on the sheet, counted from its lower left corner [inches]."""
    page_width, page_height = figure.get_size_inches()
    return figure.add_axes(
        (left / page_width, bottom / page_height, width / page_width, height / page_height)
    )


def bare(axes: Axes, title: str = "") -> None:
    """Take away all that is not the picture, and keep its proportions."""
    axes.set_aspect("equal")
    axes.set_xticks([])
    axes.set_yticks([])
    axes.spines[:].set_visible(False)
    if title:
        axes.set_title(title, fontsize=TITLE, color=INK, loc="left", pad=8, parse_math=False)


def frame(axes: Axes, low: Array, high: Array, margin: float = 0.04) -> None:
    """Show a box, given by two corners (2,), with some air around it."""
    air = margin * max(high - low)
    axes.set_xlim(low[0] - air, high[0] + air)
    axes.set_ylim(low[1] - air, high[1] + air)


def draw_robot(axes: Axes, pose: Pose2, size: float, color: str = ACCENT) -> None:
    """Draw the robot as an arrowhead that points where it looks."""
    outline = arrow(pose, size)
    axes.fill(*outline.T, facecolor=color, edgecolor="white", linewidth=1.0, joinstyle="round", zorder=11)


def draw_ring(axes: Axes, position: Array, label: str | None = None) -> None:
    """Draw where something begins, at (2,)."""
    axes.scatter(
        position[0],
        position[1],
        s=64.0,
        facecolor="white",
        edgecolor=TRAIL,
        linewidths=2.0,
        zorder=10.5,
        label=label,
    )


def arrow(pose: Pose2, size: float) -> Array:
    """Return the outline of an arrowhead, (4, 2); size [units of the pose's frame] from tail to tip."""
    return pose @ (size * ARROW)


def draw_scale_bar(axes: Axes, length: float, text: str) -> None:
    """Draw a bar of this length [axes' units] under the lower left corner."""
    left, _ = axes.get_xlim()
    bar = axes.plot([left, left + length], [-0.03, -0.03], color=INK, linewidth=2.0, solid_capstyle="butt")[0]
    bar.set_transform(axes.get_xaxis_transform())
    bar.set_clip_on(False)
    axes.annotate(
        text, (left + length, -0.03), (6, 0), xycoords=axes.get_xaxis_transform(), textcoords="offset points",
        va="center", fontsize=SMALL, color=INK, annotation_clip=False,
    )  # fmt: skip


def proportion(width: float, height: float) -> float:
    """Return height over width, but none so extreme that no sheet would hold it.

    >>> proportion(2.0, 1.0), proportion(0.0, 1.0)
    (0.5, 8.0)
    """
    return min(max(height, width / MOST_EXTREME) / max(width, height / MOST_EXTREME), MOST_EXTREME)


def round_length(length: float) -> float:
    """Round down to 1, 2 or 5 times a power of ten.

    >>> round_length(0.37), round_length(7.9)
    (0.2, 5.0)
    """
    power = 10.0 ** math.floor(math.log10(length))
    return power * next(step for step in (5.0, 2.0, 1.0) if step * power <= length)


def show_literally(text: Text) -> None:
    """Replace what no font can show, such as bytes of a file's name; other scripts may use all fonts."""
    words = text.get_text().encode(errors="replace").decode()
    text.set_text(words)
    if not words.isascii():
        text.set_fontfamily(installed_fonts())


def show_all_literally(figure: Figure) -> None:
    """Replace in all texts of a figure what no font can show."""
    for text in figure.findobj(Text):
        assert isinstance(text, Text)
        show_literally(text)


@contextmanager
def missing_glyphs_ignored() -> Iterator[None]:
    """Draw without a warning for each letter of a script that no installed font has."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph .* missing")
        yield


@lru_cache(maxsize=1)
def installed_fonts() -> list[str]:
    """List the fonts that this system has, the usual one first."""
    from matplotlib.font_manager import fontManager

    logging.getLogger("matplotlib.font_manager").setLevel(logging.ERROR)  # it tells of weights it has not
    installed = set(fontManager.get_font_names())
    return [font for font in FONTS if font in installed]


def save(figure: Figure, path: Path | str) -> None:
    """Write a figure whole or not at all; the name's ending tells the format (png, svg, pdf)."""
    kind = format_of(path)
    show_all_literally(figure)
    with replacing(path) as beside, missing_glyphs_ignored():
        figure.savefig(beside, format=kind, dpi=DPI)
