"""Places as a user types them: a point, a word, a pose."""

import math
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from collections.abc import Iterable

    from pilotage.maps import CellGraph, SchematicMap
    from pilotage.maps.routing.roadmap import Point


FARTHEST = 1e9
"""Largest number that is accepted: no drawing is larger."""


def find_place(words: str, sketch: "SchematicMap", graph: "CellGraph") -> "Point":
    """Read `X,Y` in the axes of the drawing's file, or find the cell that bears a label."""
    import numpy as np

    from pilotage.maps import find_labeled

    numbers = finite_numbers(words)
    if len(numbers) != 2:
        return find_labeled(graph, words)
    x, y = sketch.sketch_from_file(np.array([numbers]))[0].tolist()
    return x, y


def parse_goals(words: str, labels: "Iterable[str]") -> "list[Point | str]":
    """Read goals between commas: words of the drawing, and points as two numbers.

    >>> parse_goals("kitchen, 310,120,201", ["Kitchen", "201"])
    ['kitchen', (310.0, 120.0), '201']
    """
    from pilotage.maps.routing.places import folded

    known = {folded(label) for label in labels}
    if folded(words) in known:
        return [words.strip()]
    tokens = [token.strip() for token in words.split(",")]
    goals: list[Point | str] = []
    while tokens:
        numbers = finite_numbers(",".join(tokens[:2]))
        if len(numbers) == 2 and folded(tokens[0]) not in known:
            goals.append((numbers[0], numbers[1]))
            del tokens[:2]
        else:
            goals.append(tokens.pop(0))
    return goals


def parse_pose(words: str, option: str) -> tuple[float, float, float]:
    """Read `X,Y,HEADING_DEG`; the heading comes in radians."""
    numbers = finite_numbers(words)
    if len(numbers) != 3:
        raise typer.BadParameter(
            f"a start must be three numbers X,Y,HEADING_DEG, got {words!r}", param_hint=option
        )
    x, y, heading_deg = numbers
    return x, y, math.radians(heading_deg)


def finite_numbers(words: str) -> list[float]:
    """Read numbers between commas; none if one of them is not a number, or beyond `FARTHEST`.

    >>> finite_numbers("1,-2.5"), finite_numbers("nan,1"), finite_numbers("kitchen")
    ([1.0, -2.5], [], [])
    """
    try:
        numbers = [float(word) for word in words.split(",")]
    except ValueError:
        return []
    return numbers if all(abs(number) <= FARTHEST for number in numbers) else []
