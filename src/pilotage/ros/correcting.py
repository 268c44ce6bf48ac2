"""Correct the drawing while a robot drives: in a process beside, so that no step waits for it."""

import contextlib
import multiprocessing
import os
import signal
import time
from collections.abc import Callable, Iterator
from multiprocessing.connection import Connection

import numpy as np

from pilotage.correction import BackgroundCorrection, Sighting, fit_drawing, give_way
from pilotage.io.bags.bent_frame import BentFrame
from pilotage.maps import Atlas
from pilotage.ros.session import Session

EVERY = 30.0
"""Shortest time [s] between two corrected maps."""
SIGHTINGS = 20
"""New sightings until the map is corrected again: 10 m of travel."""
MOVED = 0.05
"""Distance [m] by which a wall must have moved for the map to be said again."""
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")


class Correcting:
    """Gives what a session has seen to a process, and takes the corrected drawing when it is there."""

    def __init__(
        self,
        session: Session,
        say: Callable[[str], None],
        *,
        every: float = EVERY,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._session, self._say, self._every, self._clock = session, say, every, clock
        here, there = multiprocessing.Pipe()
        spawning = multiprocessing.get_context("spawn")
        self._process = spawning.Process(target=correct_on_demand, args=(there, session.atlas), daemon=True)
        with one_thread():
            self._process.start()
        there.close()
        self._connection = here
        self._sent, self._began = 0, session.sightings_began  # of sightings
        self._asked = -np.inf
        self.waits = False  # for a correction
        self._is_over = False
        self.took = 0.0  # [s] of the processor, for the last correction

    def look(self) -> None:
        """Ask for a correction if one is due, and take one that is there; it takes a millisecond."""
        if self._is_over:
            return
        try:
            if self.waits and self._connection.poll(0.0):
                self._take(self._connection.recv())
            elif not self.waits and self._is_due:
                self._ask()
        except (EOFError, OSError):
            self._say("the map is not corrected any more: the process of the correction has ended")
            self._is_over, self.waits = True, False

    def close(self) -> None:
        """End the process."""
        self._connection.close()
        self._process.terminate()
        self._process.join()

    @property
    def _is_due(self) -> bool:
        """Whether enough is new."""
        is_anew = self._began != self._session.sightings_began
        new = len(self._session.sightings) - (0 if is_anew else self._sent)
        return new >= SIGHTINGS and self._clock() - self._asked >= self._every

    def _ask(self) -> None:
        """Send what is new."""
        seen, began = self._session.sightings, self._session.sightings_began
        is_anew = began != self._began
        self._connection.send((is_anew, seen[0 if is_anew else self._sent :]))
        self._sent, self._began, self._asked, self.waits = len(seen), began, self._clock(), True

    def _take(self, fit: BackgroundCorrection) -> None:
        """Use a corrected drawing if it is news."""
        self.waits, self.took = False, fit.took
        corrected = fit.corrected
        if corrected is None or self._began != self._session.sightings_began:
            return  # the robot was hardly sure yet, or began anew meanwhile
        before = self._session.frame
        self._session.correct(corrected, self._sent)
        after = self._session.frame
        drawn = after.sketch.segments.reshape(-1, 2)
        if isinstance(before, BentFrame):
            moved = after.from_sketch(drawn) - before.from_sketch(drawn)
            if np.abs(moved).max() < MOVED:
                self._session.frame = before
                return
        self._say(f"the map is corrected: {corrected.seen_share:.0%} of the walls were seen")


def correct_on_demand(connection: Connection, atlas: Atlas) -> None:
    """Correct the drawing by all sightings that came, whenever some come, until the connection is closed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the robot's process
    give_way()
    sightings: list[Sighting] = []
    with contextlib.suppress(EOFError, OSError):
        while True:
            is_anew, new = connection.recv()
            sightings = [*(() if is_anew else sightings), *new]
            connection.send(fit_drawing(atlas, sightings))


@contextlib.contextmanager
def one_thread() -> Iterator[None]:
    """Let processes that are started meanwhile compute in one thread: the others are the robot's."""
    before = {name: os.environ.get(name) for name in THREADS}
    os.environ.update(dict.fromkeys(THREADS, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
