"""Logs and journals that can be watched: the packed one, those of the folder, and those that a page sent."""

import secrets
import tempfile
from pathlib import Path, PurePosixPath

from pilotage.web.folder import JOURNAL, RECORDINGS, Folder, NameRefusedError
from pilotage.web.order import OrderError
from pilotage.worlds import LOG

PACKED = "packed:office"
"""The packed log, of a drive through the packed office."""
MOST_SENT = 4
"""Recordings of pages that are kept; the oldest goes first."""
LONGEST_TITLE = 80
"""Letters of a name that are shown."""


class Recordings:
    """Finds recordings by their ids; what pages send is kept until the server ends."""

    def __init__(self, folder: Folder) -> None:
        self._folder = folder
        self._kept = tempfile.TemporaryDirectory(prefix="pilotage-recordings-")
        self._sent: dict[str, tuple[Path, str]] = {}

    def list(self) -> "list[dict[str, object]]":
        """List the packed one and those of the folder."""
        packed = described(PACKED, "office", LOG.name, ["office/careful", "office/quick"])
        return [packed, *(described(f"file:{name}", name, name) for name in self._folder.names(RECORDINGS))]

    def find(self, wanted: str) -> tuple[Path, str]:
        """Return the path and the title of a recording; OrderError if there is none of this id."""
        kind, _, name = wanted.partition(":")
        if wanted == PACKED:
            return LOG, "office"
        if wanted in self._sent:
            return self._sent[wanted]
        if kind != "file" or name not in self._folder.names(RECORDINGS):
            raise OrderError(f"there is no recording {wanted[:60]!r}")
        return self._folder.path(name, RECORDINGS), name

    def keep(self, name: str, content: bytes) -> "dict[str, object]":
        """Keep what a page sends, and describe it; NameRefusedError if it is no recording by its name."""
        name = PurePosixPath(name).name
        suffix = PurePosixPath(name).suffix.lower()
        if suffix not in RECORDINGS:
            raise NameRefusedError(f"a recording must end in {' or '.join(RECORDINGS)}, got {name[:60]!r}")
        path = Path(self._kept.name, f"{secrets.token_hex(8)}{suffix}")
        path.write_bytes(content)
        while len(self._sent) >= MOST_SENT:
            self._sent.pop(next(iter(self._sent)))[0].unlink()
        number = f"sent:{secrets.token_urlsafe(9)}"
        self._sent[number] = path, name[:LONGEST_TITLE]
        return described(number, name[:LONGEST_TITLE], name)

    def close(self) -> None:
        """Delete what was sent."""
        self._kept.cleanup()


def described(number: str, title: str, name: str, drawings: "list[str] | None" = None) -> dict[str, object]:
    """Describe a recording."""
    kind = "journal" if PurePosixPath(name).suffix.lower() == JOURNAL else "log"
    return {"id": number, "title": title, "kind": kind, "drawings": drawings or []}
