"""Which page, floor or level of a file is meant."""

from collections.abc import Sequence
from pathlib import Path

from pilotage.errors import FileError

MOST_NAMES = 12
"""Pages that a message lists."""


def choose_page(names: Sequence[str], page: str | None, path: Path, *, kind: str = "page") -> int:
    """Return the index of a page given by its name, or by its number from 1; the first if none is given.

    Raises FileError if there is no such page.

    >>> choose_page(["Ground floor", "Top floor"], "top floor", Path("a.drawio"))
    1
    """
    if page is None:
        return 0
    for key in (str, str.casefold):
        found = [k for k, name in enumerate(names) if name and key(name) == key(page)]
        if found:
            return found[0]
    if page.isdecimal() and kind == "page" and 1 <= int(page) <= len(names):
        return int(page) - 1
    listed = ", ".join(name or str(k) for k, name in enumerate(names[:MOST_NAMES], start=1))
    raise FileError(f"there is no {kind} {page!r}, choose one of {listed}", path)


def other_pages(names: Sequence[str], chosen: int, path: Path, *, kind: str = "page") -> list[str]:
    """Say which pages are not shown, and how to get them: at most one remark."""
    others = [name or str(k + 1) for k, name in enumerate(names) if k != chosen]
    if not others:
        return []
    listed = ", ".join(others[:MOST_NAMES]) + (", ..." if len(others) > MOST_NAMES else "")
    return [f"other {kind}s ({len(others)}): {listed}; choose one by {path.name}#{others[0]}"]
