"""Talk to the user: results on standard output, progress and remarks on standard error."""

import contextlib
import io
import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TypeVar

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from pilotage.errors import FileError

Item = TypeVar("Item")


def secure_streams() -> None:
    """Let nothing that is said fail: no letter that the terminal cannot show, no stream that is closed."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:  # closed by the caller
            setattr(sys, name, Path(os.devnull).open("w", encoding="utf-8"))  # noqa: SIM115
        elif isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")


def say(text: str) -> None:
    """Write a remark to standard error; it is lost if that cannot be written to."""
    with contextlib.suppress(OSError):
        sys.stderr.write(text + "\n")
        sys.stderr.flush()


def track(items: Sequence[Item], title: str) -> Iterator[Item]:
    """Go through items, with a bar if standard error is a terminal."""
    console = Console(stderr=True)
    if not console.is_terminal:
        yield from items
        return
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True) as progress:
        yield from progress.track(items, description=title)


@contextmanager
def busy(title: str) -> Iterator[None]:
    """Show that work of unknown length is going on, if standard error is a terminal."""
    console = Console(stderr=True)
    if not console.is_terminal:
        yield
        return
    with console.status(title):
        yield


@contextmanager
def keeping(path: Path | None) -> Iterator[None]:
    """Say that an output is kept, if there is one, when the block is interrupted."""
    try:
        yield
    except KeyboardInterrupt as interrupt:
        if path is not None:
            interrupt.add_note(f"{path} is complete and kept")
        raise


def check_outputs(paths: Iterable[Path | None], *, figure: Path | None = None, force: bool) -> None:
    """Raise FileError if an output cannot be written, before the work is done.

    It exists and must not be replaced, its folder cannot be written to, two outputs are the same file, or a
    figure's name tells no format.
    """
    from pilotage.figures.formats import format_of
    from pilotage.io.files import check_folder, check_replaceable

    if figure is not None:
        format_of(figure)
    seen = set()
    for path in (*paths, figure):
        if path is None:
            continue
        check_replaceable(path)
        check_folder(path)
        if path.exists() and not force:
            raise FileError("an output file is already there, --force replaces it", path)
        real = os.path.realpath(path)
        if real in seen:
            raise FileError("two outputs must not be the same file", path)
        seen.add(real)
