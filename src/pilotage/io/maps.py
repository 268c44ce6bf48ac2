"""Open a drawing of any kind that can be read."""

import gc
import os
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from pilotage.errors import FileError
from pilotage.interpretation import Interpretation, NoWallsError, Role, Sheet, interpret
from pilotage.interpretation.names import colors_of
from pilotage.io.hints import DrawingHints, read_hints, role_of, shading_of, table_beside
from pilotage.io.kinds import Kind, recognize
from pilotage.io.map_server import read_map_server
from pilotage.io.raster import Picture, Shading, read_picture, sheet_or_plan
from pilotage.io.sheets import read_sheet, split_page
from pilotage.maps import Label, SchematicMap

MOST_NAMES = 3
"""So many names of layers are told where a drawing has too many pieces."""

MOST_PIECES = 30_000
"""More would take minutes and gigabytes to divide into rooms."""


@dataclass(frozen=True, eq=False)
class Drawing:
    """A drawing that was opened, and how its marks were understood."""

    sketch: SchematicMap
    interpretation: Interpretation | None = None  # None: a picture that was read by its free space
    remarks: tuple[str, ...] = ()  # what was assumed, in words


def open_map(
    path: str | os.PathLike[str],
    *,
    layers: Mapping[str, str] | None = None,
    labels: Mapping[str, Sequence[float]] | None = None,
    page: str | int | None = None,
    shading: str = "recognized",
) -> SchematicMap:
    """Read a drawing: SVG, PDF, DXF, a picture, Excalidraw, draw.io, an indoor map or a map_server file.

    The rest is for where guessing fails, and wins over the table beside the file (`office.svg.toml`):
    `layers` tells what the marks of a layer, class, id, block or color are, as in `{"A-FURN": "ignore"}`;
    `labels` names rooms at points in the file's own axes; `page` is the number or name of one of several
    pages or the name of a level, which `plan.pdf#2` names, too; `shading` is of a picture.

    Raises FileError if the file is missing, of another kind, or shows no stroke, ValueError if a hint is
    invalid.
    """
    hints = DrawingHints(
        {name: role_of(name, role) for name, role in (layers or {}).items()},
        tuple((name, (float(x), float(y))) for name, (x, y) in (labels or {}).items()),
        None if page is None else str(page),
        shading_of(shading),
    )
    return open_drawing(Path(path), hints).sketch


def open_drawing(file: Path, hints: DrawingHints | None = None) -> Drawing:
    """Read a drawing with what a person says about it, here and in the table beside the file."""
    hints, remarks = hints or DrawingHints(), []
    table = table_beside(split_page(file)[0])
    if table.is_file():
        hints = hints.over(read_hints(table))
        remarks.append(f"hints are taken from {table.name}")
    with collection_paused():
        sketch, interpretation = read_drawing(file, hints)
    if interpretation is not None:
        remarks += unknown_layers(interpretation, hints.layers)
    elif hints.layers:
        remarks.append("a picture has no layers")
    labels = tuple(
        Label(name, (float(x), float(y)), told=True)
        for name, point in hints.labels
        for x, y in sketch.sketch_from_file(np.array([point], dtype=np.float64))
    )
    return Drawing(replace(sketch, labels=labels + sketch.labels), interpretation, tuple(remarks))


@contextmanager
def collection_paused() -> Iterator[None]:
    """Let the garbage collector rest: the objects of a drawing all stay, and it would visit them often."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()


def read_drawing(file: Path, hints: DrawingHints) -> tuple[SchematicMap, Interpretation | None]:
    """Read a drawing by the reader of its kind, and understand its marks if it has any."""
    file, page = split_page(file, hints.page)
    kind = recognize(file)
    if kind is Kind.PICTURE:
        seen = sheet_or_plan(read_picture(file), hints.shading, file)
        return (seen, None) if isinstance(seen, SchematicMap) else understood(seen, file, hints)
    if kind is Kind.PDF:
        return read_pdf_page(file, page, hints)
    if hints.shading is not Shading.RECOGNIZED:
        raise FileError(f"only pictures have a shading, {hints.shading.value} is asked for", file)
    if kind is Kind.MAP_SERVER:
        return read_map_server(file), None
    return understood(read_sheet(file, page), file, hints)


def read_pdf_page(
    file: Path, page: str | None, hints: DrawingHints
) -> tuple[SchematicMap, Interpretation | None]:
    """Read a page of a PDF file; one that shows a picture is read as such."""
    from pilotage.io.pdf import PicturePageError, read_picture_page

    try:
        return understood(read_sheet(file, page), file, hints)
    except PicturePageError:
        shading = hints.shading
        seen = read_picture_page(file, page, lambda colors: sheet_or_plan(Picture(colors), shading, file))
    return (seen, None) if isinstance(seen, SchematicMap) else understood(seen, file, hints)


def understood(sheet: Sheet, file: Path, hints: DrawingHints) -> tuple[SchematicMap, Interpretation]:
    """Give the marks of a sheet a meaning."""
    try:
        interpretation = interpret(sheet, hints.layers)
    except NoWallsError as error:
        raise FileError(str(error), file) from error
    pieces = len(interpretation.sketch.segments)
    if pieces > MOST_PIECES:
        raise FileError(
            f"a drawing must have at most {MOST_PIECES:,} straight pieces of walls, found {pieces:,};"
            " leave out furniture, hatching and text, in the program that drew it or by --layer NAME=ignore"
            f"{most_walls(interpretation)}",
            file,
        )
    return interpretation.sketch, interpretation


def most_walls(interpretation: Interpretation) -> str:
    """Say under which names most pieces of walls are drawn; nothing if they have no names."""
    pieces = Counter[str]()
    for mark, meaning in zip(interpretation.sheet.marks, interpretation.meanings, strict=True):
        if meaning.role is Role.WALL:
            count = sum(len(outline) for outline in mark.outlines)
            pieces.update(dict.fromkeys(mark.names, count))
    told = ", ".join(f"{name!r} ({count:,})" for name, count in pieces.most_common(MOST_NAMES))
    return f" (most are named {told})" if told else ""


def unknown_layers(interpretation: Interpretation, layers: Mapping[str, Role]) -> list[str]:
    """Tell which of the layers that a person named are nowhere in the drawing."""
    if not layers:
        return []
    sheet = interpretation.sheet
    named = [mark.names for mark in sheet.marks] + [text.names for text in sheet.texts]
    known = {name for names in named for name in names}
    known.update(color for mark in sheet.marks for color in colors_of(mark))
    return [f"nothing in the drawing is named {name!r}" for name in layers if name not in known]
