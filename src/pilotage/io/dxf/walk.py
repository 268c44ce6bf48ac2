"""Go through the entities of a DXF file, into blocks and dimensions, and collect marks and words."""

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import cast

import numpy as np
from ezdxf.document import Drawing
from ezdxf.entities import Attrib, DXFEntity, DXFGraphic, Insert, MText
from ezdxf.entities import Text as DxfText
from ezdxf.entities.polygon import DXFPolygon
from ezdxf.protocols import SupportsVirtualEntities, virtual_entities

from pilotage.errors import FileError
from pilotage.interpretation.sheet import WHITE, Sheet
from pilotage.io.dxf.look import DEFAULT_WEIGHT, Look, Looks
from pilotage.io.dxf.shapes import boundaries_of, corners, hatch_lines, outlines_of, width_of
from pilotage.io.dxf.words import read_words
from pilotage.io.sheet_builder import SheetBuilder

DEEPEST = 16
"""Blocks within blocks."""

MOST_ENTITIES = 1_000_000
"""Entities that are looked at, those of blocks each time that they are inserted."""

LINES = frozenset(("LINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE", "HELIX", "LWPOLYLINE", "POLYLINE", "3DFACE"))
AREAS = frozenset(("SOLID", "TRACE", "WIPEOUT"))
PAINTED = LINES | AREAS | {"HATCH", "MPOLYGON"}
INVISIBLE = frozenset(("VIEWPORT", "ATTDEF", "POINT", "XLINE", "RAY", "SEQEND", "VERTEX", "SUN", "LIGHT"))
"""Entities that show nothing of a building."""
PLURALS = {
    "IMAGE": "embedded pictures",
    "PDFUNDERLAY": "underlaid PDF pages",
    "DWFUNDERLAY": "underlaid DWF pages",
    "3DSOLID": "solid bodies",
    "BODY": "solid bodies",
    "REGION": "regions",
    "ACAD_PROXY_ENTITY": "objects of a CAD extension",
    "OLE2FRAME": "embedded documents",
}
DAMAGED = "damaged entities"
HIDDEN = "entities on layers that are off or frozen"

SHEET_WIDTH = 420.0
"""Weights of lines are as on a sheet of this width that the drawing fills [mm]."""


@dataclass(frozen=True, slots=True)
class Place:
    """Where an entity stands: in model space, or in an insertion of a block."""

    look: Look | None = None
    names: tuple[str, ...] = ()
    kind: tuple[str, ...] = ()  # of what an entity is a part, as "DIMENSION": says more than its layer
    groups: tuple[int, ...] = ()
    source: str = ""
    depth: int = 0


