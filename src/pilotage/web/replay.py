"""A log instead of a simulator: the scans of a robot that drove once, localized live on a drawing."""

import math
from dataclasses import dataclass
from pathlib import Path

from pilotage.config import Settings
from pilotage.drives import Instant
from pilotage.errors import PilotageError
from pilotage.geometry import Pose2, Twist
from pilotage.io import open_log
from pilotage.localization import Localizer
from pilotage.maps import Atlas
from pilotage.navigation import Behavior, Navigator, Step
from pilotage.perception import Reading
from pilotage.simulation import Scene
from pilotage.simulation.scene import NOBODY
from pilotage.web.drawings import Json, Page, describe_drawing
from pilotage.web.order import Place

LONGEST_PAUSE = 1.0
"""A log that pauses longer than this [s] is not waited for."""
STILL = Twist(0.0, 0.0)


class ReplayError(PilotageError):
    """A replay is asked for what only a drive can do."""


class LogSource:
    """Gives the scans of a log, one after the other."""

    def __init__(self, path: Path) -> None:
        self._readings = open_log(path).readings
        self._next = 0

    @property
    def is_over(self) -> bool:
        """Whether all scans were read."""
        return self._next >= len(self._readings)

    @property
    def stamp(self) -> float:
        """The time of the last scan that was read, since the first one [s]."""
        return self._at(self._next - 1) - self._at(0)

    @property
    def time_step(self) -> float:
        """The time until the next scan [s]."""
        return min(max(self._at(self._next) - self._at(self._next - 1), 0.0), LONGEST_PAUSE)

    def read(self) -> Reading:
        """Read the next scan."""
        self._next += 1
        return self._readings[self._next - 1]

    def _at(self, number: int) -> float:
        """Return the stamp of a scan; of one before the first or after the last that of the nearest [s]."""
        return self._readings[min(max(number, 0), len(self._readings) - 1)].scan.stamp


@dataclass(slots=True)
class Replay:
    """The stage of a log: nothing is steered, and nothing true is known."""

    navigator: Navigator
    source: LogSource
    page: Page
    truth: None = None

    @property
    def localizer(self) -> Localizer:
        """The localizer."""
        return self.navigator.position.localizer

    @property
    def stamp(self) -> float:
        """The time since the log began [s]."""
        return self.source.stamp

    @property
    def time_step(self) -> float:
        """The time until the next step [s]."""
        return self.source.time_step

    @property
    def goal_name(self) -> str:
        """A log has no goal."""
        return ""

    @property
    def is_over(self) -> bool:
        """Whether the log has ended."""
        return self.source.is_over

    def step(self) -> Instant:
        """Localize by the next scan."""
        reading = self.source.read()
        position = self.navigator.position
        position.update(reading.scan, reading.odometry)
        step = Step(
            self.source.stamp, STILL, Behavior.REST, position.localized, times_lost=position.times_lost
        )
        scene = Scene(Pose2.identity(), reading.scan, NOBODY.people[:, :2], NOBODY.closed_doors)
        return Instant(step, scene, math.nan)

    def describe(self, title: str) -> Json:
        """Describe the drawing."""
        drawn = {**describe_drawing(self.page.sketch), "goal": None}
        return {"title": title, "drawing": drawn, "goal": ""}

    def describe_world(self) -> None:
        """Nothing true is known."""

    def set_goal(self, _goal: Place) -> None:
        """Refuse: the robot has driven long ago."""
        raise ReplayError("a log cannot be driven elsewhere")


def replay(atlas: Atlas, page: Page, log: Path, start: tuple[float, ...] | None, seed: int) -> Replay:
    """Prepare to localize by a log; FileError if it cannot be read."""
    settings = Settings()
    source = LogSource(log)
    localizer = Localizer(atlas, settings.localizer, seed=seed, start=start)  # type: ignore[arg-type]
    return Replay(Navigator(localizer, any_goal(atlas), settings.navigator), source, page)


def any_goal(atlas: Atlas) -> tuple[float, float]:
    """Return a point in the axes of the drawing's file that a navigator may have for a goal."""
    if atlas.cell_graph is None:
        raise ReplayError("a drawing to localize on must enclose free space, it has no closed room")
    x, y = Page(atlas.sketch).point(atlas.cell_graph.cells[0].center) or (0.0, 0.0)
    return Page(atlas.sketch).file_point(x, y)
