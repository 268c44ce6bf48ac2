"""Open a PDF file, choose a page, and paint a page that is a picture."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pilotage.errors import FileError
from pilotage.io.files import check_regular, read_bytes

if TYPE_CHECKING:
    import pypdfium2

LARGEST = 200_000_000
"""The largest file that is read [bytes]."""

LARGEST_PAGE = 20_000.0
"""The longest side of a page [points]: 7 m."""

PICTURE_SIDE = 2000
"""Pixels of the longer side of a page that is painted: 7 pixels a millimetre of an A4 sheet."""


@contextmanager
def opened(path: Path) -> Iterator["pypdfium2.PdfDocument"]:
    """Open a PDF file and close it again.

    Raises FileError if it is missing, damaged, locked by a password, or has no page.
    """
    check_regular(path)
    content = read_bytes(path, LARGEST)
    import pypdfium2

    try:
        document = pypdfium2.PdfDocument(content)
    except pypdfium2.PdfiumError as error:
        if "password" in str(error).lower():
            raise FileError(
                "a PDF file must not be locked by a password: save it without one", path
            ) from error
        raise FileError("a PDF file cannot be read, it is damaged", path) from error
    try:
        if len(document) == 0:
            raise FileError("a PDF file needs at least one page, found none", path)
        yield document
    finally:
        document.close()


@contextmanager
def open_page(document: "pypdfium2.PdfDocument", index: int, path: Path) -> Iterator["pypdfium2.PdfPage"]:
    """Open a page and close it again.

    Raises FileError if it cannot be read, or its size cannot be a page's.
    """
    import pypdfium2

    try:
        page = document[index]
    except pypdfium2.PdfiumError as error:
        raise FileError(f"page {index + 1} of a PDF file cannot be read, it is damaged", path) from error
    try:
        width, height = page.get_size()
        if not (0.0 < width <= LARGEST_PAGE and 0.0 < height <= LARGEST_PAGE):
            raise FileError(
                f"a page must have sides of up to {LARGEST_PAGE:.0f} points, got {width:g} x {height:g}", path
            )
        yield page
    finally:
        page.close()


def page_names(document: "pypdfium2.PdfDocument") -> list[str]:
    """Return the numbers of the pages."""
    return [str(number + 1) for number in range(len(document))]


def painted(page: "pypdfium2.PdfPage", side: int) -> NDArray[np.uint8]:
    """Paint an open page, (height, width, 3), its longer side of so many pixels."""
    bitmap = page.render(scale=side / max(page.get_size()), rev_byteorder=True)
    pixels = np.array(bitmap.to_numpy()[:, :, :3], dtype=np.uint8)
    bitmap.close()
    return pixels
