"""Recognize what kind of drawing a file is: by its content, and by its name where that tells nothing."""

import re
import zipfile
import zlib
from collections.abc import Iterator
from enum import Enum
from pathlib import Path

from pilotage.errors import FileError
from pilotage.io.files import GZIP_MAGIC, check_regular, reading

HEAD = 65_536
"""Bytes at the beginning of a file that are looked at."""


class Kind(Enum):
    """Kinds of drawings that can be read."""

    SVG = "SVG"
    PICTURE = "picture"
    MAP_SERVER = "ROS map_server"
    DXF = "DXF"
    PDF = "PDF"
    EXCALIDRAW = "Excalidraw"
    DRAWIO = "draw.io"
    GEOJSON = "GeoJSON"
    IMDF = "IMDF"
    OSM = "OpenStreetMap"


SUFFIXES = {
    ".svg": Kind.SVG,
    ".svgz": Kind.SVG,
    **dict.fromkeys((".png", ".pgm", ".ppm", ".pbm", ".jpg", ".jpeg", ".bmp", ".gif"), Kind.PICTURE),
    **dict.fromkeys((".tif", ".tiff", ".webp"), Kind.PICTURE),
    ".yaml": Kind.MAP_SERVER,
    ".yml": Kind.MAP_SERVER,
    ".dxf": Kind.DXF,
    ".pdf": Kind.PDF,
    ".excalidraw": Kind.EXCALIDRAW,
    ".drawio": Kind.DRAWIO,
    ".geojson": Kind.GEOJSON,
    ".imdf": Kind.IMDF,
    ".osm": Kind.OSM,
}

ADVISED = {
    **dict.fromkeys((".skp", ".stl", ".obj", ".glb", ".gltf", ".fbx", ".dae", ".blend", ".rvt"), "model"),
    **dict.fromkeys((".ifc", ".step", ".stp", ".3ds", ".3dm", ".ply", ".fcstd", ".slvs", ".pln"), "model"),
    **dict.fromkeys((".gml", ".shp", ".gpkg", ".gpx", ".kmz", ".pbf", ".mbtiles", ".topojson"), "gis"),
    **dict.fromkeys((".fig", ".sketch", ".xd", ".cdr", ".afdesign", ".ai", ".tldr"), "design"),
}
"""What is said of files by their names, where neither these nor their content tell a kind."""

READABLE = "SVG, PDF, DXF, PNG, JPEG, Excalidraw, draw.io, GeoJSON, IMDF, OpenStreetMap and map_server YAML"

PICTURES = re.compile(
    rb"\x89PNG\r\n|\xff\xd8\xff|GIF8[79]a|BM.{4}\0\0\0\0|II\*\0|MM\0\*|RIFF.{4}WEBP|P[1-6]\s", re.DOTALL
)
DXF = re.compile(rb"AutoCAD Binary DXF|(?:\s*999\r?\n[^\n]*\n)*\s*0\s*\r?\n\s*SECTION\s*\r?\n")
JSON = re.compile(rb"(?:\xef\xbb\xbf)?\s*[\[{]\s*[\"{\[]")
DWG = re.compile(rb"AC10\d\d|AC1\.\d|MC0\.0")
ELEMENT = re.compile(rb"<(?:[A-Za-z_][\w.-]*:)?([A-Za-z_][\w.-]*)[\s/>]")

ROOTS: dict[bytes, Kind | str] = {
    b"svg": Kind.SVG,
    b"mxfile": Kind.DRAWIO,
    b"mxGraphModel": Kind.DRAWIO,
    b"osm": Kind.OSM,
    b"html": "html",
    b"kml": "gis",
    b"IndoorFeatures": "gis",
    b"CityModel": "gis",
    b"home": "sh3d",
    b"sdf": "gazebo",
    b"world": "gazebo",
}
"""Kinds of XML files by their outermost element."""

ADVICE = {
    "dwg": "a DWG drawing cannot be read: save it as DXF in the CAD program, or convert it with"
    " the free ODA File Converter",
    "postscript": "a PostScript drawing cannot be read: save it as PDF or SVG",
    "html": "a web page cannot be read: save the drawing itself as SVG or PNG",
    "gis": "a map of this kind cannot be read: save it as GeoJSON",
    "overpass": "map data in JSON cannot be read: download it as XML ([out:xml]), in a file .osm",
    "office": "an office document cannot be read: save the drawing in it as PDF or SVG",
    "sh3d": "a Sweet Home 3D home cannot be read: export its plan as SVG (Plan, Export to SVG format)",
    "heic": "a HEIC photo cannot be read: save it as JPEG",
    "zip": "a packed folder cannot be read: unpack it, and name the drawing in it",
    "model": "a model of a building cannot be read: export a floor plan of it as DXF, SVG or PDF",
    "gazebo": "a world of Gazebo cannot be read: map it, and take the map that nav2 saves",
    "design": "a drawing of this program cannot be read: export it as SVG or PDF",
    "json": "a plan in JSON of this kind cannot be read: export it as SVG, DXF or GeoJSON",
    "obsidian": "a note of Obsidian cannot be read: export its drawing as SVG or .excalidraw (Export Image)",
    "empty": "the file is empty",
}
"""What to do with files that cannot be read."""


