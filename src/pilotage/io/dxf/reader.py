"""Read a DXF file: what is shown in model space, or on paper where model space is empty."""

import io
import logging
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from pilotage.errors import FileError
from pilotage.interpretation.sheet import Sheet
from pilotage.io.dxf.mending import is_cut_off, mended, without_objects
from pilotage.io.files import check_regular, read_bytes

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.layouts import BaseLayout

LARGEST = 100_000_000
"""The largest file that is read [bytes]."""

METRES = {
    1: 0.0254,
    2: 0.3048,
    4: 0.001,
    5: 0.01,
    6: 1.0,
    10: 0.9144,
    14: 0.1,
    15: 10.0,
    16: 100.0,
    21: 1200.0 / 3937.0,
}
"""Metres in the units of $INSUNITS that buildings are drawn in."""

LONGEST_REASON = 100
"""Letters of a message of the library that are passed on."""


def read_dxf(path: Path) -> Sheet:
    """Read a drawing of a CAD program, in the units of the file.

    Raises FileError if the file is missing or damaged, or shows no line.
    """
    from pilotage.io.dxf.walk import Place, Walk

    document = read_document(path)
    walk = Walk.of(path, document)
    with walk.builder.surviving("damaged layouts"):
        walk.read_all(shown_layout(document).entities_in_redraw_order(), Place())
    return walk.sheet(metres_per_unit(document))


def read_document(path: Path) -> "Drawing":
    """Read a DXF file, repairing what can be repaired."""
    check_regular(path)
    content = read_bytes(path, LARGEST)
    if is_cut_off(content):
        raise FileError("a DXF file ends in the middle: save it or copy it once more", path)
    logging.getLogger("ezdxf").addHandler(logging.NullHandler())  # else it writes warnings to the terminal
    from ezdxf import recover

    drawn = mended(content)
    try:
        return recover.read(io.BytesIO(drawn))[0]
    except MemoryError:
        raise
    except Exception as error:  # the parser may raise anything on a damaged file
        with suppress(Exception):
            return recover.read(io.BytesIO(without_objects(drawn)))[0]
        raise FileError(f"a DXF file cannot be read ({first_line(error)})", path) from error


def first_line(error: Exception) -> str:
    """Say what a library raised, in a few words."""
    return (str(error).strip().splitlines() or [""])[0][:LONGEST_REASON] or type(error).__name__


def shown_layout(document: "Drawing") -> "BaseLayout":
    """Return model space, or the fullest sheet of paper if model space shows nothing."""
    layouts: list[BaseLayout] = [
        document.modelspace(),
        *(document.paperspace(name) for name in papers(document)),
    ]
    return layouts[0] if count_shown(layouts[0]) else max(layouts, key=count_shown)


def papers(document: "Drawing") -> list[str]:
    """Return the names of the sheets of paper."""
    return [name for name in document.layouts.names_in_taborder() if name != "Model"]


def count_shown(layout: "BaseLayout") -> int:
    """Count the entities of a layout that show something."""
    from pilotage.io.dxf.walk import INVISIBLE

    return sum(entity.dxftype() not in INVISIBLE for entity in layout)


def metres_per_unit(document: "Drawing") -> float | None:
    """Return the unit that a file claims for its drawing."""
    try:
        return METRES.get(int(document.header.get("$INSUNITS", 0)))
    except (TypeError, ValueError):
        return None
