"""The drawings in a folder: listed, read and written whole, and nothing outside of it."""

import hashlib
import itertools
import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

DRAWINGS = (".svg", ".excalidraw")
"""Kinds of files that can be drawn on."""
WORLDS = (".yaml", ".yml", ".svg")
"""Kinds of files that may hold a world to drive in."""
TABLE = ".toml"
"""Added to the name of a drawing, it is the name of the table beside it."""
JOURNAL = ".jsonl"
RECORDINGS = (".log", ".gz", ".clf", ".bag", ".mcap", JOURNAL)
"""Kinds of files that may hold a laser log, or the journal of a drive."""
DEEPEST = 4
"""Folders are looked through this far down."""
MOST = 500
"""Files that are listed."""
LONGEST = 200
"""Letters of a name."""
LONGEST_STEM = 60
"""Letters of a name that is made up, of four bytes at most: disks take 255 bytes with number and ending."""


class NameRefusedError(ValueError):
    """A name leads out of the folder, or is not the name of a drawing."""


class ChangedError(Exception):
    """A file is not the version that was to be replaced; `tag` is what is there, None if nothing is."""

    def __init__(self, tag: str | None) -> None:
        super().__init__(tag)
        self.tag = tag


@dataclass(frozen=True, slots=True)
class Folder:
    """A folder of drawings."""

    root: Path

    def path(self, name: str, suffixes: tuple[str, ...] = DRAWINGS) -> Path:
        """Find where a file of this name is or would be; NameRefusedError if that may not be.

        Links are followed first: one that points out of the folder is refused too.
        """
        parts = PurePosixPath(name).parts
        is_plain = all(not part.startswith(".") and part.isprintable() for part in parts)
        if not parts or "\\" in name or name.startswith("/") or not is_plain or len(name) > LONGEST:
            raise NameRefusedError(f"a name must stay in the folder and not begin with a dot, got {name!r}")
        if PurePosixPath(name).suffix.lower() not in suffixes:
            raise NameRefusedError(f"a name must end in {' or '.join(suffixes)}, got {name!r}")
        real = Path(os.path.realpath(self.root.joinpath(*parts)))
        if not real.is_relative_to(os.path.realpath(self.root)):
            raise NameRefusedError(f"a name must stay in the folder, got {name!r}")
        return real

    def names(self, suffixes: tuple[str, ...] = DRAWINGS) -> list[str]:
        """List the files of these kinds, in order."""
        return sorted(self._walk(suffixes))[:MOST]

    def read(self, name: str) -> tuple[bytes, str]:
        """Read a drawing and its tag; FileNotFoundError if there is none."""
        content = self.path(name).read_bytes()
        return content, tag_of(content)

    def hints(self, name: str) -> bytes:
        """Read the table beside a drawing; nothing if there is none in the folder."""
        self.path(name)
        try:
            return self.path(name + TABLE, (TABLE,)).read_bytes()
        except (FileNotFoundError, NameRefusedError):
            return b""

    def write(self, name: str, content: bytes, replaces: str | None) -> str:
        """Write a drawing in place of the version with this tag, or of none, and return its tag.

        Raises ChangedError if something else is there.
        """
        from pilotage.io.files import replacing

        path = self.path(name)
        present = tag_of(path.read_bytes()) if path.exists() else None
        if present != replaces:
            raise ChangedError(present)
        with replacing(path) as beside:
            beside.write_bytes(content)
        return tag_of(content)

    def free_name(self, stem: str, suffix: str = ".svg") -> str:
        """Make a name of which there is no file yet."""
        letters = (letter if letter.isalnum() or letter in "-_ " else "-" for letter in stem[:LONGEST_STEM])
        plain = "".join(letters).strip(" -") or "drawing"
        numbers = itertools.chain([""], (f"-{k}" for k in itertools.count(2)))
        names = (f"{plain}{number}{suffix}" for number in numbers)
        return next(name for name in names if not (self.root / name).exists())

    def _walk(self, suffixes: tuple[str, ...]) -> Iterator[str]:
        """Go through the folder and those in it; links to elsewhere and hidden files are left out."""
        for where, folders, files in os.walk(self.root):
            below = Path(where).relative_to(self.root)
            folders[:] = [] if len(below.parts) >= DEEPEST else [one for one in folders if one[:1] != "."]
            for file in files:
                name = (below / file).as_posix()
                try:
                    if self.path(name, suffixes).is_file():
                        yield name
                except NameRefusedError:
                    continue


def tag_of(content: bytes) -> str:
    """Make a tag that changes with the content."""
    return hashlib.sha256(content).hexdigest()[:20]
