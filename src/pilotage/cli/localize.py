"""`pilotage localize`: where the robot is on the drawing, scan by scan."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pilotage.cli.correction import write_corrections
from pilotage.cli.drawing import Labels, Layers, Map, Page, Shade, findings_of, open_drawing, tell_worst
from pilotage.cli.exits import signals_held
from pilotage.cli.options import Force, Scale, Seed, SettingsFile, StartPose, check_positive
from pilotage.cli.places import parse_pose
from pilotage.cli.run import (
    LOG_HELP,
    OdometryTopic,
    ScanTopic,
    draw,
    estimates_sink,
    open_localizer,
    read_stretch,
    run,
)
from pilotage.cli.terminal import check_outputs, keeping, say

if TYPE_CHECKING:
    from pilotage.correction import Sighting


def localize(
    drawing: Map,
    log: Annotated[Path, typer.Argument(metavar="LOG", help=LOG_HELP)],
    *,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", help="Where to write the estimates; without it, to standard output."),
    ] = None,
    figure: Annotated[
        Path | None, typer.Option(help="Where to draw the path on the drawing (.png, .svg, .pdf).")
    ] = None,
    explain: Annotated[
        bool,
        typer.Option(
            "--explain",
            help="Tell which drawn walls speak for the last place and which against; the figure colors them.",
        ),
    ] = False,
    corrected: Annotated[
        Path | None,
        typer.Option(
            help="Where to write the drawing in metres, bent to what the robot saw "
            "(.svg, or .yaml: a map for nav2)."
        ),
    ] = None,
    first: Annotated[int, typer.Option("--from", min=0, help="First scan to use, counted from 0.")] = 0,
    last: Annotated[
        int | None,
        typer.Option("--to", min=1, help="Scan to stop before.", show_default="the end of the log"),
    ] = None,
    start: StartPose = None,
    scale: Scale = None,
    seed: Seed = 0,
    layer: Layers = None,
    label: Labels = None,
    page: Page = None,
    shading: Shade = "recognized",
    settings: SettingsFile = None,
    scan_topic: ScanTopic = None,
    odometry_topic: OdometryTopic = None,
    force: Force = False,
) -> None:
    """Tell for every scan of a log where on the drawing the robot was.

    The drawing needs no scale and no start. Estimates are JSON Lines, one object a scan:
    *status* located, lost or mismatch, the *place* and *cell* it is in, *x* and
    *y* in the drawing's own units and axes (in SVG, y points down), *heading*
    in radians counter-clockwise on the page, *scale* in drawing units per metre,
    *probability* and *fit* from 0 to 1, the *evidence* for this drawing over other
    buildings, as a natural logarithm, and the *hypotheses* it holds.

    **Examples:**

    - `pilotage localize office.svg run.log.gz -o out.jsonl --figure where.png`
    - `pilotage localize office.svg run.log.gz --from 100 --start 450,240,40`
    - `pilotage localize office.svg run.log.gz --to 500 --explain --figure why.png`
    - `pilotage localize office.svg run.log.gz -o out.jsonl --corrected metres.svg`
    """
    corrections = [] if corrected is None else corrected_files(corrected)
    check_outputs([output, *corrections], figure=figure, force=force)
    check_positive(scale, "--scale")
    sketch = open_drawing(drawing, layer, label, page, shading).sketch
    known = None if start is None else parse_pose(start, "--start")
    readings = read_stretch(log, first, last, scan_topic, odometry_topic)
    localizer = open_localizer(sketch, settings, seed, known, scale)
    tell_worst(drawing, findings_of(sketch, settings))
    with estimates_sink(output, sketch) as write:
        sightings: list[Sighting] = []
        trip = run(localizer, readings, write, None if corrected is None else sightings)
    explanation = localizer.explain() if explain else None
    if figure is not None:
        with keeping(output):
            title = f"{log.name} in {drawing.name}"
            draw(sketch, localizer, trip.estimates, figure, explanation=explanation, title=title)
    say(trip.summary)
    if explanation is not None:
        say(explanation.summary)
    if corrected is not None:
        with keeping(output), signals_held():
            write_corrections(localizer.atlas, sightings, [corrected])


def corrected_files(path: Path) -> tuple[Path, ...]:
    """List the files that a corrected drawing needs; complain about an ending that says no format."""
    from pilotage.io.corrected import check_ending, files_of

    check_ending(path)
    return files_of(path)
