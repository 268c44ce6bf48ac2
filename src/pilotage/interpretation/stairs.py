"""Find what stairs and lifts cover: no robot drives there, wherever their lines leave a way."""

from collections.abc import Sequence

import shapely

from pilotage.interpretation.paint import NOTHING, Seen
from pilotage.interpretation.sheet import Sheet

STEP = 0.015
"""Steps are drawn at most twice this share of the drawing's diagonal apart: half a door's width."""


def find_stairs(marks: Sequence[Seen], sheet: Sheet, diagonal: float) -> shapely.Geometry:
    """Return the area that marks of stairs and lifts enclose, or lie close together in [drawing units]."""
    shapes = [shape for mark in marks for shape in (mark.line, mark.area, enclosed_by(mark, sheet))]
    reach = STEP * diagonal
    near = shapely.union_all(shapely.buffer(shapes, reach, cap_style="square", join_style="mitre"))
    area = shapely.buffer(near, -reach * (1.0 - 1e-6), join_style="mitre")
    whole = [
        shapely.Polygon(part.exterior) for part in shapely.get_parts(area) if part.geom_type == "Polygon"
    ]
    large = [part for part in whole if not shapely.buffer(part, -1e-3 * reach).is_empty]
    return shapely.union_all(large) if large else NOTHING


def enclosed_by(mark: Seen, sheet: Sheet) -> shapely.Geometry:
    """Return what the closed outlines of a mark enclose."""
    closed = [outline for outline in sheet.marks[mark.number].outlines if outline.closed]
    return shapely.union_all(
        [shapely.make_valid(shapely.polygons(one.vertices)) for one in closed if len(one) > 2]
    )
