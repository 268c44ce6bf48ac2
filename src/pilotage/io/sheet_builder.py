"""Collect what a reader finds into a Sheet, within bounds."""

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from itertools import count
from pathlib import Path

import numpy as np
import shapely
from numpy.typing import ArrayLike

from pilotage.errors import FileError
from pilotage.geometry import Polyline
from pilotage.interpretation.sheet import WHITE, Bounds, Color, Mark, Pen, Sheet, Text

MOST_MARKS = 100_000
"""Shapes and texts of one drawing: the plan of a large hospital has 50,000."""

MOST_VERTICES = 2_000_000
"""Vertices of one drawing, curves cut into chords."""

FARTHEST = 1e9
"""Largest coordinate that is accepted [drawing units]: beyond it, areas and lengths lose their digits."""

LONGEST_TEXT = 1000
"""Letters of one text that are kept: no room has a longer name."""

SAME_POINT = 1e-9
"""Points closer than this share of a shape's size are one point."""


@dataclass
class SheetBuilder:
    """A sheet in the making."""

    path: Path
    y_down: bool = False
    marks: list[Mark] = field(default_factory=list)
    texts: list[Text] = field(default_factory=list)
    openings: list[Polyline] = field(default_factory=list)
    left_out: Counter[str] = field(default_factory=Counter)
    _vertices: int = 0
    _groups: Iterator[int] = field(default_factory=lambda: count(1))

    def new_group(self) -> int:
        """Return the number of a new group."""
        return next(self._groups)

    def add_mark(
        self,
        outlines: Iterable[Polyline | None],
        *,
        pen: Pen | None,
        fill: Color | None = None,
        names: Sequence[str] = (),
        groups: Sequence[int] = (),
        source: str = "",
    ) -> None:
        """Add a shape, unless nothing of it can be seen.

        Raises FileError if the drawing has become too large.
        """
        kept = tuple(outline for outline in outlines if outline is not None)
        if not kept or (pen is None and fill is None):
            return
        if any(np.abs(outline.vertices).max() > FARTHEST for outline in kept):
            self.leave_out("shapes beyond all bounds")
            return
        self._vertices += sum(map(len, kept))
        if self._vertices > MOST_VERTICES:
            raise FileError(f"a drawing must have at most {MOST_VERTICES:,} vertices, found more", self.path)
        if pen is not None and not 0.0 <= pen.width < math.inf:
            pen = replace(pen, width=0.0)  # an impossible width: a hairline
        self.marks.append(Mark(kept, pen, fill, plain_names(names), tuple(groups), source))
        self._check_size()

    def add_text(self, text: Text) -> None:
        """Add words, unless they are empty or nowhere."""
        words = " ".join(text.text.split())[:LONGEST_TEXT]
        numbers = np.array([*text.position, text.height, text.angle])
        if words and np.isfinite(numbers).all() and np.abs(numbers).max() <= FARTHEST:
            names = plain_names(text.names)
            self.texts.append(
                Text(words, text.position, text.height, text.angle, names, text.groups, text.source)
            )
            self._check_size()

    def add_opening(self, line: Polyline | None) -> None:
        """Add a door that the file tells, a line from jamb to jamb."""
        if line is not None and np.abs(line.vertices).max() <= FARTHEST:
            self.openings.append(line)

    def leave_out(self, what: str, number: int = 1) -> None:
        """Count what cannot be read; `what` is a plural, such as "embedded pictures"."""
        self.left_out[what] += number

    @contextmanager
    def surviving(self, what: str) -> Iterator[None]:
        """Leave out what a library cannot work with, and go on."""
        try:
            with np.errstate(all="ignore"):
                yield
        except (FileError, MemoryError):
            raise
        except Exception:  # noqa: BLE001  # a damaged shape may raise anything inside a library
            self.leave_out(what)

    def build(
        self,
        *,
        page: Bounds | None = None,
        background: Color = WHITE,
        metres_per_unit: float | None = None,
        remarks: Iterable[str] = (),
    ) -> Sheet:
        """Return the sheet; the file may say more about itself.

        Raises FileError if the sheet is empty.
        """
        left_out = (*(f"{what} ({number:,})" for what, number in sorted(self.left_out.items())), *remarks)
        if not self.marks:
            reason = f" (left out: {', '.join(left_out)})" if left_out else ""
            raise FileError(f"a drawing needs at least one visible stroke, found none{reason}", self.path)
        return Sheet(
            tuple(self.marks),
            tuple(self.texts),
            page=page,
            background=background,
            metres_per_unit=metres_per_unit,
            y_down=self.y_down,
            source=str(self.path),
            openings=tuple(self.openings),
            left_out=left_out,
        )

    def _check_size(self) -> None:
        if len(self.marks) + len(self.texts) > MOST_MARKS:
            raise FileError(f"a drawing must have at most {MOST_MARKS:,} shapes, found more", self.path)


def outline_through(points: ArrayLike, *, closed: bool = False) -> Polyline | None:
    """Join points (n, 2), repeated ones once; None if they are one point or not all are finite.

    >>> outline_through([(0, 0), (1, 0), (1, 0), (1, 1), (0, 0)])
    Polyline(vertices=array([[0., 0.],
           [1., 0.],
           [1., 1.]]), closed=True)
    """
    vertices = np.asarray(points, dtype=np.float64).reshape(-1, 2)
    if len(vertices) == 2:  # most shapes of large drawings
        first, last = vertices.tolist()
        return Polyline(vertices) if first != last and math.isfinite(sum(first) + sum(last)) else None
    if len(vertices) < 2 or not np.isfinite(vertices).all():
        return None
    grain = SAME_POINT * float((vertices.max(axis=0) - vertices.min(axis=0)).max())
    moves = np.abs(vertices[1:] - vertices[:-1]).max(axis=1) > grain
    if not moves.all():
        vertices = vertices[np.concatenate([[True], moves])]
    if len(vertices) > 2 and np.abs(vertices[0] - vertices[-1]).max() <= grain:
        vertices, closed = vertices[:-1], True
    if len(vertices) < 2:
        return None
    return Polyline(vertices, closed and len(vertices) > 2)


def outlines_of_area(area: shapely.Geometry) -> list[Polyline]:
    """List the rings around the polygons of an area and around their holes."""
    polygons = [part for part in shapely.get_parts(area) if part.geom_type == "Polygon"]
    rings = [ring for polygon in polygons for ring in (polygon.exterior, *polygon.interiors)]
    found = [outline_through(shapely.get_coordinates(ring), closed=True) for ring in rings]
    return [outline for outline in found if outline is not None]


def plain_names(names: Iterable[str]) -> tuple[str, ...]:
    """Leave out empty names and those that repeat the one before."""
    kept: list[str] = []
    for name in names:
        if name and name not in kept[-1:]:
            kept.append(name)
    return tuple(kept)
