"""`pilotage check`: what the program understands of a drawing, and what looks wrong with it."""

import json
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pilotage.cli.drawing import Labels, Layers, Map, Page, Shade, division_in, neighbors_of, open_drawing
from pilotage.cli.exits import FAILURE
from pilotage.cli.options import Force, GoalPlace, SettingsFile, StartPlace
from pilotage.cli.places import find_place
from pilotage.cli.terminal import check_outputs, say

if TYPE_CHECKING:
    from pilotage.findings import Finding, Report
    from pilotage.maps import CellGraph, SchematicMap


OF_A_KIND = 3
"""Findings of a kind that are listed; --all and --json list all."""

MOST_NAMES = 8
"""So many names and colors of walls are listed, most marks first; what one mark has, or all, is no layer."""


def check(
    drawing: Map,
    *,
    start: StartPlace = None,
    goal: GoalPlace = None,
    figure: Annotated[
        Path | None, typer.Option(help="Where to draw what was understood (.png, .svg, .pdf).")
    ] = None,
    every: Annotated[
        bool, typer.Option("--all", help=f"List all findings, not only {OF_A_KIND} of a kind.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print all of it as JSON.")] = False,
    layer: Layers = None,
    label: Labels = None,
    page: Page = None,
    shading: Shade = "recognized",
    settings: SettingsFile = None,
    force: Force = False,
) -> None:
    """Tell what is understood of a drawing, and what looks wrong with it.

    Rooms and their names, doors, and what the marks were taken for; then findings: where, why, what to do. An
    *error* means that the drawing, its start or its goal cannot be used, and the exit status is 1; a
    *warning* that something is probably not what you meant; a *note* is worth knowing. The number before a
    finding is the one in the picture of --figure.

    Points are in the drawing's own units and axes (in SVG and in pictures y points down).

    **Examples:**

    - `pilotage check office.svg --figure check.png`
    - `pilotage check plan.dxf --layer A-FURN=ignore --goal kitchen`
    - `pilotage check photo.jpg --label kitchen=120,80 --json`
    """
    check_outputs((), figure=figure, force=force)
    from pilotage.findings import Severity, report

    division = division_in(settings)
    opened = open_drawing(drawing, layer, label, page, shading)
    found = report(opened.sketch, opened.interpretation, settings=division)
    found = with_ends(found, start, goal)
    if as_json:
        typer.echo(json.dumps({"file": str(drawing), **json_of(found, opened.remarks)}, indent=1))
    else:
        typer.echo(describe(drawing.name, found, every=every))
    if figure is not None:
        from pilotage.figures.check import check_figure
        from pilotage.figures.style import save

        save(check_figure(found, title=f"What is understood of {drawing.name}"), figure)
        say(f"drawn in {figure}")
    if any(finding.severity is Severity.ERROR for finding in found.findings):
        raise typer.Exit(FAILURE)


def with_ends(found: "Report", start: str | None, goal: str | None) -> "Report":
    """Check the start and goal that were asked for instead of those that are marked."""
    if found.graph is None or (start is None and goal is None):
        return found
    from pilotage.findings import for_ends
    from pilotage.maps import RouteError

    ends, problems = {}, {}
    for what, words in (("start", start), ("goal", goal)):
        try:
            ends[what] = None if words is None else find_place(words, found.sketch, found.graph)
        except RouteError as error:
            problems[what] = str(error)
    return for_ends(found, ends.get("start"), ends.get("goal"), problems)


def describe(name: str, found: "Report", *, every: bool) -> str:
    """Write what was understood, then every finding or a few of each kind."""
    lines = [f"{name}: {counted(found)}"]
    if found.graph is not None:
        for cell in found.graph.cells:
            words = f" {cell.label!r}" if cell.label else ""
            beside = ", ".join(neighbors_of(cell.cell_id, found.graph)) or "no door"
            lines.append(f"  {cell.cell_id}{words}: {beside}")
    lines += [f"  {line}" for line in marks_in_words(found)]
    lines += listed(found.findings, every=every) or ["nothing looks wrong"]
    return "\n".join(lines)


