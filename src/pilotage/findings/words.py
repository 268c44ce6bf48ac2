"""Name cells and list words as a person would."""

from pilotage.maps import Cell

LISTED = 3
"""So many words are listed before the rest is counted."""


def named(cell: Cell) -> str:
    """Name a cell as a person would."""
    return repr(cell.label) if cell.label else cell.cell_id


def quoted(words: list[str]) -> str:
    """List words in quotation marks, a few of them if they are many.

    >>> quoted(["Kitchen", "Hall"]), quoted(["a", "b", "c", "d", "e"])
    ("'Kitchen' and 'Hall'", "'a', 'b', 'c' and 2 more")
    """
    shown = [repr(word) for word in (words if len(words) <= LISTED + 1 else words[:LISTED])]
    shown += [f"{len(words) - LISTED} more"] if len(words) > len(shown) else []
    return " and ".join([", ".join(shown[:-1]), shown[-1]]) if len(shown) > 1 else shown[0]
