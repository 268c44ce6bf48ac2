"""What was understood of a drawing, with the findings where they are."""

import textwrap
from collections import Counter

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pilotage.figures import style
from pilotage.figures.cells import (
    PAGE_TALLEST,
    PAGE_WIDTH,
    POINTS_A_INCH,
    draw_cells,
    draw_gateways,
    draw_names,
)
from pilotage.figures.drawing import draw_strokes
from pilotage.findings import Finding, MendKind, Report, Severity
from pilotage.geometry import Array
from pilotage.interpretation import Interpretation, Role

SEVERITY_COLOR = {
    Severity.ERROR: style.ACCENT,
    Severity.WARNING: style.GOAL,
    Severity.NOTE: style.TRAIL,
}
ROLE_COLOR = {
    Role.DOOR: style.DOOR,
    Role.WINDOW: style.GLASS,
    Role.STAIRS: style.PERSON,
    Role.FURNITURE: style.GATEWAY,
    Role.KEEP_OUT: style.ACCENT,
    Role.SLOW: style.GOAL,
    Role.ONE_WAY: style.TRAIL,
    Role.IGNORE: style.GRAY,
}
"""Marks of other roles are seen in the walls, the names and the cells."""

LISTED, OF_A_KIND = 12, 3
"""Findings that are listed below the picture, and those of a kind."""

BESIDE_NAME = 18.0
"""How far above the middle of a room its finding stands [points]: the name stays readable."""

LINE_INCHES, LETTERS_AN_INCH = 0.17, 15.0


def check_figure(report: Report, *, title: str = "") -> Figure:
    """Draw cells, doors, walls and other marks by what they mean, and findings as numbered dots."""
    left, bottom, right, top = report.sketch.bounds
    aspect = style.proportion(right - left, top - bottom)
    width = min(PAGE_WIDTH, PAGE_TALLEST / aspect)
    lines = list_of(report.findings, width)
    below = 0.55 + LINE_INCHES * len(lines)
    figure = style.new_figure(width + 0.6, width * aspect + below + 0.6)
    axes = style.place(figure, 0.3, below, width, width * aspect)
    if report.interpretation is not None:
        draw_marks(axes, report.interpretation)
    draw_strokes(axes, report.sketch.strokes, linewidth=1.5)
    if report.graph is not None:
        draw_cells(axes, report.graph, set())
        draw_gateways(axes, report.graph)
        draw_names(axes, report.graph, width / (right - left or 1.0) * POINTS_A_INCH, None)
    draw_findings(axes, report)
    style.frame(axes, np.array([left, bottom]), np.array([right, top]), margin=0.02)
    style.bare(axes, title)
    if axes.get_legend_handles_labels()[0]:
        axes.legend(
            loc="upper left", bbox_to_anchor=(0.0, -0.01), ncols=6, frameon=False, fontsize=style.SMALL,
            borderaxespad=0.0,
        )  # fmt: skip
    for number, (line, severity) in enumerate(lines):
        figure.text(
            0.3 / (width + 0.6), (below - 0.45 - LINE_INCHES * number) / (width * aspect + below + 0.6), line,
            fontsize=style.SMALL, color=style.INK if severity is Severity.NOTE else SEVERITY_COLOR[severity],
            va="center", parse_math=False,
        )  # fmt: skip
    return figure


def list_of(findings: tuple[Finding, ...], width: float) -> list[tuple[str, Severity]]:
    """Write the findings in lines, each with its number, for a width [inches]."""
    lines, told = [], Counter[str]()
    for number, finding in enumerate(findings, start=1):
        if told[finding.kind] == OF_A_KIND or told.total() == LISTED:
            continue
        told[finding.kind] += 1
        text = f"{number}  {finding.severity.value}: {finding.text}; {finding.advice}"
        wrapped = textwrap.wrap(text, int(width * LETTERS_AN_INCH), subsequent_indent="    ")
        lines += [(line, finding.severity) for line in wrapped]
    if len(findings) > told.total():
        lines.append(
            (f"and {len(findings) - told.total()} more: `pilotage check --all` lists them", Severity.NOTE)
        )
    return lines


def draw_marks(axes: Axes, interpretation: Interpretation) -> None:
    """Draw the marks that are neither wall nor floor, in a color for each role."""
    seen: set[Role] = set()
    for mark, meaning in zip(interpretation.sheet.marks, interpretation.meanings, strict=True):
        if meaning.role not in ROLE_COLOR:
            continue
        for outline in mark.outlines:
            axes.plot(
                *outline.ring.T, color=ROLE_COLOR[meaning.role], linewidth=0.9, zorder=6,
                label=None if meaning.role in seen else meaning.role.value,
            )  # fmt: skip
            seen.add(meaning.role)
            if meaning.role is Role.ONE_WAY:
                draw_tip(axes, outline.vertices)


def draw_tip(axes: Axes, way: Array) -> None:
    """Draw the tip of an arrow along points (n, 2), at its last one."""
    look = {"arrowstyle": "-|>", "color": ROLE_COLOR[Role.ONE_WAY], "mutation_scale": 14.0}
    axes.annotate("", way[-1], way[-2], arrowprops=look, zorder=9)


def draw_findings(axes: Axes, report: Report) -> None:
    """Draw a numbered dot at each finding, and what a pen would do as a line of dots."""
    for number, finding in enumerate(report.findings, start=1):
        color = SEVERITY_COLOR[finding.severity]
        if finding.mend is not None:
            segment = report.sketch.sketch_from_file(np.array(finding.mend.segment))
            dashes = (0, (1.0, 1.0)) if finding.mend.kind is MendKind.CUT else "solid"
            axes.plot(*segment.T, color=color, linewidth=3.0, linestyle=dashes, zorder=13)
        if finding.where is not None:
            x, y = report.sketch.sketch_from_file(np.array([finding.where]))[0].tolist()
            axes.annotate(
                str(number), (x, y), (0.0, BESIDE_NAME if finding.cell_ids else 0.0),
                textcoords="offset points", fontsize=style.SMALL, color="white", ha="center", va="center",
                zorder=15, bbox={"boxstyle": "circle,pad=0.25", "facecolor": color, "edgecolor": "white"},
            )  # fmt: skip
