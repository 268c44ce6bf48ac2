"""Write prose and tables of Markdown."""

import textwrap
from collections.abc import Iterable, Sequence

WIDTH = 120


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Write a table.

    >>> print(table(("what", "figure"), [("a", "1")]))
    | what | figure |
    |---|---|
    | a | 1 |
    """
    lines = [head, *rows]
    written = [f"| {' | '.join(cells)} |" for cells in lines]
    return "\n".join([written[0], "|---" * len(head) + "|", *written[1:]])


def percent(share: float | None, digits: int = 0) -> str:
    """Write a share, a dash if there is none.

    >>> percent(0.823), percent(0.0221, 1), percent(None)
    ('82 %', '2.2 %', '-')
    """
    return "-" if share is None else f"{100.0 * share:.{digits}f} %"


def percent_in(share: float, interval: Sequence[float]) -> str:
    """Write a share with its interval.

    >>> percent_in(0.81, (0.67, 0.92))
    '81 % [67, 92]'
    """
    low, high = interval
    return f"{percent(share)} [{100.0 * low:.0f}, {100.0 * high:.0f}]"


def number(value: float | None, digits: int = 1) -> str:
    """Write a number, a dash if there is none."""
    return "-" if value is None else f"{value:.{digits}f}"


def prose(text: str) -> str:
    """Break a text into lines, whatever its line breaks were.

    >>> prose("One   two.")
    'One two.'
    """
    return textwrap.fill(" ".join(text.split()), WIDTH)
