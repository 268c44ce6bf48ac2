"""Run a localizer over a log, and tell how it went: what `localize` and `demo` share."""

import math
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from pilotage.cli.terminal import busy, say, track
from pilotage.errors import FileError

if TYPE_CHECKING:
    from pilotage.geometry import Array, Pose2
    from pilotage.localization import Estimate, Localizer
    from pilotage.maps import SchematicMap
    from pilotage.perception import Reading

LOCAL_WAY = 6.0
"""The way back along which scans are laid over the drawing in the figure's close view [m]."""


def read_stretch(log: Path, first: int, last: int | None) -> "Sequence[Reading]":
    """Read the scans first .. last - 1 of a log; complain about lines that were left out."""
    from pilotage.io import open_log

    content = open_log(log)
    if content.complaint:
        say(content.complaint)
    readings = content.readings[first:last]
    if not readings:
        raise FileError(f"the log holds {len(content)} scans, none of them from {first} to {last}", log)
    return readings


def open_localizer(
    sketch: "SchematicMap", settings: Path | None, seed: int, start: "Pose2 | None", scale: float | None
) -> "Localizer":
    """Prepare the drawing."""
    from pilotage.localization import Localizer, LocalizerSettings

    chosen = LocalizerSettings()
    if settings is not None:
        from pilotage.config import read_settings

        chosen = read_settings(settings).localizer
    with busy("Reading the drawing"):
        try:
            return Localizer(sketch, chosen, seed=seed, start=start, scale=scale)
        except ValueError as error:  # of the drawing: all else was checked before
            raise FileError(str(error), sketch.source) from error


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
    localizer: "Localizer", readings: "Sequence[Reading]", write: "Callable[[Estimate], None]"
) -> "list[Estimate]":
    """Localize scan by scan, each estimate written as it comes."""
    estimates = []
    for reading in track(readings, "Localizing"):
        estimates.append(localizer.update(reading.scan, reading.odometry))
        write(estimates[-1])
    return estimates


def draw(
    sketch: "SchematicMap",
    estimates: "Sequence[Estimate]",
    readings: "Sequence[Reading]",
    path: Path,
    *,
    title: str,
    truth: "Array | None" = None,
) -> None:
    """Draw the path, and what was seen last."""
    from pilotage.figures.path import path_figure
    from pilotage.figures.style import save

    figure = path_figure(sketch, estimates, local_map=last_returns(readings), truth=truth, title=title)
    save(figure, path)


def last_returns(readings: "Sequence[Reading]") -> "Array":
    """Gather the returns of the last metres in the last base frame, carried by odometry, (n, 2) [m]."""
    import numpy as np

    base_from_odom = readings[-1].odometry.odom_from_base.inverse()
    way, gathered = 0.0, []
    following = readings[-1].odometry.odom_from_base
    for reading in reversed(readings):
        odom_from_base = reading.odometry.odom_from_base
        way += math.hypot(odom_from_base.x - following.x, odom_from_base.y - following.y)
        following = odom_from_base
        if way > LOCAL_WAY:
            break
        gathered.append((base_from_odom @ odom_from_base) @ reading.scan.points_in_base)
    return np.vstack(gathered)


def summary(estimates: "Sequence[Estimate]") -> str:
    """Say in one sentence how it went."""
    from pilotage.localization import Status

    located = [k for k, estimate in enumerate(estimates) if estimate.status is Status.LOCATED]
    count = f"{len(estimates)} scan{'s' if len(estimates) != 1 else ''}"
    if not located:
        return f"{count}: lost in all of them."
    final = estimates[-1]
    end = (
        f"in {final.cell_id} with confidence {final.confidence:.2f}"
        if final.status is Status.LOCATED
        else "lost"
    )
    return f"{count}: located in {len(located)}, the first time at scan {located[0]}; at the end {end}."
