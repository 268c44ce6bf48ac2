"""Read a page of a PDF file that shows a picture: a scan or a photo."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array, Homography, Polyline
from pilotage.interpretation.sheet import Mark, Sheet, Text
from pilotage.io.pages import choose_page, other_pages
from pilotage.io.pdf.document import PICTURE_SIDE, open_page, opened, page_names, painted
from pilotage.io.pdf.frame import shown_from_content
from pilotage.io.pdf.words import read_texts
from pilotage.maps import Label, SchematicMap

Tracer = Callable[[NDArray[np.float32]], Sheet | SchematicMap]
"""Reads a picture (height, width, 3) of shades from 0 to 1, in pixels."""


@dataclass(frozen=True, slots=True)
class PointsFromPixels:
    """From pixels of a painted page, y up from its upper left corner, to points from the lower left one."""

    scale: float
    height: float  # of the page [points]

    def line(self, line: Polyline) -> Polyline:
        """Carry a line."""
        return Polyline(line.vertices * self.scale + (0.0, self.height), line.closed)

    def mark(self, mark: Mark) -> Mark:
        """Carry a mark."""
        pen = None if mark.pen is None else replace(mark.pen, width=mark.pen.width * self.scale)
        return replace(mark, outlines=tuple(map(self.line, mark.outlines)), pen=pen)

    def homography(self, photo_from_plane: Homography | None) -> Homography | None:
        """Carry the map from straightened paper to the photo of it."""
        if photo_from_plane is None:
            return None
        points: Array = np.array([[self.scale, 0.0, 0.0], [0.0, self.scale, self.height], [0.0, 0.0, 1.0]])
        return Homography.from_matrix(points @ photo_from_plane.matrix @ np.linalg.inv(points))


def read_picture_page(
    path: Path, page: str | None, trace: Tracer, side: int = PICTURE_SIDE
) -> Sheet | SchematicMap:
    """Trace a page that shows a picture, in points from its lower left corner.

    Words that a program has recognized in a scan are read. Raises FileError if the page cannot be read.
    """
    with opened(path) as document:
        names = page_names(document)
        index = choose_page(names, page, path)
        with open_page(document, index, path) as shown:
            width, height = shown.get_size()
            texts = tuple(read_texts(shown, shown_from_content(shown)))
            pixels = painted(shown, side)
    seen = trace(np.asarray(pixels / np.float32(255.0), dtype=np.float32))
    points = PointsFromPixels(max(width, height) / side, height)
    if isinstance(seen, SchematicMap):
        return plan_in_points(seen, points, texts)
    return replace(
        seen,
        marks=tuple(map(points.mark, seen.marks)),
        texts=texts,
        page=(0.0, 0.0, width, height),
        y_down=False,
        photo_from_sheet=points.homography(seen.photo_from_sheet),
        left_out=(*seen.left_out, *other_pages(names, index, path)),
    )


def plan_in_points(plan: SchematicMap, points: PointsFromPixels, texts: tuple[Text, ...]) -> SchematicMap:
    """Carry a plan that was read by its free space to points."""
    return replace(
        plan,
        strokes=tuple(map(points.line, plan.strokes)),
        solids=tuple(map(points.line, plan.solids)),
        labels=tuple(Label(text.text, text.position) for text in texts),
        y_down=False,
    )
