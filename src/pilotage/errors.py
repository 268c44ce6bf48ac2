"""What can go wrong with what a user hands in."""

from pathlib import Path

LONGEST = 60
"""Letters of a wrong value that a message repeats."""


class PilotageError(Exception):
    """The root of all errors that `pilotage` raises on purpose."""


class FileError(PilotageError):
    """A file is missing, broken, or holds nothing that can be used.

    The message says the rule first and the path last.
    """

    def __init__(self, rule: str, path: Path | str) -> None:
        super().__init__(f"{rule}: {path}")
        self.rule = rule
        self.path = Path(path)

    def __reduce__(self) -> tuple[type["FileError"], tuple[str, Path]]:
        """Let the error pass from one process to another."""
        return type(self), (self.rule, self.path)


class SettingsError(PilotageError, ValueError):
    """A setting is unknown or invalid."""


def shown(value: object) -> str:
    """Write a wrong value for a message, shortened if it is long."""
    try:
        text = repr(value)
    except ValueError:  # Python writes no more than some thousand digits
        return "a number of thousands of digits"
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}..."
