"""The drawing corrected while the robot drives: fitted in a process beside the drive, every few metres."""

import multiprocessing
import os
import signal
import sys
import time
from collections.abc import Callable, Sequence
from multiprocessing.connection import Connection

import numpy as np

from pilotage.correction import CorrectedDrawing, Sighting, fit_drawing, give_way
from pilotage.geometry import Polyline, fit_similarity
from pilotage.maps import Atlas, SchematicMap
from pilotage.web.drawings import Json, Page

SIGHTINGS = 6
"""New sightings until the drawing is corrected again: 3 m of travel."""
REST = 10.0
"""Pause after a fit, in times of the processor that it took: fits use less than a tenth of one."""

Work = Callable[[], tuple[Json | None, float]]
"""Returns what a fit found, for the page, and how long it took [s of the processor]."""


class Bending:
    """Corrects the drawing of a drive beside it, and no more often than it can afford."""

    def __init__(self, atlas: Atlas, sightings: Sequence[Sighting], inherited: Connection) -> None:
        self._atlas, self._sightings = atlas, sightings
        self._inherited = inherited  # the drive's own connection, which a fit must not keep open
        self._used = 0  # sightings of the last fit
        self._rests_until = 0.0  # [s] on the clock
        self._process = 0
        self._pipe: Connection | None = None

    @property
    def pipes(self) -> list[Connection]:
        """Where the result will be heard, while there is a fit."""
        return [] if self._pipe is None else [self._pipe]

    def begin_if_due(self, *, is_over: bool) -> None:
        """Begin a fit after some travel and some rest; when the drive is over, at once after any travel."""
        if sys.platform == "win32":  # Windows cannot fork
            return
        self._used = min(self._used, len(self._sightings))  # a robot that was carried begins anew
        fresh = len(self._sightings) - self._used
        is_due = fresh >= SIGHTINGS and self._pipe is None and time.monotonic() >= self._rests_until
        if is_due or (is_over and fresh > 0):
            self._give_up()
            self._used = len(self._sightings)
            work = self._work(self._sightings[: self._used])
            self._process, self._pipe = forked(work, self._inherited, gives_way=not is_over)

    def _give_up(self) -> None:
        """End a fit that goes on: its sightings are a part of those of the next one."""
        if self._pipe is not None:
            os.kill(self._process, signal.SIGKILL)
            self._end()

    def _end(self) -> None:
        """Let go of a process that has told what it found, or was ended."""
        assert self._pipe is not None
        self._pipe.close()
        self._pipe = None
        os.waitpid(self._process, 0)

    def result(self) -> Json | None:
        """Return what a fit has found, once its pipe is ready; None if the robot was not sure enough."""
        assert self._pipe is not None
        found: Json | None
        try:
            found, took = self._pipe.recv()
        except EOFError:
            found, took = None, 0.0  # it failed; the last one stands
        self._end()
        self._rests_until = time.monotonic() + REST * took
        return found

    def _work(self, sightings: Sequence[Sighting]) -> Work:
        """Return the fit that is to be made."""

        def work() -> tuple[Json | None, float]:
            fit = fit_drawing(self._atlas, sightings)
            sketch = self._atlas.sketch
            return None if fit.corrected is None else describe_corrected(fit.corrected, sketch), fit.took

        return work


def forked(work: Work, inherited: Connection, *, gives_way: bool) -> tuple[int, Connection]:
    """Do some work in a copy of this process; return its id, and where to hear what it returns.

    While the robot drives, the work gives way to it; after the drive a person waits for it.
    """
    here, there = multiprocessing.Pipe(duplex=False)
    process = os.fork()
    if process == 0:
        try:
            inherited.close()
            here.close()
            if gives_way:
                give_way()
            there.send(work())
        finally:
            os._exit(0)
    there.close()
    return process, here


def describe_corrected(corrected: CorrectedDrawing, sketch: SchematicMap) -> Json:
    """Lay a corrected drawing over the drawn one, as well as a similarity can, in the axes of the page."""
    page = Page(sketch)
    vertices = np.vstack([stroke.vertices for stroke in sketch.strokes])
    sketch_from_metres = fit_similarity(corrected.metres_from_sketch @ vertices, vertices)

    def lines(all_of: tuple[Polyline, ...]) -> list[list[list[float]]]:
        return [page.points(sketch_from_metres @ one.vertices) for one in all_of]

    return {
        "seen": lines(corrected.seen),
        "unseen": lines(corrected.unseen),
        "passages": [
            {
                "gateway": one.gateway_id,
                "segment": page.points(sketch_from_metres @ one.segment),
                "state": one.state.value,
            }
            for one in corrected.passages
        ],
        "seen_share": round(corrected.seen_share, 3),
    }
