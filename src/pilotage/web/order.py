"""What a page sends, checked at the door: drawings, places, and the order to start a drive."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from pilotage.errors import shown
from pilotage.ros.link import Link, Topics

if TYPE_CHECKING:
    from pilotage.config import Settings

SPEEDS = (0.1, 100.0)
"""How many times as fast as real time a drive may go; it does not go faster than it can."""
LARGEST_SEED = 2**32 - 1
LONGEST_NAME = 200
FARTHEST = 1e9
"""Largest coordinate that is taken."""

Place = tuple[float, float] | str
"""A point of the page, or the name of a room."""


class OrderError(ValueError):
    """A message of a page holds something that cannot be meant; the text says what."""


@dataclass(frozen=True, slots=True)
class Sent:
    """A drawing as a page sends it."""

    suffix: str  # of its kind of file
    content: bytes
    hints: bytes = b""  # the table beside it in the folder, TOML; empty if there is none


@dataclass(frozen=True, slots=True)
class MadeRealOrder:
    """The drawing itself, made real."""

    severity: float  # 0 to 1
    seed: int


@dataclass(frozen=True, slots=True)
class RecordingOrder:
    """A log or a journal to be watched."""

    path: Path
    title: str  # what a person calls it
    world: Path | None = None  # in which the robot of a journal drove, if a person says so


@dataclass(frozen=True, slots=True)
class RobotOrder:
    """The robot on the network, as the command line describes it."""

    link: Link
    topics: Topics
    settings: "Settings"


@dataclass(frozen=True, slots=True)
class Order:
    """A drive to begin."""

    title: str
    drawing: Sent
    world: Path | MadeRealOrder | RecordingOrder | RobotOrder
    warp: Path | None = None  # control points of a packed drawing in a packed world: the truth, to be shown
    goal: Place | None = None  # as the drawing marks it if None
    start: tuple[float, ...] | None = None  # x, y and perhaps heading on the page, which the robot is told
    seed: int = 0
    speed: float = 1.0
    paused: bool = False
    settings: "Settings | None" = None  # None for the defaults; a robot on the network has its own


def number(
    message: Mapping[str, object], name: str, low: float, high: float, otherwise: float | None = None
) -> float:
    """Read a number between two others."""
    value = message.get(name, otherwise)
    if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
        raise OrderError(f"{name} must be a number from {low:g} to {high:g}, got {shown(value)}")
    return float(value)


def whole(message: Mapping[str, object], name: str) -> int:
    """Read a seed."""
    value = message.get(name, 0)
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value <= LARGEST_SEED:
        raise OrderError(f"{name} must be a whole number from 0 to {LARGEST_SEED}, got {shown(value)}")
    return value


def switch(message: Mapping[str, object], name: str, *, otherwise: bool) -> bool:
    """Read true or false."""
    value = message.get(name, otherwise)
    if not isinstance(value, bool):
        raise OrderError(f"{name} must be true or false, got {shown(value)}")
    return value


def text(message: Mapping[str, object], name: str) -> str:
    """Read a name."""
    value = message.get(name)
    if not isinstance(value, str) or not 0 < len(value) <= LONGEST_NAME:
        raise OrderError(f"{name} must be a text of 1 to {LONGEST_NAME} letters, got {shown(value)}")
    return value


def numbers(value: object, name: str, counts: tuple[int, ...]) -> tuple[float, ...]:
    """Read a list of numbers, as many as one of `counts`."""
    is_list = isinstance(value, list) and len(value) in counts
    listed = value if is_list and isinstance(value, list) else []
    if not listed or not all(is_coordinate(one) for one in listed):
        raise OrderError(f"{name} must be {' or '.join(map(str, counts))} numbers, got {shown(value)}")
    return tuple(float(one) for one in listed)


def is_coordinate(value: object) -> bool:
    """Tell whether a value is a number that a drawing may hold."""
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return is_number and math.isfinite(float(str(value))) and abs(float(str(value))) <= FARTHEST


def place(value: object, name: str) -> Place:
    """Read a point or the name of a room."""
    if isinstance(value, str) and 0 < len(value.strip()) <= LONGEST_NAME:
        return value.strip()
    x, y = numbers(value, name, (2,))
    return x, y
