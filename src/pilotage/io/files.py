"""Read files whole, and write files whole or not at all."""

import contextlib
import gzip
import io
import os
import re
import stat
import tempfile
import time
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from pilotage.errors import FileError

try:
    import fcntl
except ImportError:  # not a POSIX system: what a killed run left stays until someone deletes it
    fcntl = None  # type: ignore[assignment]

GZIP_MAGIC = b"\x1f\x8b"
LARGEST = 1 << 28
"""The largest file that is read [bytes], after unpacking: two hours of a fast laser."""
TEMPORARY = re.compile(r"\..+\.[a-z0-9_]{8}\.unfinished(\.[^.]*)?")
"""Names of files that are being written."""
LONGEST_NAME = 50
"""Letters of a file's name that its temporary file repeats: file systems limit the length of names."""
LEAST_AGE = 60.0
"""A temporary file younger than this [s] is never deleted: its writer may not have locked it yet."""


def read_bytes(path: Path | str, largest: int = LARGEST) -> bytes:
    """Read a whole file or pipe, unpacked if it is packed.

    Raises FileError if it is missing, is neither a file nor a pipe, or is larger than so many bytes.
    """
    with reading(path):
        mode = Path(path).stat().st_mode
        if stat.S_ISCHR(mode) or stat.S_ISBLK(mode):
            raise FileError("a file is expected, found a device", path)
        with Path(path).open("rb") as file:
            content = file.read(largest + 1)
    if content.startswith(GZIP_MAGIC):
        try:
            content = gzip.GzipFile(fileobj=io.BytesIO(content)).read(largest + 1)
        except (OSError, EOFError, zlib.error) as error:
            raise FileError("the packed file is damaged", path) from error
    if len(content) > largest:
        raise FileError(f"the file is larger than {largest / 1e6:.0f} MB", path)
    return content


@contextmanager
def reading(path: Path | str) -> Iterator[None]:
    """Raise FileError for what may go wrong when a file is opened and read."""
    try:
        yield
    except FileNotFoundError as error:
        raise FileError("there is no such file", path) from error
    except OSError as error:
        raise FileError(f"the file cannot be opened ({error.strerror or error})", path) from error
    except ValueError as error:  # a null byte in the name
        raise FileError(f"the file cannot be opened ({error})", path) from error


def check_regular(path: Path) -> None:
    """Reject a pipe, which would block, and a device, which may never end."""
    with reading(path):
        if path.exists() and not path.is_file() and not path.is_dir():
            raise FileError("a regular file is expected, found a pipe or a device", path)


@contextmanager
def replacing(path: Path | str, *, keeps_partial: bool = False) -> Iterator[Path]:
    """Yield a path to write to, and put the file in the target's place once all went well.

    The target's folder is made if it is missing. Only regular files are replaced; a link stays, and the file
    that it points to is replaced. With `keeps_partial`, a file that Ctrl-C or a signal interrupts is kept as
    `name.partial.suffix`, which is said in a note of the KeyboardInterrupt.
    Raises FileError if the target cannot be written, or is a folder, a pipe or a device.
    """
    check_replaceable(Path(path))
    with writing(path):
        target = Path(os.path.realpath(path))
        prefix = f".{target.name[:LONGEST_NAME]}."
        target.parent.mkdir(parents=True, exist_ok=True)
        delete_abandoned(target.parent, prefix)
        suffix = f".unfinished{target.suffix[:LONGEST_NAME]}"
        handle, name = tempfile.mkstemp(dir=target.parent, prefix=prefix, suffix=suffix)
    beside = Path(name)
    try:
        lock(handle)
        with writing(path):
            yield beside
            put(beside, target)
    except KeyboardInterrupt as interrupt:
        if keeps_partial:
            keep_partial(beside, Path(path), interrupt)
        raise
    finally:
        os.close(handle)
        beside.unlink(missing_ok=True)


@contextmanager
def writing(path: Path | str) -> Iterator[None]:
    """Raise FileError for what may go wrong when a file is written."""
    try:
        yield
    except OSError as error:
        raise FileError(f"a file cannot be written ({error.strerror or error})", path) from error


def put(beside: Path, target: Path) -> None:
    """Put a temporary file in its place, with the permissions of a new file."""
    beside.chmod(0o666 & ~current_umask())
    beside.replace(target)


def check_replaceable(path: Path) -> None:
    """Reject an output that exists and is not a regular file."""
    with writing(path):
        if path.exists() and not path.is_file():
            raise FileError("only regular files are replaced, not folders, pipes or devices", path)


def check_folder(path: Path) -> None:
    """Raise FileError if a file cannot be made in its folder, or its missing folder in the one above."""
    folder = next(folder for folder in path.absolute().parents if folder.exists())
    if not folder.is_dir():
        raise FileError(f"a file cannot be written ({folder.name} is no folder)", path)
    if not os.access(folder, os.W_OK | os.X_OK):
        raise FileError("a file cannot be written (Permission denied)", path)


def keep_partial(beside: Path, path: Path, interrupt: KeyboardInterrupt) -> None:
    """Keep what was written before an interruption, under the first name that is free."""
    if beside.exists() and beside.stat().st_size:
        names = (f"{path.stem}.partial{number}{path.suffix}" for number in ("", *range(2, 100)))
        kept = next((path.with_name(name) for name in names if not path.with_name(name).exists()), None)
        if kept is not None:
            put(beside, kept)
            interrupt.add_note(f"what was written so far is kept in {kept}")


def is_temporary(path: Path) -> bool:
    """Tell whether a file is one that is being written, or was when its program was killed."""
    return TEMPORARY.fullmatch(path.name) is not None


def delete_abandoned(folder: Path, prefix: str) -> None:
    """Delete the temporary files of this prefix that killed programs left in a folder."""
    for path in folder.iterdir():
        if path.name.startswith(prefix) and is_temporary(path):
            with contextlib.suppress(OSError):
                delete_if_abandoned(path)


def delete_if_abandoned(path: Path) -> None:
    """Delete a temporary file that is not young, and that nobody holds a lock on."""
    if time.time() - path.stat().st_mtime < LEAST_AGE:
        return
    handle = os.open(path, os.O_RDWR)
    try:
        if lock(handle):
            path.unlink()
    finally:
        os.close(handle)


def lock(handle: int) -> bool:
    """Lock a temporary file while it is being written; False if another program holds the lock."""
    if fcntl is None:
        return False
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:  # locked, or a file system without locks
        return False
    return True


def current_umask() -> int:
    """Return the permissions that new files do not get."""
    umask = os.umask(0)
    os.umask(umask)
    return umask


def write_text(path: Path | str, text: str) -> None:
    """Write a text file whole or not at all."""
    with replacing(path) as beside:
        beside.write_text(text, encoding="utf-8")
