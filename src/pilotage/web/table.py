"""What the routes of a server share."""

from dataclasses import dataclass, field

from starlette.requests import HTTPConnection

from pilotage.web.folder import Folder
from pilotage.web.sessions import Sessions
from pilotage.web.workers import Jobs


@dataclass(slots=True)
class Table:
    """The folder, the workers and the drives."""

    folder: Folder
    jobs: Jobs = field(default_factory=Jobs)
    sessions: Sessions = field(default_factory=Sessions)


def table_of(asked: HTTPConnection) -> Table:
    """Return the table that a request is for."""
    table: Table = asked.app.state.table
    return table
