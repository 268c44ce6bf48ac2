"""Read a drawing that a page sent, and tell a drawing to a page; both in a worker."""

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias
from xml.sax.saxutils import escape

import numpy as np
import shapely

from pilotage.errors import FileError, PilotageError
from pilotage.geometry import Array, Polyline
from pilotage.interpretation import ZONE_ROLES, Role
from pilotage.maps import DecompositionSettings, NotEnclosedError, SchematicMap, decompose
from pilotage.web.order import Sent

if TYPE_CHECKING:
    from pilotage.io.maps import Drawing

Json: TypeAlias = dict[str, object]
Rows: TypeAlias = list[list[float]]

DIGITS = 4
"""Decimals of coordinates on a drawing whose diagonal is 1."""

STROKE = 1.0 / 400.0
"""Width of the strokes of a drawing that was made of an upload, as a share of its diagonal."""
LETTERS = 6.0
"""Height of its letters, in widths of a stroke: larger ones of neighboring rooms would run together."""
ZONES = tuple(role.value for role in ZONE_ROLES)
"""Names of the kinds of zones, in their order."""
MOST_FURNITURE = 1_500
"""Lines of furniture that are shown on the sheet, at most: with more of them the editor is slow."""


class UnreadableError(PilotageError):
    """A drawing cannot be read; the message says why, without the name of a file that the user never saw."""


def read_sent(sent: Sent) -> "Drawing":
    """Read a drawing with what the table beside it says; UnreadableError if that fails."""
    from pilotage.io.hints import read_hints
    from pilotage.io.maps import open_drawing

    with tempfile.TemporaryDirectory(prefix="pilotage-") as folder:
        path = Path(folder) / f"drawing{sent.suffix}"
        path.write_bytes(sent.content)
        table = Path(folder) / "hints"
        table.write_bytes(sent.hints)
        try:
            drawing = open_drawing(path, read_hints(table))
        except FileError as error:
            raise UnreadableError(error.rule) from error
    remarks = ("hints are taken from the table beside the drawing",) if sent.hints else ()
    return replace(drawing, remarks=(*remarks, *drawing.remarks))


@dataclass(frozen=True, eq=False)
class Page:
    """The axes of a page on which a drawing is shown: its units, y down, whatever its file says."""

    sketch: SchematicMap

    def points(self, points: Array) -> Rows:
        """List points (n, 2) of the sketch."""
        return rounded_rows(points * (1.0, -1.0), self.decimals)

    def pose(self, x: float, y: float, heading: float) -> list[float]:
        """List a pose of the sketch; headings are the same on page and sketch."""
        (row,) = self.points(np.array([[x, y]]))
        return [*row, round(heading, 3)]

    def point(self, point: tuple[float, float] | None) -> list[float] | None:
        """List a point of the sketch, if there is one."""
        return None if point is None else self.points(np.array([point], dtype=np.float64))[0]

    def file_point(self, x: float, y: float) -> tuple[float, float]:
        """Carry a point of the page to the axes of the drawing's file, as `Navigator` takes it."""
        return (x, y) if self.sketch.y_down else (x, -y)

    def from_file(self, point: tuple[float, float]) -> list[float]:
        """Carry a point from the axes of the drawing's file."""
        return self.points(self.sketch.sketch_from_file(np.array([point], dtype=np.float64)))[0]

    @property
    def bounds(self) -> list[float]:
        """Left, top, right and bottom."""
        left, bottom, right, top = self.sketch.bounds
        return [*self.points(np.array([[left, top]]))[0], *self.points(np.array([[right, bottom]]))[0]]

    @cached_property
    def decimals(self) -> int:
        """Decimals that mean something on a drawing of this size."""
        return max(0, DIGITS - int(np.floor(np.log10(max(self.sketch.diagonal, 1e-9)))))


def rounded_rows(rows: Array, decimals: int) -> Rows:
    """List rows of numbers, rounded."""
    listed: Rows = np.round(rows, decimals).tolist()
    return listed


def describe_drawing(sketch: SchematicMap) -> Json:
    """List what was read of a drawing."""
    page = Page(sketch)
    return {
        "bounds": page.bounds,
        "strokes": strokes_of(page, sketch.strokes),
        "labels": labels_of(sketch),
        "zones": {
            name: [page.points(line.vertices) for line in lines]
            for name, lines in zip(ZONES, sketch.zones.lines, strict=True)
        },
        "start": page.point(sketch.start),
        "goal": page.point(sketch.goal),
    }


def strokes_of(page: Page, lines: Sequence[Polyline]) -> list[Json]:
    """List lines, and whether they are closed."""
    return [{"points": page.points(line.vertices), "closed": line.closed} for line in lines]


