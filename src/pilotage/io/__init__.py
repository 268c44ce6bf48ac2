"""One reader or writer a format."""

from pilotage.io.logs import Log, open_log
from pilotage.io.maps import open_map

__all__ = ["Log", "open_log", "open_map"]