@dataclass
class Walk:
    """A way through all entities that are shown."""

    builder: SheetBuilder
    looks: Looks
    weights: dict[int, float] = field(default_factory=dict)  # index of a mark: weight of its line [mm]
    entities: int = 0

    @classmethod
    def of(cls, path: Path, document: Drawing) -> "Walk":
        """Begin."""
        return cls(SheetBuilder(path), Looks.of(document))

    def read_all(self, entities: Iterable[DXFEntity], place: Place) -> None:
        """Read entities in paint order.

        Raises FileError if there are too many.
        """
        for entity in entities:
            self.entities += 1
            if self.entities > MOST_ENTITIES:
                raise FileError(
                    f"a DXF drawing must have at most {MOST_ENTITIES:,} entities, found more",
                    self.builder.path,
                )
            with self.builder.surviving(DAMAGED):
                if isinstance(entity, DXFGraphic):
                    self.read(entity, place)

    def read(self, entity: DXFGraphic, place: Place) -> None:
        """Read one entity, if it is shown."""
        kind = entity.dxftype()
        is_secret = isinstance(entity, Attrib) and entity.is_invisible  # data that blocks carry along
        if kind in INVISIBLE or entity.dxf.get("invisible", 0) or is_secret:
            return
        look = self.looks.look(entity, place.look)
        if self.looks.frozen(look.layer) or (kind != "INSERT" and self.looks.hidden(look.layer)):
            self.builder.leave_out(HIDDEN)
            return
        names = (*place.names, look.layer, *place.kind)
        here = replace(place, names=names, kind=(), source=place.source or origin(entity, look))
        if isinstance(entity, Insert):
            self.read_insert(entity, look, here)
        elif isinstance(entity, MText | DxfText):
            for text in read_words(entity, here.names, here.groups, here.source):
                self.builder.add_text(text)
        elif kind in PAINTED:
            self.paint(entity, look, here)
        elif isinstance(entity, SupportsVirtualEntities):
            self.read_parts(entity, look, here)
        else:
            self.builder.leave_out(PLURALS.get(kind, f"entities of the kind {kind}"))

    def paint(self, entity: DXFGraphic, look: Look, place: Place) -> None:
        """Add the line or the area of one entity."""
        pen, fill, names, weight = None, None, place.names, 0.0
        if isinstance(entity, DXFPolygon):
            lines = hatch_lines(entity)
            pen, fill = (None, look.color) if lines is None else (look.pen(0.0), None)
            outlines = boundaries_of(entity) if lines is None else lines
            names = ("hatch", *names) if lines is None else (*names, "hatch")
        elif entity.dxftype() in AREAS:
            outlines, fill = corners(entity), WHITE if entity.dxftype() == "WIPEOUT" else look.color
        else:
            width = width_of(entity)
            if width == 0.0 and look.weight > DEFAULT_WEIGHT:
                weight = look.weight / 100.0
            outlines, pen = list(outlines_of(entity)), look.pen(width)
        index = len(self.builder.marks)
        self.builder.add_mark(
            outlines, pen=pen, fill=fill, names=names, groups=place.groups, source=place.source
        )
        if weight and len(self.builder.marks) > index:  # a line of no length gives no mark
            self.weights[index] = weight

    def read_insert(self, insert: Insert, look: Look, place: Place) -> None:
        """Read what an insertion of a block shows, and its attributes."""
        if place.depth >= DEEPEST:
            self.builder.leave_out("blocks that are nested too deeply")
            return
        inner = replace(
            place,
            look=look,
            names=(*place.names, str(insert.dxf.get("name", ""))),
            groups=(*place.groups, self.builder.new_group()),
            depth=place.depth + 1,
        )
        for single in insert.multi_insert() if insert.mcount > 1 else (insert,):
            self.read_all(single.virtual_entities(skipped_entity_callback=self.skip), inner)
        self.read_all(insert.attribs, inner)

    def skip(self, entity: DXFEntity, _reason: str) -> None:
        """Count what a library cannot move into its place."""
        if entity.dxftype() not in INVISIBLE:
            self.builder.leave_out(PLURALS.get(entity.dxftype(), f"entities of the kind {entity.dxftype()}"))

    def read_parts(self, entity: DXFGraphic, look: Look, place: Place) -> None:
        """Read what a dimension, a leader or a table is drawn of, named by its kind."""
        if place.depth >= DEEPEST:
            return
        inner = replace(
            place,
            look=look,
            kind=(entity.dxftype(),),
            groups=(*place.groups, self.builder.new_group()),
            depth=place.depth + 1,
        )
        self.read_all(virtual_entities(cast("SupportsVirtualEntities", entity)), inner)

    def sheet(self, metres_per_unit: float | None) -> Sheet:
        """Return what was read, heavy lines as wide as on a sheet of paper that the drawing fills."""
        builder = self.builder
        if self.weights:
            points = np.vstack([outline.vertices for mark in builder.marks for outline in mark.outlines])
            unit = float(np.ptp(points[:, 0])) / SHEET_WIDTH
            for k, weight in self.weights.items():
                mark = builder.marks[k]
                if mark.pen is not None:
                    builder.marks[k] = replace(mark, pen=replace(mark.pen, width=weight * unit))
        return builder.build(metres_per_unit=metres_per_unit)


def origin(entity: DXFGraphic, look: Look) -> str:
    """Say where in the file an entity is."""
    return f"{entity.dxftype()} {entity.dxf.get('handle') or ''} on {look.layer}".replace("  ", " ")
