"""`pilotage perceive`: see scans as shapes."""

from pathlib import Path
from typing import Annotated

import typer

from pilotage.cli.options import Force, SettingsFile
from pilotage.cli.run import LOG_HELP, ScanTopic
from pilotage.cli.terminal import check_outputs, say
from pilotage.errors import FileError


def perceive(
    log: Annotated[Path, typer.Argument(metavar="LOG", help=LOG_HELP)],
    *,
    scan: Annotated[int, typer.Option(min=0, help="Which scan of the log, counted from 0.")] = 0,
    figure: Annotated[
        Path | None, typer.Option(help="Where to draw the scan and its shapes (.png, .svg, .pdf).")
    ] = None,
    settings: SettingsFile = None,
    scan_topic: ScanTopic = None,
    force: Force = False,
) -> None:
    """See one scan as partial shapes (Wolter 2001, sections 2.1 and 2.2; figure 2).

    Neighboring returns are joined to polylines, broken where the line of sight passes an edge, and simplified
    until every vertex left is relevant. For each shape: how many vertices, how long, and why it ends on its
    right and on its left.

    **Example:** `pilotage perceive run.log.gz --scan 120 --figure scan.png`
    """
    check_outputs((), figure=figure, force=force)
    from pilotage.config import read_settings
    from pilotage.io import open_log
    from pilotage.perception import perceive as see

    chosen = read_settings(settings).localizer.scan_matching.perception
    readings = open_log(log, scan_topic=scan_topic)
    if readings.complaint:
        say(readings.complaint)
    if scan >= len(readings):
        raise FileError(f"the log holds scans 0 to {len(readings) - 1}, asked was for scan {scan}", log)
    sweep = readings.readings[scan].scan
    shapes = see(sweep, chosen)
    typer.echo(
        f"scan {scan} of {len(readings)} at {sweep.stamp:.3f} s: "
        f"{int(sweep.returned.sum())} returns of {len(sweep)} beams, {len(shapes)} shapes"
    )
    for k, shape in enumerate(shapes):
        line = shape.polyline
        typer.echo(
            f"{k:4d}  {len(line):4d} vertices  {line.length:7.2f} m  "
            f"{shape.first_end.name.lower():>11} .. {shape.last_end.name.lower()}"
        )
    if figure is not None:
        from pilotage.figures.scan import scan_figure
        from pilotage.figures.style import save

        save(scan_figure(sweep, shapes), figure)
        say(f"drawn in {figure}")
