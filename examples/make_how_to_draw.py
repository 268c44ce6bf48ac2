"""Make the pictures of docs/use/how-to-draw.md: right and wrong, each with what the program understands.

python examples/make_how_to_draw.py [FOLDER]
"""

import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pilotage.figures import style
from pilotage.figures.cells import draw_cells, draw_gateways
from pilotage.figures.style import save
from pilotage.findings import report
from pilotage.io.maps import open_drawing

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "docs" / "images" / "draw"
PANEL = (2.9, 1.95)  # [inches]
PEN = 'fill="none" stroke="black" stroke-width="2"'
FRAME = "M0 0 H300 V180 H0 Z"
GOOD = f'<path {PEN} d="{FRAME} M0 110 H60 M90 110 H210 M240 110 H300 M150 0 V110"/>'


@dataclass(frozen=True)
class Example:
    """One rule, drawn right and wrong."""

    name: str
    right: str  # the body of an SVG
    wrong: str
    words: tuple[str, str]  # below the right one, below the wrong one


def box(x: int, y: int, width: int, height: int, look: str = PEN) -> str:
    """Draw a rectangle."""
    return f'<rect x="{x}" y="{y}" width="{width}" height="{height}" {look}/>'


def moved(body: str, dx: int, dy: int) -> str:
    """Draw something elsewhere."""
    return f'<g transform="translate({dx} {dy})">{body}</g>'


THREE_BOXES = box(0, 0, 150, 110) + box(150, 0, 150, 110) + box(0, 110, 300, 70)
PATCHES = "".join(box(x, 105, 30, 10, 'fill="white"') for x in (60, 210))
DOOR = f'<path {PEN} d="M60 110 V80 A30 30 0 0 1 90 110"/><path {PEN} d="M210 110 V80 A30 30 0 0 1 240 110"/>'
THICK = (
    '<path fill="black" d="M0 0 H300 V180 H0 Z M8 8 V106 H60 V114 H8 V172 H292 V114 H240 V106 H292 V8 H154'
    ' V106 H210 V114 H90 V106 H146 V8 Z" fill-rule="evenodd"/>'
)
SHELVES = "".join(f"M{x} 15 H{x + 45} V50 H{x} Z " for x in (20, 85, 175, 235))
NAMES = '<text x="55" y="60" font-size="18">Lab</text><text x="195" y="60" font-size="18">Office</text>'

EXAMPLES = (
    Example(
        "1-door-is-a-gap",
        GOOD,
        f'<path {PEN} d="{FRAME} M0 110 H60 M90 110 H300 M150 0 V110"/>',
        ("a door is a gap in the wall", "a room without a gap has no door"),
    ),
    Example(
        "2-leaf-and-arc",
        GOOD + DOOR,
        f'<path {PEN} d="{FRAME} M0 110 H60 M90 110 H210 M240 110 H300 M150 0 V110'
        ' M60 110 L75 104 L90 110 M210 110 L225 104 L240 110"/>',
        ("a leaf and a quarter of a circle are a door, too", "other signs in the gap close it"),
    ),
    Example(
        "3-boxes",
        THREE_BOXES + PATCHES,
        THREE_BOXES,
        ("rooms as boxes: paint a white patch over each door", "boxes alone have no doors"),
    ),
    Example(
        "4-width",
        GOOD,
        f'<path {PEN} d="{FRAME} M0 110 H74 M77 110 H223 M226 110 H300 M150 0 V110"/>',
        ("draw doors as wide as they are", "a gap like a slip of the pen is closed"),
    ),
    Example(
        "5-outer-walls",
        f'<path {PEN} d="M0 180 V0 H300 V125 M300 155 V180 H0 M0 110 H60 M90 110 H210 M240 110 H300"/>'
        f'<path {PEN} d="M150 0 V110"/>',
        f'<path {PEN} d="M0 0 V180 M300 0 V180 M0 110 H60 M90 110 H210 M240 110 H300 M150 0 V110"/>',
        ("close the outer walls; a gap is a way out", "what is open to the outside is no room"),
    ),
    Example(
        "6-thick-walls",
        THICK,
        f'<path {PEN} d="{FRAME} M8 8 H292 V172 H8 Z M0 110 H60 M90 110 H210 M240 110 H300 M150 0 V110"/>',
        ("walls may be filled, the gap goes through", "single and double walls in one drawing may mislead"),
    ),
    Example(
        "7-furniture",
        GOOD + f'<g id="furniture"><path {PEN} d="{SHELVES}"/></g>',
        GOOD + f'<path {PEN} d="{SHELVES} M0 60 H130 M170 60 H300"/>',
        ("put furniture on a layer named 'furniture'", "else what divides a room may be a wall"),
    ),
    Example(
        "8-names",
        GOOD + NAMES,
        GOOD + moved(NAMES, 0, -75),
        ("write the name into the room, as text", "a name beside the building names nothing"),
    ),
    Example(
        "9-one-building",
        GOOD,
        GOOD + moved(GOOD, 380, 0),
        ("one floor a file", "two floors on a sheet are two buildings"),
    ),
    Example(
        "10-nothing-else",
        GOOD,
        GOOD + f'<path {PEN} d="M620 20 h80 M620 40 h80 M640 150 l30 20"/>',
        ("draw the building only", "strokes far away make it look small"),
    ),
)


