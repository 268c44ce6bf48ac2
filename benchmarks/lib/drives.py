"""Make one drive of a benchmark: score it, write its journal, draw it."""

import sys
import time
import traceback
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.lib.errands import Errand
from benchmarks.lib.sites import Site
from pilotage.config import Settings
from pilotage.drives import Drive, navigate
from pilotage.evaluation.drive import Destination, DriveScore, score
from pilotage.geometry import Array
from pilotage.io.journal import journal_file


@dataclass(frozen=True, slots=True)
class Job:
    """A drive to be made."""

    mode: str
    site: str
    hand: str
    number: int
    errand: Errand

    @property
    def name(self) -> str:
        """For files and lines of progress."""
        return f"{self.mode}-{self.site}-{self.hand}-{self.number}"


@dataclass(frozen=True, slots=True)
class Result:
    """The result of a drive."""

    job: Job
    score: DriveScore | None  # None if the program failed
    reason: str
    right_room: float  # share of steps, nan if none was in a drawn room
    step_ms: Array  # (n,) [ms]
    seconds: float
    complaint: str = ""  # the error, if the program failed


@dataclass(frozen=True, slots=True)
class Options:
    """How drives are made."""

    seed: int
    settings: Settings
    journal: Path | None
    figure: Path | None


sites: dict[str, Site] = {}  # filled before the worker processes are forked off


def make(job: Job, options: Options) -> Result:
    """Make one drive; an error of the program counts as a failure."""
    began = time.perf_counter()
    try:
        driven = drive_of(job, options)
    except Exception as error:  # noqa: BLE001  # whatever it is, the other drives go on
        complaint = complain(job, error)
        return Result(job, None, complaint, np.nan, np.empty(0), time.perf_counter() - began, complaint)
    scored = score(driven, destination_of(job), job.errand.shortest)
    reason = reason_of(scored)
    try:
        write_down(job, options, driven, reason)
        complaint = ""
    except Exception as error:  # noqa: BLE001  # the drive itself went well
        complaint = complain(job, error)
    seconds = time.perf_counter() - began
    return Result(
        job, scored, reason, right_room_share(job, driven), np.array(driven.step_ms), seconds, complaint
    )


def complain(job: Job, error: Exception) -> str:
    """Print where the program failed; return its error message."""
    print(f"{job.name}: {''.join(traceback.format_exception(error))}", file=sys.stderr, flush=True)
    return f"failed: {traceback.format_exception_only(error)[-1].strip()}"


def drive_of(job: Job, options: Options) -> Drive:
    """Make one drive."""
    site, errand = sites[job.site], job.errand
    drawing = site.drawing_by[job.hand]
    points = drawing.warp.sketch_from_world(np.array([errand.goal]))
    x, y = drawing.atlas.sketch.file_from_sketch(points)[0].tolist()
    marked = drawing.warp.sketch_from_base(errand.start).pose
    start = drawing.atlas.sketch.file_from_sketch(marked.position[np.newaxis])[0].tolist()
    return navigate(
        drawing.atlas,
        site.world,
        (x, y),
        start=(*start, marked.theta) if job.mode == "known" else None,
        world_start=errand.start,
        seed=1000 * options.seed + job.number,
        settings=options.settings,
    )


def write_down(job: Job, options: Options, driven: Drive, reason: str) -> None:
    """Write the journal and the picture of a drive, where wanted."""
    site, errand = sites[job.site], job.errand
    drawing = site.drawing_by[job.hand]
    if options.journal:
        with journal_file(options.journal / f"{job.name}.jsonl", drawing.atlas.sketch) as write:
            for step, scene in zip(driven.steps, driven.scenes, strict=True):
                write(step, scene)
    if options.figure:
        from benchmarks.lib.drive_picture import write_picture

        title = f"{job.name}: {errand.start_room} to {errand.goal_room}: {reason}"
        write_picture(
            options.figure / f"{job.name}.png", driven, drawing=drawing, site=site, errand=errand, title=title
        )


def right_room_share(job: Job, driven: Drive) -> float:
    """Return the share of steps that claim the true room, of those in drawn rooms; nan if there are none."""
    site = sites[job.site]
    drawing = site.drawing_by[job.hand]
    truths = site.rooms.names_at(driven.positions)
    estimates = [step.estimate for step in driven.steps]
    claims = drawing.claimed_rooms(
        np.array([estimate.sketch_from_base.pose.position for estimate in estimates])
    )
    right = [
        claim == truth for claim, truth in zip(claims, truths, strict=True) if truth in drawing.rooms.names
    ]
    return float(np.mean(right)) if right else np.nan


def destination_of(job: Job) -> Destination:
    """Return where a drive should end."""
    rooms = sites[job.site].rooms
    return Destination(job.errand.goal, rooms.polygons[rooms.names.index(job.errand.goal_room)])


def reason_of(scored: DriveScore) -> str:
    """Say in a few words how a drive ended; numbers are left out, so that reasons can be counted."""
    if scored.reached:
        return "reached"
    if scored.outcome == "reached":
        return "stopped in the right room, too far off" if scored.in_room else "stopped in a wrong room"
    return f"{scored.outcome}: {scored.reason}"
