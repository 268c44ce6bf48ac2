"""Where the data of others is, and the names of what is in it."""

import os
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DATA = Path(os.environ.get("PILOTAGE_DATA", ROOT.parent / "shared" / "data"))
LOGS = DATA / "logs"

BUILDINGS = ("aces", "belgioioso", "csail", "fhw", "freiburg-079", "freiburg-101")
TUNED = (
    "aces",
    "belgioioso",
    "csail",
    "freiburg-079",
)  # defaults were chosen on these; the others are held out
HANDS = ("draftsman", "quick", "schematic")
PEOPLE = ("freehand", "plan")  # drawings by people, of belgioioso only
PACKED_HANDS = ("careful", "quick")
LOG_NAMES = ("freiburg-079", "freiburg-101", "csail", "aces", "infinite-corridor", "belgioioso", "fhw")


def folder_of(building: str, hand: str) -> Path:
    """Return the folder that holds a drawing, its truth and the building's rooms."""
    return DATA / ("people-drawings" if hand in PEOPLE else "sketches") / building


def drawing_of(building: str, hand: str) -> Path:
    """Return the file of a drawing."""
    return folder_of(building, hand) / f"{hand}.svg"


def drawings(buildings: list[str], hands: list[str]) -> list[tuple[str, str]]:
    """List the drawings that exist of these buildings by these hands."""
    return [
        (building, hand) for building in buildings for hand in hands if drawing_of(building, hand).exists()
    ]
