"""One reader or writer a format."""

from pilotage.io.log_writer import write_log
from pilotage.io.logs import Log, open_log
from pilotage.io.maps import open_map
from pilotage.io.world import open_world

__all__ = ["Log", "open_log", "open_map", "open_world", "write_log"]
