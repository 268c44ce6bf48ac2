"""`pilotage cells`: the rooms of a drawing, the doors between them, and a route."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pilotage.cli.drawing import Labels, Layers, Map, Page, Shade, neighbors_of, open_drawing, tell_worst
from pilotage.cli.options import Force, GoalPlace, SettingsFile, StartPlace
from pilotage.cli.places import find_place
from pilotage.cli.terminal import check_outputs, say

if TYPE_CHECKING:
    from pilotage.maps import CellGraph, Route, RouteSettings, SchematicMap


def cells(
    drawing: Map,
    *,
    start: StartPlace = None,
    goal: GoalPlace = None,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", help="Where to write cells, gateways and route (GeoJSON)."),
    ] = None,
    figure: Annotated[Path | None, typer.Option(help="Where to draw them (.png, .svg, .pdf).")] = None,
    layer: Layers = None,
    label: Labels = None,
    page: Page = None,
    shading: Shade = "recognized",
    settings: SettingsFile = None,
    force: Force = False,
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
    - `pilotage cells office.svg --start 100,180 --goal kitchen --figure route.png -o cells.geojson`
    - `pilotage cells scan.png --shading light-is-free`
    """
    check_outputs([output], figure=figure, force=force)
    from pilotage.config import read_settings
    from pilotage.errors import FileError
    from pilotage.findings import report

    chosen = read_settings(settings)
    division, routing = chosen.localizer.atlas.decomposition, chosen.navigator.route
    opened = open_drawing(drawing, layer, label, page, shading)
    sketch = opened.sketch
    found = report(sketch, opened.interpretation, settings=division)
    graph = found.graph
    if graph is None:
        raise FileError(found.findings[0].text, drawing)
    route = plan(sketch, graph, start, goal, routing)
    tell_worst(drawing, found.findings)
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
    return find_route(graph, ends[0], ends[1], settings, zones=sketch.zones)


def describe(graph: "CellGraph") -> str:
    """List the cells, each with its size, label and neighbors."""
    lines = [f"{len(graph.cells)} cells, {len(graph.gateways)} gateways"]
    for cell in graph.cells:
        neighbors = neighbors_of(cell.cell_id, graph)
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
