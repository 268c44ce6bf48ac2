"""Read OpenStreetMap XML with indoor tags (https://wiki.openstreetmap.org/wiki/Simple_Indoor_Tagging)."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

import shapely

from pilotage.errors import FileError
from pilotage.interpretation.sheet import Sheet
from pilotage.io.files import check_regular, read_bytes
from pilotage.io.indoor.features import Feature, Kind, kind_of, levels_of
from pilotage.io.indoor.floor import floor_sheet
from pilotage.io.scales import length_in_metres

LARGEST = 100_000_000
"""The largest file that is read [bytes]."""

Point = tuple[float, float]
AREAS = (Kind.ROOM, Kind.CORRIDOR, Kind.AREA, Kind.COLUMN, Kind.STAIRS, Kind.ELEVATOR, Kind.BUILDING)


def read_osm(path: Path, level: str | None = None) -> Sheet:
    """Read an `.osm` file in metres from the lower left corner of the map.

    Raises FileError if it is missing or damaged, has no such level, or shows nothing.
    """
    check_regular(path)
    content = read_bytes(path, LARGEST)
    try:
        root = ET.fromstring(content)  # noqa: S314  # expat fetches nothing and limits the growth of entities
    except (ET.ParseError, ValueError, LookupError) as error:
        raise FileError(f"an OpenStreetMap file cannot be read ({str(error)[:100]})", path) from error
    return replace(floor_sheet(list(features_of(root)), path, level), to_open="add a node with door=yes")


def features_of(root: ET.Element) -> Iterator[Feature]:
    """Read what is tagged as a part of a building."""
    nodes = {node.get("id", ""): point for node in root.iter("node") if (point := position(node)) is not None}
    ways: dict[str, list[Point]] = {}
    for way in root.iter("way"):
        refs = (ref.get("ref", "") for ref in way.iter("nd"))
        ways[way.get("id", "")] = [nodes[ref] for ref in refs if ref in nodes]
    for element in root.iter():
        if element.tag not in ("node", "way", "relation") or element.get("action") == "delete":
            continue
        tags = {tag.get("k", ""): tag.get("v", "") for tag in element.findall("tag")}
        kind = kind_of(tags)
        shape = shape_of(element, kind, nodes, ways) if kind not in (None, Kind.OTHER) else None
        if kind is not None and shape is not None and not shape.is_empty:
            yield Feature(
                shape,
                kind,
                levels_of(tags.get("level", tags.get("repeat_on", ""))),
                tags.get("name") or tags.get("ref", ""),
                width=length_in_metres(tags.get("width", tags.get("door:width", ""))),
                source=f"{element.tag} {element.get('id', '')}",
            )


def position(node: ET.Element) -> Point | None:
    """Return longitude and latitude [deg]."""
    try:
        point = float(node.get("lon", "")), float(node.get("lat", ""))
    except ValueError:
        return None
    return point if abs(point[0]) <= 180.0 and abs(point[1]) <= 90.0 else None


def shape_of(
    element: ET.Element, kind: Kind | None, nodes: Mapping[str, Point], ways: Mapping[str, list[Point]]
) -> shapely.Geometry | None:
    """Return the shape of a node, a way or a relation of ways; None if parts are missing."""
    key = element.get("id", "")
    if element.tag == "node":
        return shapely.Point(nodes[key]) if key in nodes else None
    if element.tag == "way":
        points = ways.get(key, [])
        if len(points) < 2:
            return None
        is_area = kind in AREAS and len(points) > 3 and points[0] == points[-1]
        return shapely.make_valid(shapely.Polygon(points)) if is_area else shapely.LineString(points)
    rings: dict[str, list[shapely.Geometry]] = {"outer": [], "inner": []}
    for member in element.iter("member"):
        points = ways.get(member.get("ref", ""), [])
        role = member.get("role") or "outer"
        if member.get("type") == "way" and len(points) > 1 and role in rings:
            rings[role].append(shapely.LineString(points))
    outer, inner = (shapely.union_all(shapely.get_parts(shapely.polygonize(rings[role]))) for role in rings)
    return shapely.difference(outer, inner)
