"""Read a page of a PDF file that shows a picture: a scan or a photo."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from pilotage.geometry import Array, Homography, Polyline
from pilotage.interpretation.sheet import Mark, Pen, Sheet
from pilotage.io.pages import choose_page, other_pages
from pilotage.io.pdf.document import PICTURE_SIDE, open_page, opened, page_names, page_picture
from pilotage.io.pdf.frame import shown_from_content
from pilotage.io.pdf.words import read_texts


def read_picture_page(path: Path, page: str | None = None, side: int = PICTURE_SIDE) -> Sheet:
    """Trace a page that shows a picture, in points from its lower left corner.

    Words that a program has recognized in a scan are read. Raises FileError if the page cannot be read.
    """
    from pilotage.io.picture import sheet_of

    with opened(path) as document:
        names = page_names(document)
        index = choose_page(names, page, path)
        with open_page(document, index, path) as shown:
            width, height = shown.get_size()
            texts = tuple(read_texts(shown, shown_from_content(shown)))
    pixels = page_picture(path, page, side)
    sheet = sheet_of((pixels / np.float32(255.0)).astype(np.float32), source=str(path))
    scale = max(width, height) / side
    page_from_pixels = np.array([[scale, 0.0, 0.0], [0.0, scale, height], [0.0, 0.0, 1.0]])
    photo = sheet.photo_from_sheet
    return replace(
        sheet,
        marks=tuple(moved(mark, page_from_pixels) for mark in sheet.marks),
        texts=texts,
        page=(0.0, 0.0, width, height),
        y_down=False,
        photo_from_sheet=None if photo is None else moved_homography(photo, page_from_pixels),
        left_out=(*sheet.left_out, *other_pages(names, index, path)),
    )


def moved(mark: Mark, page_from_pixels: Array) -> Mark:
    """Carry a mark from pixels, y up, to points of the page."""
    scale, shift = page_from_pixels[0, 0], page_from_pixels[:2, 2]
    outlines = tuple(Polyline(outline.vertices * scale + shift, outline.closed) for outline in mark.outlines)
    pen = mark.pen
    return replace(
        mark,
        outlines=outlines,
        pen=None if pen is None else Pen(pen.color, pen.width * scale, pen.dashed),
    )


def moved_homography(photo_from_sheet: Homography, page_from_pixels: Array) -> Homography:
    """Carry a homography of pixels to one of points of the page."""
    matrix = page_from_pixels @ photo_from_sheet.matrix @ np.linalg.inv(page_from_pixels)
    return Homography.from_matrix(matrix)
