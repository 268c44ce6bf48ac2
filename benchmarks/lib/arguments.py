"""What the command lines of several benchmarks have in common."""

import argparse
import math
from collections.abc import Callable, Collection, Sequence

from benchmarks.lib.data import BUILDINGS, HANDS


def add_drawings(
    parser: argparse.ArgumentParser,
    buildings: Sequence[str] = BUILDINGS,
    hands: Sequence[str] = HANDS,
    *,
    known_hands: Sequence[str] = HANDS,
) -> None:
    """Let the user choose drawings of buildings."""
    add_names(parser, "--buildings", buildings, known=BUILDINGS)
    add_names(parser, "--hands", hands, known=known_hands)


def add_names(
    parser: argparse.ArgumentParser,
    option: str,
    default: Sequence[str],
    *,
    known: Collection[str] | None = None,
) -> None:
    """Let the user choose names from those that are known: if not told, those by default."""
    parser.add_argument(
        option, type=names_of(known or default), default=",".join(default), help="(default: %(default)s)"
    )


def add_jobs(parser: argparse.ArgumentParser) -> None:
    """Let the user choose the number of processes."""
    parser.add_argument(
        "--jobs", type=positive, default=2, help="processes; 1 for exact times (default: %(default)s)"
    )


def names_of(known: Collection[str]) -> Callable[[str], list[str]]:
    """Read names separated by commas, all of which must be known; for `type` of an argument."""

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
    """Read a positive, finite time [s]."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"must be a number > 0 [s], got {text}")
    return value
