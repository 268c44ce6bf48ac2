"""Open a laser log of any format that can be read."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from pilotage.errors import FileError
from pilotage.io.carmen import BrokenLine, read_carmen
from pilotage.io.files import read_bytes
from pilotage.perception import Odometry, Reading


@dataclass(frozen=True, slots=True)
class Log:
    """The readings of a log in the order of the file, and what had to be left out."""

    readings: tuple[Reading, ...]
    odometry: tuple[Odometry, ...]
    broken_lines: tuple[BrokenLine, ...]

    def __len__(self) -> int:
        """Count the readings."""
        return len(self.readings)

    def __iter__(self) -> Iterator[Reading]:
        """Go through the readings in order."""
        return iter(self.readings)

    @property
    def complaint(self) -> str:
        """One line on what was left out; empty if nothing was."""
        if not self.broken_lines:
            return ""
        count = len(self.broken_lines)
        lines = "1 broken line was" if count == 1 else f"{count} broken lines were"
        return f"{lines} passed over, the first is {self.broken_lines[0]}"


def open_log(path: Path | str) -> Log:
    """Read a laser log: CARMEN text, gzip or plain. See `Log.complaint` for lines that were left out."""
    content = read_bytes(path)
    if not content.strip():
        raise FileError("the file is empty", path)
    log = read_carmen(content.decode("ascii", errors="replace").splitlines())
    if not log.recognized:
        raise FileError("the file is no CARMEN log, the one format of laser logs that can be read", path)
    if not log.readings:
        broken = f"; {log.broken_lines[0]}" if log.broken_lines else ""
        raise FileError(f"the log holds no scan that can be read{broken}", path)
    return Log(log.readings, log.odometry, log.broken_lines)
