"""The formats of figures; a module of its own, so that no drawing library is loaded to check a name."""

from pathlib import Path

from pilotage.errors import FileError

FORMATS = ("png", "svg", "pdf")


def format_of(path: Path | str) -> str:
    """Tell the format of a figure by the ending of its name; raises FileError if it is none of ours."""
    kind = Path(path).suffix.lstrip(".").lower()
    if kind not in FORMATS:
        raise FileError("a figure's name must end in .png, .svg or .pdf", path)
    return kind
