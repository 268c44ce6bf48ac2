"""Three buildings to drive in, and two drawings of each from memory; `examples/make_worlds.py` made them.

Beside the drawings lies the truth about them, for scoring only: `rooms.geojson` and, for each drawing, a
`.json` file with its rooms and with points that are the same in the building.
"""

from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path


@dataclass(frozen=True, slots=True)
class PackedWorld:
    """A furnished building in which people walk and doors close."""

    name: str

    @property
    def folder(self) -> Path:
        """Where its files are."""
        return Path(str(files(__name__))) / self.name

    @property
    def world(self) -> Path:
        """The true building [m]; the simulator alone sees it."""
        return self.folder / "world.svg"

    @property
    def careful(self) -> Path:
        """A drawing whose proportions are nearly right; without furniture, as all drawings."""
        return self.folder / "careful.svg"

    @property
    def quick(self) -> Path:
        """A drawing with wobbly strokes and wrong proportions."""
        return self.folder / "quick.svg"


OFFICE = PackedWorld("office")
"""A floor with rooms on both sides of a corridor, and a hall."""
HOME = PackedWorld("home")
"""A house with a sunroom."""
MUSEUM = PackedWorld("museum")
"""Galleries about a great hall with free-standing walls."""
ALL = (OFFICE, HOME, MUSEUM)

LOG = OFFICE.folder / "run.log.gz"
"""A robot's drive through the office, simulated; `examples/make_log.py` made it."""
TRUTH = OFFICE.folder / "truth.jsonl"
"""Where that robot truly was on the quick drawing at each scan; for scoring only."""

__all__ = ["ALL", "HOME", "LOG", "MUSEUM", "OFFICE", "TRUTH", "PackedWorld"]
