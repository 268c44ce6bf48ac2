"""Open a laser log of any format that can be read."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from pilotage.errors import FileError
from pilotage.io.carmen import KNOWN_MESSAGES, BrokenLine, read_carmen
from pilotage.io.files import read_bytes
from pilotage.perception import Reading

SNIFFED = 1 << 20
"""Bytes of a text in which a log shows itself."""


@dataclass(frozen=True, slots=True)
class Log:
    """The readings of a log in the order of the file, and what had to be left out.

    The readings of a bag are read from its file whenever they are gone through.
    """

    readings: Sequence[Reading]
    broken_lines: tuple[BrokenLine, ...] = ()
    remarks: tuple[str, ...] = ()  # on what is odd about a bag, and what was assumed

    def __len__(self) -> int:
        """Count the readings."""
        return len(self.readings)

    def __iter__(self) -> Iterator[Reading]:
        """Go through the readings in order."""
        return iter(self.readings)

    @property
    def complaint(self) -> str:
        """One line on what was left out or assumed; empty if nothing was."""
        told = list(self.remarks)
        if self.broken_lines:
            count = len(self.broken_lines)
            lines = "1 broken line was" if count == 1 else f"{count} broken lines were"
            told.append(f"{lines} passed over, the first is {self.broken_lines[0]}")
        return "; ".join(told)


def is_log(path: Path | str) -> bool:
    """Tell whether a file or folder is a laser log; raise FileError if it cannot be read."""
    from pilotage.io.bags import is_bag
    from pilotage.io.breezy import is_breezy

    if is_bag(Path(path)):
        return True
    lines = read_bytes(path)[:SNIFFED].decode("ascii", errors="replace").splitlines()
    return any(is_breezy(line) or line.split(" ", 1)[0] in KNOWN_MESSAGES for line in lines)


def open_log(path: Path | str, *, scan_topic: str | None = None, odometry_topic: str | None = None) -> Log:
    """Read a laser log: a ROS 1 or ROS 2 bag, CARMEN text or BreezySLAM text, both packed or plain.

    Topics of a bag are found by their types if they are not named. See `Log.complaint` for what was left out.
    """
    from pilotage.io.bags import is_bag, read_bag

    if is_bag(Path(path)):
        bag = read_bag(Path(path), scan_topic, odometry_topic)
        return Log(bag.readings, remarks=bag.remarks)
    for topic in (scan_topic, odometry_topic):
        if topic is not None:
            raise FileError(f"only bags have topics, {topic} cannot be chosen", path)
    return read_text_log(path)


def read_text_log(path: Path | str) -> Log:
    """Read CARMEN or BreezySLAM text."""
    from pilotage.io.breezy import is_breezy, read_breezy

    content = read_bytes(path)
    if not content.strip():
        raise FileError("the file is empty", path)
    lines = content.decode("ascii", errors="replace").splitlines()
    if any(is_breezy(line) for line in lines[:3]):
        breezy = read_breezy(lines)
        return Log(breezy.readings, breezy.broken_lines)
    log = read_carmen(lines)
    if not log.recognized:
        raise FileError("the file is no laser log: no bag of ROS, no CARMEN or BreezySLAM text", path)
    if not log.readings:
        broken = f"; {log.broken_lines[0]}" if log.broken_lines else ""
        raise FileError(f"the log holds no scan that can be read{broken}", path)
    return Log(log.readings, log.broken_lines)
