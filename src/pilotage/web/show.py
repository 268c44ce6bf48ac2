"""What a session shows, whatever it is: a drive in a world, a log, or a journal."""

from typing import Protocol

from pilotage.maps import CellGraph
from pilotage.navigation import Step
from pilotage.web.drawings import Json


class Show(Protocol):
    """Goes on step by step, and describes itself to the page."""

    @property
    def graph(self) -> CellGraph:
        """The cells of the drawing."""

    @property
    def stamp(self) -> float:
        """The time since it began [s]."""

    @property
    def time_step(self) -> float:
        """The time until the next step [s]."""

    @property
    def is_over(self) -> bool:
        """Whether there is no next step."""

    def step(self) -> Step:
        """Go on to the next step."""

    def frame(self) -> Json:
        """Describe the present moment."""

    def describe(self, title: str) -> Json:
        """Describe what is shown, and its drawing."""

    def describe_world(self) -> Json | None:
        """Describe all that stands, if it is known."""
