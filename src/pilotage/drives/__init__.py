"""The closed loop of navigator and simulator, and its record: one value for journal, score and picture."""

from pilotage.drives.loop import Instant, Pilot, drive, make_building, set_out
from pilotage.drives.record import Drive
from pilotage.drives.run import navigate
from pilotage.drives.watching import WatchingPilot

__all__ = ["Drive", "Instant", "Pilot", "WatchingPilot", "drive", "make_building", "navigate", "set_out"]