def labels_of(sketch: SchematicMap) -> list[Json]:
    """List the words of a drawing, and where they stand."""
    if not sketch.labels:
        return []
    places = Page(sketch).points(np.array([label.position for label in sketch.labels]))
    return [{"text": label.text, "x": x, "y": y} for label, (x, y) in zip(sketch.labels, places, strict=True)]


def read_upload(sent: Sent) -> Json:
    """Read a file of any kind, and make a drawing of it that can be drawn on."""
    drawing = read_sent(sent)
    sketch = without_replaced(drawing.sketch)
    notes = [f"{len(sketch.strokes)} strokes were taken for walls", *drawing.remarks]
    furniture = furniture_of(drawing)
    if drawing.interpretation is not None:
        notes += drawing.interpretation.sheet.left_out
    if len(furniture) > MOST_FURNITURE:
        notes.append(f"the furniture is left out: it has {len(furniture)} lines, more than {MOST_FURNITURE}")
        furniture = []
    return {
        **describe_drawing(sketch),
        "furniture": strokes_of(Page(sketch), furniture),
        "metres_per_unit": sketch.metres_per_unit,
        "svg": svg_of(sketch),
        "notes": notes,
    }


def furniture_of(drawing: "Drawing") -> list[Polyline]:
    """List the outlines of what was taken for furniture, among the walls."""
    found = drawing.interpretation
    if found is None:
        return []
    left, bottom, right, top = drawing.sketch.bounds
    meanings = zip(found.sheet.marks, found.meanings, strict=True)
    return [
        line
        for mark, meaning in meanings
        if meaning.role is Role.FURNITURE
        for line in mark.outlines
        if ((left, bottom) <= line.vertices).all() and (line.vertices <= (right, top)).all()
    ]


def without_replaced(sketch: SchematicMap) -> SchematicMap:
    """Leave out what is written in rooms whose names are told: in the new drawing all names are written."""
    told = [label for label in sketch.labels if label.told]
    if not told:
        return sketch
    try:
        graph = decompose(sketch, DecompositionSettings())
    except NotEnclosedError:
        return sketch
    points = [shapely.Point(label.position) for label in told]
    named = [cell.polygon for cell in graph.cells if any(map(cell.polygon.covers, points))]
    kept = (
        label
        for label in sketch.labels
        if label.told or not any(room.covers(shapely.Point(label.position)) for room in named)
    )
    return replace(sketch, labels=tuple(kept))


def svg_of(sketch: SchematicMap) -> str:
    """Write a drawing as SVG, with its marks by class, as `pilotage` reads them."""
    page = Page(sketch)
    left, top, right, bottom = page.bounds
    width = sketch.diagonal * STROKE
    margin = 4.0 * width
    box = f"{left - margin:g} {top - margin:g} {right - left + 2 * margin:g} {bottom - top + 2 * margin:g}"
    scale = "" if sketch.metres_per_unit is None else f' data-metres-per-unit="{sketch.metres_per_unit:g}"'
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}"{scale}>']
    lines.append(f'<g fill="none" stroke="#1b1b1f" stroke-width="{width:g}">')
    solid = {stroke.vertices.tobytes() for stroke in sketch.solids}
    lines += [
        f'<path d="{path_of(page, stroke)}"/>'
        for stroke in sketch.strokes
        if stroke.vertices.tobytes() not in solid
    ]
    if sketch.solids:
        rings = " ".join(path_of(page, ring) for ring in sketch.solids)
        lines.append(f'<path class="wall" fill="#1b1b1f" fill-rule="evenodd" stroke="none" d="{rings}"/>')
    lines += [
        f'<path class="{name}" stroke="gray" d="{path_of(page, line)}"/>'
        for name, zone_lines in zip(ZONES, sketch.zones.lines, strict=True)
        for line in zone_lines
    ]
    lines.append(f'</g><g font-size="{LETTERS * width:g}" text-anchor="middle">')
    lines += [
        f'<text x="{label["x"]}" y="{label["y"]}">{escape(str(label["text"]))}</text>'
        for label in labels_of(sketch)
    ]
    lines.append("</g>")
    for role, point in (("start", sketch.start), ("goal", sketch.goal)):
        if point is not None:
            (x, y) = page.point(point) or (0.0, 0.0)
            lines.append(f'<circle class="{role}" cx="{x:g}" cy="{y:g}" r="{3.0 * width:g}"/>')
    return "\n".join([*lines, "</svg>", ""])


def path_of(page: Page, stroke: Polyline) -> str:
    """Write a stroke as SVG path data."""
    points = " L".join(f"{x:g} {y:g}" for x, y in page.points(stroke.vertices))
    return f"M{points}{' Z' if stroke.closed else ''}"
