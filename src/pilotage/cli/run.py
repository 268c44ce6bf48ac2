"""Run a localizer over a log, and tell how it went: what `localize` and `record` share."""

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pilotage.cli.exits import signals_held
from pilotage.cli.terminal import busy, say, track
from pilotage.cli.trip import Trip
from pilotage.errors import FileError

if TYPE_CHECKING:
    from pilotage.correction import Sighting
    from pilotage.localization import Estimate, Explanation, Localizer
    from pilotage.maps import SchematicMap
    from pilotage.perception import Reading


ScanTopic = Annotated[
    str | None,
    typer.Option("--scan-topic", help="Topic of the scans in a bag.", show_default="found by type"),
]
OdometryTopic = Annotated[
    str | None,
    typer.Option(
        "--odom-topic", help="Topic of the odometry in a bag.", show_default="found by type, or /tf"
    ),
]
LOG_HELP = "A laser log: a bag of ROS 1 or ROS 2 (file or folder), CARMEN or BreezySLAM text."


def read_stretch(
    log: Path,
    first: int,
    last: int | None,
    scan_topic: str | None = None,
    odometry_topic: str | None = None,
) -> "Sequence[Reading]":
    """Take the scans first .. last - 1 of a log; complain about what was left out."""
    from pilotage.io import open_log

    with busy("Reading the log"):
        content = open_log(log, scan_topic=scan_topic, odometry_topic=odometry_topic)
    if content.complaint:
        say(content.complaint)
    readings = content.readings[first:last]
    if not readings:
        until = "on" if last is None else f"to {last}"
        raise FileError(f"the log holds {len(content)} scans, none of them from {first} {until}", log)
    return readings


def open_localizer(
    sketch: "SchematicMap",
    settings: Path | None,
    seed: int,
    start: "tuple[float, float, float] | None",
    scale: float | None,
) -> "Localizer":
    """Prepare the drawing; a start that lies in no room is refused, as by `navigate`."""
    from pilotage.config import read_settings
    from pilotage.localization import Localizer
    from pilotage.navigation.goal import sketch_point

    chosen = read_settings(settings).localizer
    with busy("Reading the drawing"), signals_held():
        try:
            localizer = Localizer(sketch, chosen, seed=seed, start=start, scale=scale)
        except ValueError as error:  # of the drawing: all else was checked before
            raise FileError(str(error), sketch.source) from error
    if start is not None:
        sketch_point(localizer.atlas, start[:2], "start")
    return localizer


@contextmanager
def estimates_sink(output: Path | None, sketch: "SchematicMap") -> "Iterator[Callable[[Estimate], None]]":
    """Open a file for estimates, or standard output."""
    from pilotage.io.estimates import estimates_file, write_estimate

    if output is None:
        yield lambda estimate: write_estimate(sys.stdout, estimate, sketch)
        return
    with estimates_file(output, sketch) as write:
        yield write


def run(
    localizer: "Localizer",
    readings: "Sequence[Reading]",
    write: "Callable[[Estimate], None]",
    sightings: "list[Sighting] | None" = None,
) -> Trip:
    """Localize scan by scan, each estimate written as it comes; sightings are kept if there is a list."""
    from pilotage.correction import append_sighting

    trip = Trip()
    for reading in track(readings, "Localizing"):
        with signals_held():
            estimate = localizer.update(reading.scan, reading.odometry)
            write(estimate)
            trip.add(estimate)
            if sightings is not None:
                append_sighting(sightings, localizer, reading.scan)
    return trip


def draw(
    sketch: "SchematicMap",
    localizer: "Localizer",
    estimates: "Sequence[Estimate]",
    path: Path,
    *,
    explanation: "Explanation | None" = None,
    title: str,
) -> None:
    """Draw the path, the local map as it is at the end, and what is said of the walls in view."""
    from pilotage.figures.path import path_figure
    from pilotage.figures.style import save

    matcher = localizer.scan_matcher
    base_from_odom = matcher.odom_from_base.inverse()
    local_map = [shape.polyline.moved(base_from_odom) for shape in matcher.local_map.shapes]
    figure = path_figure(sketch, estimates, local_map=local_map, explanation=explanation, title=title)
    save(figure, path)
