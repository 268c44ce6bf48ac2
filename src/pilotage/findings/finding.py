"""One thing that looks wrong with a drawing."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum

import numpy as np

from pilotage.geometry import Array
from pilotage.maps import SchematicMap

Point = tuple[float, float]

DIGITS, MOST_DECIMALS, LEAST = 4, 8, 1e-9
"""Significant digits of a number in a sentence, digits behind the point, and what is as good as nothing."""


class Severity(Enum):
    """How much a finding matters, the worst first."""

    ERROR = "error"  # the drawing, its start or its goal cannot be used
    WARNING = "warning"  # probably not what was meant
    NOTE = "note"  # worth knowing


class MendKind(Enum):
    """What a pen would do."""

    CUT = "cut"  # cut the walls along the segment: a door
    CLOSE = "close"  # draw the segment: a wall


@dataclass(frozen=True, slots=True)
class Mend:
    """A change of the drawing that would settle a finding."""

    kind: MendKind
    segment: tuple[Point, Point]  # in the axes of the drawing's file
    words: str  # a question: "cut a door here?"


@dataclass(frozen=True, slots=True)
class Finding:
    """What looks wrong, where, why, and what to do."""

    kind: str  # one of a few, in the manner of "room-without-door": docs/reference/findings.md lists them
    severity: Severity
    text: str  # what is wrong, and why, as half a sentence
    advice: str  # what to do about it, as half a sentence
    where: Point | None = None  # in the axes of the drawing's file; None if it is about the whole
    cell_ids: tuple[str, ...] = ()  # the cells that it is about
    mend: Mend | None = None

    def __str__(self) -> str:
        """Write it in one line."""
        place = "" if self.where is None else f" at {in_words(self.where)}"
        return f"{self.severity.value}{place}: {self.text}; {self.advice}"

    @property
    def as_json(self) -> dict[str, object]:
        """The finding as nested dictionaries, as `pilotage check --json` prints it."""
        mend = self.mend and {
            "kind": self.mend.kind.value,
            "text": self.mend.words,
            "segment": [list(point) for point in self.mend.segment],
        }
        return {
            "kind": self.kind,
            "severity": self.severity.value,
            "text": self.text,
            "advice": self.advice,
            "where": None if self.where is None else list(self.where),
            "cells": list(self.cell_ids),
            "mend": mend,
        }

    def in_file(self, sketch: SchematicMap) -> "Finding":
        """Carry the points from the sketch to the axes of the drawing's file."""
        where = None if self.where is None else carried(sketch, [self.where])[0]
        if self.mend is None:
            return replace(self, where=where)
        first, second = carried(sketch, self.mend.segment)
        return replace(self, where=where, mend=replace(self.mend, segment=(first, second)))


def carried(sketch: SchematicMap, points: Sequence[Point]) -> list[Point]:
    """Carry points of the sketch to the axes of its file."""
    return [pair(point) for point in sketch.file_from_sketch(np.array(points, dtype=np.float64))]


def pair(point: Array) -> Point:
    """Write a point (2,) as a pair."""
    x, y = point.tolist()
    return x, y


def in_words(point: Point) -> str:
    """Write a point as one types it.

    >>> in_words((120.04, -17280.3))
    '120,-17280'
    """
    return ",".join(map(length_in_words, point))


def length_in_words(value: float) -> str:
    """Write a number of drawing units with a few digits, and never as a power of ten.

    >>> length_in_words(0.1234567), length_in_words(17280.3)
    ('0.1235', '17280')
    """
    digits = DIGITS - 1 - math.floor(math.log10(max(abs(value), LEAST)))
    return (
        np.format_float_positional(round(value, min(digits, MOST_DECIMALS)), trim="-")
        if digits > 0
        else f"{value:.0f}"
    )


def worst(findings: Sequence[Finding]) -> Finding | None:
    """Return the first of the worst findings; None if there are but notes."""
    for severity in (Severity.ERROR, Severity.WARNING):
        for finding in findings:
            if finding.severity is severity:
                return finding
    return None
