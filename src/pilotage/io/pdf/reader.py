"""Read the lines, areas and words of a PDF page."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pypdfium2
import pypdfium2.raw as pdfium
import shapely

from pilotage.errors import FileError
from pilotage.geometry import Affine2, Polyline, signed_area
from pilotage.interpretation.paper import COVERING, bounds_of, share_within
from pilotage.interpretation.sheet import Bounds, Color, Mark, Pen, Sheet
from pilotage.io.clip import Clip, Part, area_of, cut
from pilotage.io.hatching import filled_hatching
from pilotage.io.pages import choose_page, other_pages
from pilotage.io.pdf.dashes import dashed_lines
from pilotage.io.pdf.document import open_page, opened, page_names
from pilotage.io.pdf.frame import shown_from_content
from pilotage.io.pdf.paths import Handle, clips_of, layers_of, matrix_of, paint_of, path_of, stroke_of
from pilotage.io.pdf.words import read_texts
from pilotage.io.scales import find_scale
from pilotage.io.sheet_builder import MOST_MARKS, SheetBuilder, outline_through

POINT = 0.0254 / 72.0
"""A point on paper [m]."""

DEEPEST = 12
"""Forms within forms."""

PATTERN = (191 / 255, 191 / 255, 191 / 255)
"""The color that the library tells of a pattern, whatever it shows."""

PICTURE_SHARE = 0.3
"""A page is a picture if pictures cover this share of it and it has next to no lines."""

FEWEST_PATHS = 10
"""A page with pictures and fewer paths than this is a picture: a frame and a rule are no plan."""


class PicturePageError(FileError):
    """A page shows a picture and no lines: it is to be read as a picture."""


@dataclass(frozen=True, slots=True)
class Where:
    """Where an object stands: on the page, or in a form that is painted on it."""

    shown_from_here: Affine2
    groups: tuple[int, ...] = ()
    names: tuple[str, ...] = ()


def read_pdf(path: Path, page: str | None = None) -> Sheet:
    """Read a page, given by its number from 1, in points from the lower left corner of the page as shown.

    Raises FileError if it cannot be read or shows no line; PicturePageError if it shows a picture instead.
    """
    with opened(path) as document:
        names = page_names(document)
        index = choose_page(names, page, path)
        with open_page(document, index, path) as shown:
            width, height = shown.get_size()
            frame = shown_from_content(shown)
            walk = Walk(SheetBuilder(path))
            walk.read_page(shown, Where(frame))
            if walk.paths < FEWEST_PATHS and walk.picture_area >= PICTURE_SHARE * width * height:
                raise PicturePageError("a page of a PDF file shows a picture and no lines", path)
            with walk.builder.surviving("damaged words"):
                for text in read_texts(shown, frame):
                    walk.builder.add_text(text)
    page_box = (0.0, 0.0, width, height)
    marks = [mark for mark in walk.builder.marks if not is_squared_paper(mark, page_box)]
    walk.builder.marks[:] = filled_hatching(marks)
    scale = find_scale(text.text for text in walk.builder.texts)
    return walk.builder.build(
        page=page_box,
        metres_per_unit=None if scale is None else scale * POINT,
        remarks=other_pages(names, index, path),
    )


def is_squared_paper(mark: Mark, page: Bounds) -> bool:
    """Tell whether a pattern covers the whole page."""
    return mark.fill == PATTERN and share_within(page, bounds_of(mark)) >= COVERING


@dataclass
class Walk:
    """A way through the objects of a page, in paint order."""

    builder: SheetBuilder
    paths: int = 0
    picture_area: float = 0.0  # [points^2]
    clips: dict[tuple[Affine2, bytes], Clip] = field(default_factory=dict)
    maps: dict[tuple[Affine2, Affine2], Affine2] = field(default_factory=dict)

    def read_page(self, page: "pypdfium2.PdfPage", where: Where) -> None:
        """Read all objects of a page."""
        count = pdfium.FPDFPage_CountObjects(page)
        if count > MOST_MARKS:
            raise FileError(
                f"a page must have at most {MOST_MARKS:,} shapes, got {count:,}", self.builder.path
            )
        for k in range(count):
            self.read(
                pdfium.FPDFPage_GetObject(page, k), where, depth=0, source=f"object {k + 1} of the page"
            )

    def read(self, handle: Handle, where: Where, *, depth: int, source: str) -> None:
        """Read one object."""
        kind = pdfium.FPDFPageObj_GetType(handle)
        if kind == pdfium.FPDF_PAGEOBJ_PATH:
            self.paths += 1
            with self.builder.surviving("damaged paths"):
                self.read_path(handle, where, source)
        elif kind == pdfium.FPDF_PAGEOBJ_FORM:
            if depth >= DEEPEST:
                self.builder.leave_out("forms that are nested too deeply")
                return
            inner = Where(
                where.shown_from_here @ matrix_of(handle),
                (*where.groups, self.builder.new_group()),
                (*where.names, *layers_of(handle)),
            )
            for k in range(max(pdfium.FPDFFormObj_CountObjects(handle), 0)):
                self.read(pdfium.FPDFFormObj_GetObject(handle, k), inner, depth=depth + 1, source=source)
        elif kind == pdfium.FPDF_PAGEOBJ_IMAGE:
            linear = (where.shown_from_here @ matrix_of(handle)).linear
            self.picture_area += abs(float(np.linalg.det(linear)))
            self.builder.leave_out("embedded pictures")
        elif kind == pdfium.FPDF_PAGEOBJ_SHADING:
            self.builder.leave_out("color gradients")

    def read_path(self, handle: Handle, where: Where, source: str) -> None:
        """Read a path, cut to its clip."""
        shown_from_object = self.composed(where.shown_from_here, matrix_of(handle))
        found = [
            outline_through(shown_from_object @ points, closed=closed) for points, closed in path_of(handle)
        ]
        outlines = [outline for outline in found if outline is not None]
        fill, color, winding = paint_of(handle)
        if not outlines or (fill is None and color is None):
            return
        width, dashed = stroke_of(handle)
        pen = None if color is None else Pen(color, width * shown_from_object.scale, dashed)
        if fill is not None and pen is None and (dashes := dashed_lines(outlines)) is not None:
            outlines, pen, fill = list(dashes[0]), Pen(fill, dashes[1], dashed=True), None
        names = (*where.names, *layers_of(handle))
        clip = self.clip_of(handle, where)
        for part, part_pen, part_fill in parts_of(outlines, pen, fill, clip, winding=winding):
            self.builder.add_mark(
                part, pen=part_pen, fill=part_fill, names=names, groups=where.groups, source=source
            )

    def composed(self, shown_from_here: Affine2, here_from_object: Affine2) -> Affine2:
        """Compose two maps, of which a page has few."""
        key = (shown_from_here, here_from_object)
        if key not in self.maps:
            self.maps[key] = shown_from_here @ here_from_object
        return self.maps[key]

    def clip_of(self, handle: Handle, where: Where) -> Clip | None:
        """Return the area that an object is cut to; None if it is not cut."""
        clips = clips_of(handle)
        if not clips:
            return None
        parts = b"|".join(
            points.tobytes() for path in clips for points in (*(p for p, _ in path), np.empty(0))
        )
        key = (where.shown_from_here, parts)
        if key not in self.clips:
            shown = [[where.shown_from_here @ points for points, _ in path] for path in clips]
            areas = [area_of(rings) for rings in shown if rings]
            self.clips[key] = Clip(shapely.intersection_all(areas) if areas else shapely.Polygon())
        return self.clips[key]


def parts_of(
    outlines: Sequence[Polyline],
    pen: Pen | None,
    fill: Color | None,
    clip: Clip | None,
    *,
    winding: bool,
) -> Iterator[Part]:
    """Divide a path into marks: areas that overlap by the winding rule, and what a clip leaves."""
    if clip is not None and not clip.leaves_whole(outlines):
        yield from cut(outlines, pen, fill, clip)
    elif fill is not None and winding and len(outlines) > 1 and turn_alike(outlines):
        for outline in outlines:
            yield (outline,), pen, fill
    else:
        yield outlines, pen, fill


def turn_alike(outlines: Sequence[Polyline]) -> bool:
    """Tell whether all outlines turn the same way: by the winding rule none is then a hole."""
    signs = {float(np.sign(signed_area(outline.vertices))) for outline in outlines}
    return len(signs - {0.0}) <= 1