def picture_of(example: Example) -> Figure:
    """Draw both sides of an example."""
    width, height = PANEL
    figure = style.new_figure(2 * width + 0.6, height + 0.75)
    for side, (body, words) in enumerate(zip((example.right, example.wrong), example.words, strict=True)):
        axes = style.place(figure, 0.2 + side * (width + 0.2), 0.55, width, height)
        draw_understood(axes, body)
        color, mark = ((style.GATEWAY, "right"), (style.ACCENT, "wrong"))[side]
        axes.set_title(mark, fontsize=style.TEXT, color=color, loc="left", pad=3)
        axes.annotate(
            words,
            (0.0, -0.03),
            xycoords="axes fraction",
            va="top",
            fontsize=style.SMALL - 0.5,
            color=style.INK,
        )
    return figure


def draw_understood(axes: Axes, body: str) -> None:
    """Draw the marks of an SVG, and above them the cells and gateways that are found in it."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "example.svg"
        path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-60 -60 820 300">{body}</svg>')
        drawing = open_drawing(path)
    found = report(drawing.sketch, drawing.interpretation)
    assert drawing.interpretation is not None
    sheet = drawing.interpretation.sheet
    if found.graph is not None:
        draw_cells(axes, found.graph, set())
        draw_gateways(axes, found.graph)
    corners = [np.array([(0.0, 0.0), (300.0, -180.0)])]
    for mark in sheet.marks:
        for outline in mark.outlines:
            corners.append(outline.vertices)
            if mark.pen is not None:
                axes.plot(*outline.ring.T, color=style.INK, linewidth=1.3, zorder=7)
            elif mark.fill is not None and sum(mark.fill) > 2.9:
                axes.fill(*outline.ring.T, color="white", zorder=7.5)
    for ring in drawing.sketch.solids:
        axes.plot(*ring.ring.T, color=style.INK, linewidth=1.0, zorder=7)
    for text in sheet.texts:
        axes.annotate(
            text.text,
            text.position,
            ha="center",
            va="center",
            fontsize=style.SMALL,
            color=style.INK,
            zorder=12,
        )
        corners.append(np.array([text.position]))
    points = np.vstack(corners)
    style.frame(axes, points.min(axis=0), points.max(axis=0), margin=0.03)
    style.bare(axes)


def main() -> None:
    """Write all pictures."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER
    for example in EXAMPLES:
        save(picture_of(example), folder / f"{example.name}.png")


if __name__ == "__main__":
    main()
