"""What the command lines of several benchmarks have in common."""

import argparse
import math
from collections.abc import Callable, Collection
from pathlib import Path

from sites import BUILDINGS, HANDS


def add_drawings(parser: argparse.ArgumentParser) -> None:
    """Let the user choose drawings of buildings, and where figures go."""
    parser.add_argument("--json", type=Path, help="write the figures here")
    for name, known in (("--buildings", BUILDINGS), ("--hands", HANDS)):
        parser.add_argument(
            name, type=names_of(known), default=",".join(known), help="(default: %(default)s)"
        )


def names_of(known: Collection[str]) -> Callable[[str], list[str]]:
    """Read names, parted by commas, of those that are known; for `type` of an argument."""

    def read(text: str) -> list[str]:
        names = text.split(",")
        if not set(names) <= set(known):
            raise argparse.ArgumentTypeError(f"must be of {', '.join(known)}, got {text}")
        return names

    return read


def positive(text: str) -> int:
    """Read a whole number from 1 on."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"must be a whole number >= 1, got {text}")
    return int(text)


def seconds(text: str) -> float:
    """Read a time [s] that lasts."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"must be a number > 0 [s], got {text}")
    return value
