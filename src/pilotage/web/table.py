"""What the routes of a server share."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from starlette.requests import HTTPConnection

from pilotage.web.folder import Folder
from pilotage.web.order import RobotOrder
from pilotage.web.recordings import Recordings
from pilotage.web.sessions import Sessions
from pilotage.web.workers import Jobs

if TYPE_CHECKING:
    from pilotage.config import Settings


@dataclass(slots=True)
class Table:
    """The folder, the workers, the drives, and what pages sent."""

    folder: Folder
    robot: RobotOrder | None = None  # on the network, if there is one
    settings: "Settings | None" = None  # of all other robots, and of drawings; None for the defaults
    jobs: Jobs = field(default_factory=Jobs)
    sessions: Sessions = field(default_factory=Sessions)
    recordings: Recordings = field(init=False)

    def __post_init__(self) -> None:
        """Look for recordings in the folder."""
        self.recordings = Recordings(self.folder)

    def close(self) -> None:
        """End all drives, and delete what pages sent."""
        self.sessions.close()
        self.recordings.close()


def table_of(asked: HTTPConnection) -> Table:
    """Return the table that a request is for."""
    table: Table = asked.app.state.table
    return table
