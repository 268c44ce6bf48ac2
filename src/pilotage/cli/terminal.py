"""Talk to whoever called: progress and remarks on stderr, results on stdout."""

import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TypeVar

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from pilotage.errors import FileError

Item = TypeVar("Item")


def say(text: str) -> None:
    """Write a remark for a person."""
    sys.stderr.write(text + "\n")


def track(items: Sequence[Item], title: str) -> Iterator[Item]:
    """Go through items, with a bar if a person is watching."""
    console = Console(stderr=True)
    if not console.is_terminal:
        yield from items
        return
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True) as progress:
        yield from progress.track(items, description=title)


@contextmanager
def busy(title: str) -> Iterator[None]:
    """Show that something of unknown length goes on, if a person is watching."""
    console = Console(stderr=True)
    if not console.is_terminal:
        yield
        return
    with console.status(title):
        yield


def refuse_existing(paths: Iterable[Path | None], *, force: bool) -> None:
    """Raise FileError if an output is already there and must not be replaced."""
    for path in paths:
        if path is not None and not force and path.exists():
            raise FileError("an output file is already there, --force replaces it", path)