def recognize(path: Path) -> Kind:
    """Return the kind of a drawing.

    Raises FileError if there is no such file, or no reader for its kind; the message says what to do.
    """
    check_regular(path)
    if path.is_dir():
        raise FileError("a drawing is expected, found a folder", path)
    with reading(path), path.open("rb") as file:
        head = file.read(HEAD)
    if head.startswith(GZIP_MAGIC):
        head = unpacked_head(head)
    suffix = path.suffix.lower()
    found = next(kinds_of(head, path), None) or SUFFIXES.get(suffix) or ADVISED.get(suffix)
    if found is None and JSON.match(head):
        found = "json"
    if found is None:
        raise FileError(f"a drawing of this kind cannot be read (readable are {READABLE})", path)
    if isinstance(found, str):
        raise FileError(ADVICE[found], path)
    return found


def unpacked_head(packed: bytes) -> bytes:
    """Unpack the beginning of a gzip file; empty if it is damaged."""
    try:
        return zlib.decompressobj(zlib.MAX_WBITS | 16).decompress(packed, HEAD)
    except zlib.error:
        return b""


SIGNATURES: tuple[tuple[re.Pattern[bytes], Kind | str], ...] = (
    (PICTURES, Kind.PICTURE),
    (DXF, Kind.DXF),
    (re.compile(rb".{0,1023}%PDF-", re.DOTALL), Kind.PDF),
    (DWG, "dwg"),
    (re.compile(rb"%!PS|\xc5\xd0\xd3\xc6"), "postscript"),
    (re.compile(rb"\xd0\xcf\x11\xe0"), "office"),
    (re.compile(rb".{4}ftyp(?:heic|heix|mif1)", re.DOTALL), "heic"),
    (re.compile(rb"ISO-10303-21"), "model"),
    (re.compile(rb"---\s.{0,1023}excalidraw-plugin:", re.DOTALL), "obsidian"),
)
"""How files of a kind begin."""


def kinds_of(head: bytes, path: Path) -> Iterator[Kind | str]:
    """Yield what the beginning of a file says of its kind, the surest first."""
    yield from (kind for begins, kind in SIGNATURES if begins.match(head))
    text = head.removeprefix(b"\xef\xbb\xbf").lstrip(b"\x1e \t\r\n")
    if head.startswith(b"PK\x03\x04"):
        yield kind_of_archive(path)
    if text.startswith(b"<"):
        yield from kinds_of_xml(text)
    if text.startswith((b"{", b"[")):
        yield from kinds_of_json(text)
    if not text and path.stat().st_size == 0:
        yield "empty"


def kinds_of_xml(text: bytes) -> Iterator[Kind | str]:
    """Yield the kind of an XML file by its outermost element."""
    root = ELEMENT.search(re.sub(rb"<!--.*?-->", b"", text, flags=re.DOTALL))
    name = root[1] if root is not None else b""
    kind = ROOTS.get(name) or ROOTS.get(name.lower())
    if kind is not None:
        yield kind


def kinds_of_json(text: bytes) -> Iterator[Kind | str]:
    """Yield the kind of a JSON file by words that only one kind has."""
    if re.search(rb'"type"\s*:\s*"excalidraw', text) or re.search(rb'"(?:strokeColor|seed)"\s*:', text):
        yield Kind.EXCALIDRAW
    if re.search(rb'"type"\s*:\s*"Topology"', text):
        yield "gis"
    if re.search(rb'"elements"\s*:\s*\[\s*\{\s*"type"\s*:\s*"(?:node|way|relation)"', text):
        yield "overpass"
    if re.search(rb'"type"\s*:\s*"(?:FeatureCollection|Feature|GeometryCollection)"', text):
        yield Kind.GEOJSON


def kind_of_archive(path: Path) -> Kind | str:
    """Tell what a packed folder holds."""
    try:
        with zipfile.ZipFile(path) as archive:
            names = {Path(name).name.lower() for name in archive.namelist()}
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError):
        return "zip"
    if "unit.geojson" in names:
        return Kind.IMDF
    if "home" in names or "home.xml" in names:
        return "sh3d"
    return "office" if "[content_types].xml" in names or "content.xml" in names else "zip"
