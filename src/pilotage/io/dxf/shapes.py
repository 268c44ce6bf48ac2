"""Outlines of DXF entities: curves cut into chords, hatches as areas or as lines."""

from collections.abc import Iterator
from itertools import islice

from ezdxf import path as paths
from ezdxf.entities import DXFGraphic, LWPolyline
from ezdxf.entities import Polyline as DxfPolyline
from ezdxf.entities.polygon import DXFPolygon
from ezdxf.render.hatching import HatchingError, hatch_entity

from pilotage.geometry import Polyline
from pilotage.io.curves import bezier
from pilotage.io.sheet_builder import outline_through

MOST_HATCH_LINES = 5_000
"""A hatch of more lines than this is an area."""


def outlines_of(entity: DXFGraphic) -> Iterator[Polyline | None]:
    """Cut the line of an entity into chords."""
    path = paths.make_path(entity)
    for part in path.sub_paths() if path.has_sub_paths else (path,):
        yield flattened(part, closed=is_closed(entity))


def is_closed(entity: DXFGraphic) -> bool:
    """Tell whether a polyline says that its end is joined to its beginning."""
    return isinstance(entity, LWPolyline | DxfPolyline) and bool(entity.is_closed)


def width_of(entity: DXFGraphic) -> float:
    """Return the width that a polyline has of its own, 0 for all other entities [drawing units]."""
    if isinstance(entity, LWPolyline):
        widths = [max(start, end) for start, end in entity.get_points("se")]
        return max(float(entity.dxf.get("const_width", 0.0)), *widths, 0.0)
    if isinstance(entity, DxfPolyline):
        return max(
            float(entity.dxf.get("default_start_width", 0.0)), float(entity.dxf.get("default_end_width", 0.0))
        )
    return 0.0


def flattened(path: paths.Path, *, closed: bool) -> Polyline | None:
    """Cut the curves of a path without gaps into chords."""
    last = path.start
    points = [(last.x, last.y)]
    for command in path.commands():
        if isinstance(command, paths.Curve4To):
            control = (last, command.ctrl1, command.ctrl2, command.end)
            points.extend(bezier([(p.x, p.y) for p in control]))
        elif isinstance(command, paths.Curve3To):
            points.extend(bezier([(p.x, p.y) for p in (last, command.ctrl, command.end)]))
        else:
            points.append((command.end.x, command.end.y))
        last = command.end
    return outline_through(points, closed=closed)


def boundaries_of(hatch: DXFPolygon) -> list[Polyline | None]:
    """Return the boundaries of a hatch."""
    return [flattened(path, closed=True) for path in paths.from_hatch(hatch)]


def hatch_lines(hatch: DXFPolygon) -> list[Polyline | None] | None:
    """Return the lines of a hatch; None if it is an area: solid, a gradient, or of very many lines."""
    if hatch.dxf.get("solid_fill", 1) or hatch.pattern is None or not hatch.pattern.lines:
        return None
    try:
        lines = list(islice(hatch_entity(hatch), MOST_HATCH_LINES + 1))
    except HatchingError:  # too dense, among other things
        return None
    if len(lines) > MOST_HATCH_LINES:
        return None
    return [outline_through([(a.x, a.y), (b.x, b.y)]) for a, b in lines]


def corners(entity: DXFGraphic) -> list[Polyline | None]:
    """Return the outline of a SOLID, TRACE or WIPEOUT."""
    return [flattened(paths.make_path(entity), closed=True)]
