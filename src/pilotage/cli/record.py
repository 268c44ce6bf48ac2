"""`pilotage record`: what is believed along a log or a drive, as standard messages of ROS 2."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pilotage.cli.drawing import Labels, Layers, Map, Page, Shade, open_drawing
from pilotage.cli.options import Force, Seed, SettingsFile, StartPose, check_positive
from pilotage.cli.places import parse_pose
from pilotage.cli.run import OdometryTopic, ScanTopic, open_localizer, read_stretch, run
from pilotage.cli.terminal import busy, check_outputs, say
from pilotage.errors import FileError

if TYPE_CHECKING:
    from pilotage.io.bags.belief import Belief, MapFrame
    from pilotage.io.records import Record
    from pilotage.localization import Estimate
    from pilotage.maps import CellGraph, SchematicMap
    from pilotage.perception import Reading

MOST_NAMES = 4
"""Names of places that a remark lists."""


def record(
    drawing: Map,
    log: Annotated[
        Path,
        typer.Argument(
            metavar="LOG",
            help="A laser log, as for `localize`, or the journal of a drive or estimates (JSON Lines).",
        ),
    ],
    *,
    output: Annotated[Path, typer.Option("-o", "--output", help="The MCAP file to write.")],
    start: StartPose = None,
    scale: Annotated[
        float | None, typer.Option(help="Drawing units per metre, for the frame `map` as well.")
    ] = None,
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
    """Write what is believed along a log or a drive as an MCAP file of standard messages.

    Foxglove, Lichtblick and RViz show it without a plug-in: pose and transforms in
    the frame *map*, path, drawing, cells, hypotheses, occupancy grid and diagnostics.
    The frame *map* is the drawing at one scale: `--scale`, or what the file says, or
    the scale at the end of the log.

    **Examples:**

    - Localize along a log: `pilotage record office.svg run.mcap -o beliefs.mcap`
    - A drive of `navigate`: `pilotage record office.svg run/journal.jsonl -o drive.mcap`
    - What `localize` wrote: `pilotage record office.svg estimates.jsonl -o beliefs.mcap --scale 20`
    """
    check_outputs([output], force=force)
    if output.suffix != ".mcap":
        raise FileError("the name of the output must end in .mcap", output)
    check_positive(scale, "--scale")
    from pilotage.io.bags.belief import Belief, MapFrame
    from pilotage.io.records import is_records, read_records

    sketch = open_drawing(drawing, layer, label, page, shading).sketch
    if is_records(log):
        refuse_for_records(
            log, {"--start": start, "--scan-topic": scan_topic, "--odom-topic": odometry_topic}
        )
        records = read_records(log)
        frame = MapFrame(sketch, scale_of(sketch, scale, [one["scale"] for one in records]))
        localizer = open_localizer(sketch, settings, seed, None, scale)
        try:
            told = [(Belief.of_record(one, frame), None) for one in records]
        except (KeyError, TypeError, ValueError) as error:
            raise FileError(f"a line is no estimate of this program ({error})", log) from error
        write(output, frame, localizer.atlas.cell_graph, iter(told))
        tell_unknown_places(log, records, localizer.atlas.cell_graph)
    else:
        readings = read_stretch(log, 0, None, scan_topic, odometry_topic)
        known = None if start is None else parse_pose(start, "--start")
        localizer = open_localizer(sketch, settings, seed, known, scale)
        estimates: list[Estimate] = []
        trip = run(localizer, readings, estimates.append)
        frame = MapFrame(sketch, scale_of(sketch, scale, [one.scale for one in estimates]))
        beliefs = (Belief.of_estimate(estimate, frame) for estimate in estimates)
        write(output, frame, localizer.atlas.cell_graph, zip(beliefs, readings, strict=True))
        say(trip.summary)
    say(f"written to {output}; the frame map has {frame.scale:.6g} drawing units per metre")


def tell_unknown_places(log: Path, records: "Sequence[Record]", graph: "CellGraph | None") -> None:
    """Say which places of a journal the drawing does not have: it may have been written about another one."""
    known = {""} | (set() if graph is None else {cell.cell_id for cell in graph.cells})
    unknown = sorted({str(one.get("cell") or "") for one in records} - known)
    if unknown:
        names = ", ".join(unknown[:MOST_NAMES]) + (", ..." if len(unknown) > MOST_NAMES else "")
        say(f"pilotage: {log.name}: the drawing has no place called {names}; is this its journal?")


def refuse_for_records(log: Path, options: Mapping[str, object]) -> None:
    """Raise FileError if an option is given that only a log can use."""
    for name, value in options.items():
        if value is not None:
            raise FileError(f"the file holds what was believed already, {name} is for laser logs", log)


def scale_of(sketch: "SchematicMap", given: float | None, estimated: Sequence[float]) -> float:
    """Choose the scale of the frame `map` [drawing units per metre]."""
    from pilotage.io.bags.belief import known_scale

    known = known_scale(sketch, given)
    return float(estimated[-1]) if known is None else known


def write(
    output: Path,
    frame: "MapFrame",
    graph: "CellGraph | None",
    told: "Iterator[tuple[Belief, Reading | None]]",
) -> None:
    """Write the file."""
    from pilotage.io.bags.recorder import recording

    with busy("Writing"), recording(output, frame, graph) as recorder:
        for belief, reading in told:
            recorder.add(belief, reading)
