"""The drawing that most commands begin with: its argument, its options, and how it is opened."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pilotage.cli.places import finite_numbers
from pilotage.cli.terminal import say

if TYPE_CHECKING:
    from pilotage.findings import Finding
    from pilotage.io.hints import DrawingHints
    from pilotage.io.maps import Drawing
    from pilotage.maps import CellGraph, DecompositionSettings, SchematicMap

SHADINGS = ("recognized", "light-is-free", "dark-is-free", "lines")

Map = Annotated[
    Path,
    typer.Argument(
        metavar="MAP",
        help="A drawing: SVG, PDF, DXF, draw.io, Excalidraw, an indoor map, a picture or a ROS map (YAML).",
    ),
]
Layers = Annotated[
    list[str] | None,
    typer.Option(
        "--layer",
        metavar="NAME=ROLE",
        help="What the marks of a layer, class, id, block or color ('#ff0000') are: wall, door, window, "
        "stairs, floor, furniture, keep-out, slow, one-way, label, start, goal or ignore; repeat for more.",
        show_default="guessed",
    ),
]
Labels = Annotated[
    list[str] | None,
    typer.Option(
        "--label",
        metavar="NAME=X,Y",
        help="The name of the room at a point of the drawing, instead of what is written there; "
        "repeat for more.",
        show_default="as written in the drawing",
    ),
]
Page = Annotated[
    str | None,
    typer.Option(metavar="PAGE", help="A page or level of a file with several.", show_default="the first"),
]
Shade = Annotated[
    str,
    typer.Option(
        "--shading",
        metavar="|".join(SHADINGS),
        help="Of a picture: whether light or dark is free space, or it shows lines of a pen.",
    ),
]


def open_drawing(
    drawing: Path, layers: list[str] | None, labels: list[str] | None, page: str | None, shading: str
) -> "Drawing":
    """Open a drawing with what the command line says about it; what was assumed is told in one line."""
    hints = read_options(layers, labels, page, shading)
    from pilotage.io.maps import open_drawing as read

    opened = read(drawing, hints)
    if opened.remarks:
        say(f"pilotage: {drawing.name}: {'; '.join(opened.remarks)}")
    return opened


def read_options(
    layers: list[str] | None, labels: list[str] | None, page: str | None, shading: str
) -> "DrawingHints":
    """Read the options of a drawing."""
    from pilotage.io.hints import DrawingHints, role_of, shading_of

    roles, points = {}, []
    for words in layers or []:
        name, equals, role = words.rpartition("=")
        if not (name and equals):
            raise typer.BadParameter(f"must be NAME=ROLE, got {words!r}", param_hint="--layer")
        try:
            roles[name] = role_of(name, role)
        except ValueError as error:
            raise typer.BadParameter(str(error), param_hint="--layer") from error
    for words in labels or []:
        name, equals, where = words.rpartition("=")
        numbers = finite_numbers(where)
        if not (name and equals and len(numbers) == 2):
            raise typer.BadParameter(f"must be NAME=X,Y, got {words!r}", param_hint="--label")
        points.append((name, (numbers[0], numbers[1])))
    try:
        return DrawingHints(roles, tuple(points), page, shading_of(shading))
    except ValueError as error:
        raise typer.BadParameter(str(error), param_hint="--shading") from error


def tell_worst(drawing: Path, findings: "tuple[Finding, ...]") -> None:
    """Say the worst of what looks wrong with a drawing in one line; nothing if there are but notes."""
    from pilotage.findings import worst

    found = worst(findings)
    if found is not None:
        others = len(findings) - 1
        more = f", and of {others} other finding{'s' if others > 1 else ''}" if others else ""
        say(f"pilotage: {drawing.name}: {found} (`pilotage check {drawing.name}` tells more of it{more})")


def findings_of(sketch: "SchematicMap", settings: Path | None) -> "tuple[Finding, ...]":
    """Find what looks wrong with a drawing, divided as the settings say."""
    from pilotage.findings import check

    return check(sketch, division_in(settings))


def division_in(settings: Path | None) -> "DecompositionSettings":
    """Read from a file of settings how drawings are divided into cells; None: as by default."""
    from pilotage.config import read_settings

    return read_settings(settings).localizer.atlas.decomposition


def neighbors_of(cell_id: str, graph: "CellGraph") -> list[str]:
    """List the ids of the cells that gateways join to a cell, each once, in order."""
    return sorted({neighbor.cell_id for neighbor in graph.neighbors(cell_id)})
