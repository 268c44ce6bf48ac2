"""A log instead of a simulator: the scans of a robot that drove once, localized live on a drawing."""

from dataclasses import dataclass, field
from pathlib import Path

from pilotage.config import Settings
from pilotage.correction import Sighting, append_sighting
from pilotage.errors import PilotageError
from pilotage.io import open_log
from pilotage.localization import Localizer
from pilotage.maps import Atlas, CellGraph
from pilotage.navigation import Behavior, Navigator, Step
from pilotage.navigation.steering import STILL
from pilotage.perception import LaserScan, Reading
from pilotage.web.drawings import Json, Page, describe_drawing
from pilotage.web.frames import FrameMaker

LONGEST_PAUSE = 1.0
"""A recording that pauses longer than this [s] is not waited for."""


class NoRoomError(PilotageError):
    """A drawing encloses nothing in which one can be."""


class LogSource:
    """Gives the scans of a log, one after the other; a bag is gone through once."""

    def __init__(self, path: Path) -> None:
        self._coming = iter(open_log(path))
        self._next: Reading | None = next(self._coming)  # a log has one scan at least
        self._first = self._last = self._next.scan.stamp  # [s] of the last one read

    @property
    def is_over(self) -> bool:
        """Whether all scans were read."""
        return self._next is None

    @property
    def stamp(self) -> float:
        """The time of the last scan that was read, since the first one [s]."""
        return self._last - self._first

    @property
    def time_step(self) -> float:
        """The time until the next scan [s]; 0 before the first and after the last."""
        ahead = 0.0 if self._next is None else self._next.scan.stamp - self._last
        return min(max(ahead, 0.0), LONGEST_PAUSE)

    def read(self) -> Reading:
        """Read the next scan; ValueError after the last."""
        if self._next is None:
            raise ValueError("the log has ended, there is no next scan")
        reading, self._next = self._next, next(self._coming, None)
        self._last = reading.scan.stamp
        return reading


@dataclass(slots=True)
class Replay:
    """The stage of a log: nothing is steered, and nothing true is known."""

    navigator: Navigator
    source: LogSource
    page: Page
    frames: FrameMaker = field(init=False)
    shown: tuple[Step, LaserScan] | None = None
    sightings: list[Sighting] = field(default_factory=list)  # by which the drawing can be corrected

    def __post_init__(self) -> None:
        """Begin with what is there."""
        self.frames = FrameMaker(self.navigator, self.page)

    @property
    def graph(self) -> CellGraph:
        """The cells of the drawing."""
        return self.navigator.planner.graph

    @property
    def stamp(self) -> float:
        """The time since the log began [s]."""
        return self.source.stamp

    @property
    def time_step(self) -> float:
        """The time until the next step [s]."""
        return self.source.time_step

    @property
    def is_over(self) -> bool:
        """Whether the log has ended."""
        return self.source.is_over

    def step(self) -> Step:
        """Localize by the next scan."""
        reading = self.source.read()
        position = self.navigator.position
        position.update(reading.scan, reading.odometry)
        step = Step(
            self.source.stamp, STILL, Behavior.REST, position.localized, times_lost=position.times_lost
        )
        self.shown = step, reading.scan
        if position.is_fresh:
            append_sighting(self.sightings, position.localizer, reading.scan)
        self.frames.note()
        return step

    def frame(self) -> Json:
        """Describe the last scan."""
        assert self.shown is not None
        step, scan = self.shown
        return self.frames.frame(step, scan, step.stamp, "")

    def describe(self, title: str) -> Json:
        """Describe the drawing."""
        drawn = {**describe_drawing(self.page.sketch), "goal": None}
        return {"kind": "log", "title": title, "drawing": drawn, "goal": ""}

    def describe_world(self) -> None:
        """Nothing true is known."""


def replay(
    atlas: Atlas, page: Page, log: Path, start: tuple[float, ...] | None, *, seed: int, settings: Settings
) -> Replay:
    """Prepare to localize by a log; FileError if it cannot be read."""
    source = LogSource(log)
    localizer = Localizer(atlas, settings.localizer, seed=seed, start=start)  # type: ignore[arg-type]
    return Replay(Navigator(localizer, any_goal(atlas), settings.navigator), source, page)


def any_goal(atlas: Atlas) -> tuple[float, float]:
    """Return a point in the axes of the drawing's file that a navigator may have for a goal."""
    x, y = Page(atlas.sketch).point(graph_of(atlas).cells[0].center) or (0.0, 0.0)
    return Page(atlas.sketch).file_point(x, y)


def graph_of(atlas: Atlas) -> CellGraph:
    """Return the cells of a drawing, joined for driving; NoRoomError if it has none."""
    if atlas.joined is None:
        raise NoRoomError("a drawing to localize on must enclose free space, it has no closed room")
    return atlas.joined.graph
