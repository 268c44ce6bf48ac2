"""Open a bag, and go through its messages one at a time."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pilotage.errors import FileError

SCAN_TYPE = "sensor_msgs/msg/LaserScan"
ODOMETRY_TYPE = "nav_msgs/msg/Odometry"
TRANSFORM_TYPES = ("tf2_msgs/msg/TFMessage", "tf/msg/tfMessage")

MAGIC = {b"#ROSBAG V": ".bag", b"SQLite format 3\0": ".db3", b"\x89MCAP0\r\n": ".mcap"}
"""How files of bags begin, and how their names must end."""


@dataclass(frozen=True, slots=True)
class Message:
    """One message of a bag, unpacked when its body is asked for."""

    topic: str
    type_name: str
    recorded: float  # [s] when it was recorded
    raw: bytes
    reader: Any

    @property
    def body(self) -> Any:  # noqa: ANN401  # types of ROS are made at run time
        """The message as rosbags makes it."""
        return self.reader.deserialize(self.raw, self.type_name)


def suffix_by_content(path: Path) -> str | None:
    """Return what the name of a bag's file should end in; None if the file is no bag.

    What is read of a pipe is gone, so that pipes are not looked at.
    """
    if not path.is_file():
        return None
    try:
        with path.open("rb") as file:
            head = file.read(16)
    except OSError:
        return None
    return next((suffix for magic, suffix in MAGIC.items() if head.startswith(magic)), None)


def files_of(path: Path) -> list[Path]:
    """Return what rosbags is to open: a file, a rosbag2 folder, or the files of a folder without metadata."""
    if not path.is_dir() or (path / "metadata.yaml").exists():
        return [path]
    found = sorted(one for one in path.iterdir() if one.is_file() and one.suffix in MAGIC.values())
    kinds = {one.suffix for one in found}
    if len(kinds) != 1:
        which = "none" if not kinds else " and ".join(sorted(kinds))
        raise FileError(f"a folder must hold bags of one kind (.bag, .db3 or .mcap), found {which}", path)
    return found


class Bag:
    """An open bag."""

    def __init__(self, reader: Any) -> None:  # noqa: ANN401  # rosbags is imported late
        self._reader = reader

    def topics(self, *type_names: str) -> dict[str, int]:
        """Return the topics of these types by name, and how many messages each holds."""
        found: dict[str, int] = {}
        for one in self._reader.connections:
            if one.msgtype in type_names:
                found[one.topic] = found.get(one.topic, 0) + one.msgcount
        return dict(sorted(found.items()))

    def messages(self, topics: Sequence[str]) -> Iterator[Message]:
        """Go through the messages of these topics in the order of their recording."""
        chosen = [one for one in self._reader.connections if one.topic in topics]
        if not chosen:  # rosbags would take all
            return
        for connection, stamp_ns, raw in self._reader.messages(connections=chosen):
            yield Message(connection.topic, connection.msgtype, stamp_ns / 1_000_000_000, raw, self._reader)


@contextmanager
def opened(path: Path) -> Iterator[Bag]:
    """Open a bag while the block runs; raise FileError for whatever is wrong with it."""
    from rosbags.highlevel import AnyReader
    from rosbags.typesys import Stores, get_typestore

    try:
        reader = AnyReader(files_of(path), default_typestore=get_typestore(Stores.ROS2_HUMBLE))
        with reader:
            yield Bag(reader)
    except (FileError, MemoryError):
        raise
    except FileNotFoundError as error:
        raise FileError("there is no such bag, or a file of it is missing", path) from error
    except Exception as error:  # whatever a parser of others makes of a damaged file
        what = " ".join(str(error).split())[:120] or type(error).__name__
        raise FileError(f"the bag cannot be read ({what})", path) from error
