"""Write files whole or not at all."""

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from pilotage.errors import FileError


@contextmanager
def replacing(path: Path | str) -> Iterator[Path]:
    """Hand out a path beside the target to write to; put it in the target's place once all went well.

    The target's folder is made if it is missing. Raises FileError if the folder cannot be written to.
    """
    target = Path(path)
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.stem}.", suffix=target.suffix)
        os.close(handle)
    except OSError as error:
        raise FileError(f"a file cannot be written ({error.strerror})", target) from error
    beside = Path(name)
    try:
        yield beside
        beside.chmod(0o666 & ~current_umask())
        beside.replace(target)
    except OSError as error:
        raise FileError(f"a file cannot be written ({error.strerror})", target) from error
    finally:
        beside.unlink(missing_ok=True)


def current_umask() -> int:
    """Tell which permissions new files do without."""
    umask = os.umask(0)
    os.umask(umask)
    return umask


def write_text(path: Path | str, text: str) -> None:
    """Write a text file whole or not at all."""
    with replacing(path) as beside:
        beside.write_text(text, encoding="utf-8")