def listed(findings: "tuple[Finding, ...]", *, every: bool) -> list[str]:
    """List findings with the numbers that they have in the picture.

    If not every one is wanted, a few of each kind are listed before the others are counted.
    """
    lines, told = [], Counter[str]()
    count = Counter(finding.kind for finding in findings)
    for number, finding in enumerate(findings, start=1):
        told[finding.kind] += 1
        if every or told[finding.kind] <= OF_A_KIND:
            lines.append(f"{number}  {finding}")
        elif told[finding.kind] == OF_A_KIND + 1:
            more = count[finding.kind] - OF_A_KIND
            lines.append(
                f"{finding.severity.value}: {more} more of this kind ({finding.kind}), listed by --all"
            )
    return lines


def counted(found: "Report") -> str:
    """Count rooms, doors and names."""
    if found.graph is None:
        return "no room"
    rooms, doors = len(found.graph.cells), len(found.graph.gateways)
    named = sum(bool(cell.label) for cell in found.graph.cells)
    return f"{rooms} room{'s' * (rooms != 1)} ({named} with a name), {doors} door{'s' * (doors != 1)}"


def marks_in_words(found: "Report") -> list[str]:
    """Say what the marks were taken for and why, the most frequent first."""
    if found.interpretation is None:
        return []
    from pilotage.interpretation import Role
    from pilotage.interpretation.names import colors_of

    meanings = found.interpretation.meanings
    lines = []
    for role, count in Counter(meaning.role for meaning in meanings).most_common():
        reasons = Counter(meaning.reason for meaning in meanings if meaning.role is role)
        told = ", ".join(f"{reason} ({number})" for reason, number in reasons.most_common(3))
        lines.append(f"{count} mark{'s' * (count != 1)} {role.value}: {told}")
    pairs = zip(found.interpretation.sheet.marks, meanings, strict=True)
    walls = [mark for mark, meaning in pairs if meaning.role is Role.WALL]
    for what, names_of in (("name", lambda mark: mark.names), ("color", colors_of)):
        names = Counter(name for mark in walls for name in dict.fromkeys(names_of(mark)))
        telling = [(name, count) for name, count in names.most_common() if 1 < count < len(walls)]
        if telling:
            common = ", ".join(f"{name!r} ({count})" for name, count in telling[:MOST_NAMES])
            lines.append(f"walls by {what}, for --layer: {common}")
    return lines


def json_of(found: "Report", remarks: tuple[str, ...]) -> dict[str, object]:
    """Write what was understood as nested dictionaries, points in the axes of the file."""
    roles: Counter[str] = Counter()
    if found.interpretation is not None:
        roles.update(meaning.role.value for meaning in found.interpretation.meanings)
    return {
        **json_of_graph(found.graph, found.sketch),
        "marks": dict(roles),
        "assumed": list(remarks),
        "findings": [finding.as_json for finding in found.findings],
    }


def json_of_graph(graph: "CellGraph | None", sketch: "SchematicMap") -> dict[str, object]:
    """Write cells and gateways, none without a graph; points in the axes of the file."""
    if graph is None:
        return {"cells": [], "gateways": []}
    cells = [
        {
            "id": cell.cell_id,
            "label": cell.label,
            "size": cell.size.value,
            "center": points(sketch, [cell.center])[0],
            "neighbors": neighbors_of(cell.cell_id, graph),
        }
        for cell in graph.cells
    ]
    gateways = [
        {
            "id": gateway.gateway_id,
            "cells": list(gateway.cell_ids),
            "segment": points(sketch, gateway.segment.tolist()),
        }
        for gateway in graph.gateways
    ]
    return {"cells": cells, "gateways": gateways}


def points(sketch: "SchematicMap", places: list[tuple[float, float]]) -> list[list[float]]:
    """Carry points to the axes of the file."""
    import numpy as np

    carried: list[list[float]] = sketch.file_from_sketch(np.array(places, dtype=np.float64)).tolist()
    return carried
