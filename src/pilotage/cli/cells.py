"""`pilotage cells`: the rooms of a drawing, the doors between them, and a route."""

from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pilotage.cli.places import find_place
from pilotage.cli.terminal import check_outputs, say

if TYPE_CHECKING:
    from pilotage.maps import CellGraph, Route, RouteSettings, SchematicMap


class Shading(Enum):
    """What a picture means by its shades, as a user names it."""

    RECOGNIZED = "recognized"
    LIGHT_IS_FREE = "light-is-free"
    DARK_IS_FREE = "dark-is-free"
    LINES = "lines"


def cells(
    drawing: Annotated[
        Path,
        typer.Argument(metavar="MAP", help="A drawing: SVG, a picture (PNG, JPEG, PGM) or a ROS map (YAML)."),
    ],
    *,
    start: Annotated[
        str | None,
        typer.Option(
            metavar="X,Y|LABEL", help="Where a route begins.", show_default="as marked in the drawing"
        ),
    ] = None,
    goal: Annotated[
        str | None,
        typer.Option(metavar="X,Y|LABEL", help="Where it ends.", show_default="as marked in the drawing"),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", help="Where to write cells, gateways and route (GeoJSON)."),
    ] = None,
    figure: Annotated[Path | None, typer.Option(help="Where to draw them (.png, .svg, .pdf).")] = None,
    shading: Annotated[
        Shading,
        typer.Option(help="Of a picture: whether light or dark is free space, or it shows lines of a pen."),
    ] = Shading.RECOGNIZED,
    settings: Annotated[Path | None, typer.Option(help="Settings to change (TOML).")] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace files that are there.")] = False,
) -> None:
    """Divide a drawing into rooms, halls and corridors, and find a route through them.

    A **cell** is a place that a person would name; a **gateway** is where one goes from one to the next: a
    door, a narrowing, the mouth of a corridor. The drawing needs no scale, its walls may be single strokes,
    and small gaps at corners are mended.

    Points are in the drawing's own units and axes (in SVG and in pictures y points down); a label is a word
    written in the drawing. The cost of a route is its length as a share of the drawing's diameter, and a
    little more for each gateway.

    **Examples:**

    - `pilotage cells office.svg --figure cells.png`
    - `pilotage cells office.svg --start 120,80 --goal kitchen --figure route.png -o cells.geojson`
    - `pilotage cells scan.png --shading light-is-free`
    """
    check_outputs([output, figure], force=force)
    from pilotage.errors import FileError
    from pilotage.maps import DecompositionSettings, NotEnclosedError, RouteSettings, decompose

    division, routing = DecompositionSettings(), RouteSettings()
    if settings is not None:
        from pilotage.config import read_settings

        chosen = read_settings(settings)
        division, routing = chosen.localizer.atlas.decomposition, chosen.navigator.route
    sketch = read_drawing(drawing, shading)
    try:
        graph = decompose(sketch, division)
    except NotEnclosedError as error:
        raise FileError(str(error), drawing) from error
    route = plan(sketch, graph, start, goal, routing)
    typer.echo(describe(graph) if route is None else describe_route(graph, route))
    if output is not None:
        from pilotage.io.geojson import write_cells

        write_cells(output, sketch, graph, route)
        say(f"written to {output}")
    if figure is not None:
        from pilotage.figures.cells import cells_figure
        from pilotage.figures.style import save

        save(cells_figure(sketch, graph, route=route, title=f"Cells of {drawing.name}"), figure)
        say(f"drawn in {figure}")


def read_drawing(drawing: Path, shading: Shading) -> "SchematicMap":
    """Open a drawing; a picture in the way that was asked for."""
    from pilotage.io import open_map

    if shading is Shading.RECOGNIZED:
        return open_map(drawing)
    from pilotage.io.raster import SUFFIXES, PictureKind, read_raster

    if drawing.suffix.lower() not in SUFFIXES:
        raise typer.BadParameter(f"only pictures have a shading, not {drawing.name}", param_hint="--shading")
    return read_raster(drawing, PictureKind[shading.name])


def plan(
    sketch: "SchematicMap", graph: "CellGraph", start: str | None, goal: str | None, settings: "RouteSettings"
) -> "Route | None":
    """Find the route that was asked for, if any was; what is not named is taken from the drawing."""
    if start is None and goal is None:
        return None
    from pilotage.maps import check_place, find_route

    ends = []
    for what, words, marked in (("start", start, sketch.start), ("goal", goal, sketch.goal)):
        if words is None and marked is None:
            raise typer.BadParameter(
                f"a route needs a {what}, the drawing marks none", param_hint=f"--{what}"
            )
        point = marked if words is None else find_place(words, sketch, graph)
        assert point is not None
        check_place(graph, point, what)
        ends.append(point)
    return find_route(graph, ends[0], ends[1], settings)


def describe(graph: "CellGraph") -> str:
    """List the cells, each with its size, label and neighbors."""
    lines = [f"{len(graph.cells)} cells, {len(graph.gateways)} gateways"]
    for cell in graph.cells:
        neighbors = sorted({neighbor.cell_id for neighbor in graph.neighbors(cell.cell_id)})
        beside = f"next to {', '.join(neighbors)}" if neighbors else "without a gateway"
        words = f" {cell.label!r}" if cell.label else ""
        lines.append(f"{cell.cell_id}{words}, {cell.size.value}, {beside}")
    return "\n".join(lines)


def describe_route(graph: "CellGraph", route: "Route") -> str:
    """List the cells of a route in order, and the gateways between them."""
    words = []
    for cell_id in route.cell_ids:
        label = graph.cell(cell_id).label
        words.append(f"{cell_id} {label!r}" if label else cell_id)
    steps = [words[0]]
    steps += [
        f"through {gateway} to {cell}" for gateway, cell in zip(route.gateway_ids, words[1:], strict=True)
    ]
    return ", ".join(steps) + f"\ncost {route.cost:.3f} of the drawing's diameter"
