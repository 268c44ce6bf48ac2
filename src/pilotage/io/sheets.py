"""Read a drawing of any kind as a sheet: what was painted, before anything is understood."""

from collections.abc import Callable
from pathlib import Path

from pilotage.errors import FileError
from pilotage.interpretation.sheet import Sheet
from pilotage.io.kinds import Kind, recognize


def read_sheet(path: Path, page: str | None = None) -> Sheet:
    """Read a drawing in the units and axes of its file.

    `page` is the number or name of a page (PDF, draw.io) or the name of a level (indoor maps); it may also
    follow the name of the file, as in `plan.pdf#2`.
    Raises FileError if the file is missing or damaged, of a kind that cannot be read, or shows nothing.
    """
    path, page = split_page(path, page)
    kind = recognize(path)
    if kind in PAGED:
        return PAGED[kind](path, page)
    if page is not None:
        raise FileError(
            f"a drawing of the kind {kind.value} has no pages, but page {page!r} is asked for", path
        )
    if kind in SINGLE:
        return SINGLE[kind](path)
    raise FileError(f"a drawing of the kind {kind.value} cannot be read as lines", path)


def split_page(path: Path, page: str | None = None) -> tuple[Path, str | None]:
    """Take the page off a name such as `plan.pdf#2`, unless a file has this very name.

    >>> split_page(Path("plans/plan.pdf#2"))[1]
    '2'
    """
    stem, mark, named = path.name.rpartition("#")
    if page is None and mark and stem and named and not path.exists():
        return path.with_name(stem), named
    return path, page


def read_svg(path: Path) -> Sheet:
    """Read an SVG file."""
    from pilotage.io.svg import read_svg_sheet

    return read_svg_sheet(path)


def read_dxf(path: Path) -> Sheet:
    """Read a DXF file."""
    from pilotage.io.dxf import read_dxf as read

    return read(path)


def read_pdf(path: Path, page: str | None) -> Sheet:
    """Read a page of a PDF file; one that shows a picture raises PicturePageError."""
    from pilotage.io.pdf import read_pdf as read

    return read(path, page)


def read_excalidraw(path: Path) -> Sheet:
    """Read an Excalidraw file."""
    from pilotage.io.excalidraw import read_excalidraw as read

    return read(path)


def read_drawio(path: Path, page: str | None) -> Sheet:
    """Read a page of a draw.io file."""
    from pilotage.io.drawio import read_drawio as read

    return read(path, page)


def read_geojson(path: Path, level: str | None) -> Sheet:
    """Read a level of a GeoJSON map."""
    from pilotage.io.indoor import read_geojson as read

    return read(path, level)


def read_imdf(path: Path, level: str | None) -> Sheet:
    """Read a level of an IMDF archive."""
    from pilotage.io.indoor import read_imdf as read

    return read(path, level)


def read_osm(path: Path, level: str | None) -> Sheet:
    """Read a level of an OpenStreetMap file."""
    from pilotage.io.indoor import read_osm as read

    return read(path, level)


SINGLE: dict[Kind, Callable[[Path], Sheet]] = {
    Kind.SVG: read_svg,
    Kind.DXF: read_dxf,
    Kind.EXCALIDRAW: read_excalidraw,
}
"""Readers of files that hold one drawing."""

PAGED: dict[Kind, Callable[[Path, str | None], Sheet]] = {
    Kind.PDF: read_pdf,
    Kind.DRAWIO: read_drawio,
    Kind.GEOJSON: read_geojson,
    Kind.IMDF: read_imdf,
    Kind.OSM: read_osm,
}
"""Readers of files that may hold several pages or levels."""
