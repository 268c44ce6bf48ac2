"""Read GeoJSON, alone or as the files of an IMDF archive."""

import io
import json
import zipfile
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import shapely

from pilotage.errors import FileError
from pilotage.interpretation.names import name_words
from pilotage.interpretation.sheet import Sheet
from pilotage.io.files import check_regular, read_bytes
from pilotage.io.indoor.features import Feature, Kind, Tags, kind_of, levels_of
from pilotage.io.indoor.floor import floor_sheet
from pilotage.io.json_files import LARGEST, Json, objects, read_json_objects, words
from pilotage.io.scales import length_in_metres

NAMES = (
    "name", "label", "room_name", "title", "text", "bezeichnung", "raumname", "raum", "nom", "nombre", "nome",
    "ref", "room_number", "room_no", "raumnummer", "number",
)  # fmt: skip
"""Where the name of a place is told, the likeliest first."""

LEVELS = ("level", "floor", "storey", "etage")
"""Where levels are listed; ids of levels, `LEVEL_IDS`, are no lists."""

LEVEL_IDS = ("level_id", "floor_id")

IMDF_FILES = ("unit", "opening", "fixture", "kiosk", "level")
"""Files of an IMDF archive that draw something, or name the levels."""

TO_OPEN = "add a feature with the feature_type 'opening'"
"""How one makes a door."""

DAMAGED = (
    ValueError,
    TypeError,
    KeyError,
    IndexError,
    AttributeError,
    OverflowError,
    shapely.errors.ShapelyError,
)
"""What a geometry of odd types and numbers raises."""


def read_geojson(path: Path, level: str | None = None) -> Sheet:
    """Read a GeoJSON file; `unit.geojson` of an IMDF archive is read with the files beside it.

    Degrees become metres from the lower left corner of the map.
    Raises FileError if it is missing or damaged, has no such level, or shows nothing.
    """
    collections = read_json_objects(path, "a GeoJSON file")
    if path.stem == "unit":
        beside = (path.with_name(f"{name}{path.suffix}") for name in IMDF_FILES if name != "unit")
        collections += [
            found for file in beside if file.exists() for found in read_json_objects(file, "a GeoJSON file")
        ]
    return collections_sheet(collections, path, level)


def read_imdf(path: Path, level: str | None = None) -> Sheet:
    """Read a packed IMDF archive.

    Raises FileError as `read_geojson` does.
    """
    check_regular(path)
    try:
        with zipfile.ZipFile(io.BytesIO(read_bytes(path))) as archive:
            members = {Path(info.filename).name: info for info in archive.infolist()}
            collections = [
                unpacked(archive, members[f"{name}.geojson"], path)
                for name in IMDF_FILES
                if f"{name}.geojson" in members
            ]
    except (zipfile.BadZipFile, zlib.error, ValueError, RuntimeError, OSError, EOFError) as error:
        raise FileError(f"an IMDF archive cannot be read ({str(error)[:100]})", path) from error
    if not collections:
        raise FileError("an IMDF archive must hold unit.geojson", path)
    return collections_sheet(collections, path, level)


def unpacked(archive: zipfile.ZipFile, member: zipfile.ZipInfo, path: Path) -> Json:
    """Read one file of an archive, never more than is allowed."""
    with archive.open(member) as file:
        content = file.read(LARGEST + 1)
    if len(content) > LARGEST:
        raise FileError(f"a file of an IMDF archive must have at most {LARGEST // 1_000_000} MB", path)
    try:
        found = json.loads(content)
    except (ValueError, RecursionError) as error:
        raise FileError(f"an IMDF archive cannot be read ({str(error)[:100]})", path) from error
    return found if isinstance(found, dict) else {}


def collections_sheet(collections: list[Json], path: Path, level: str | None) -> Sheet:
    """Draw the features of some GeoJSON files."""
    found = [feature for collection in collections for feature in raw_features(collection)]
    names = imdf_levels(found)
    features = []
    for k, raw in enumerate(found):
        feature = read_feature(raw, k)
        if feature is not None:
            features.append(replace(feature, levels=tuple(names.get(name, name) for name in feature.levels)))
    kinds = {feature.kind for feature in features}
    if kinds - {Kind.OTHER, Kind.BUILDING} and not any("indoor" in properties_of(raw) for raw in found):
        features = [as_room(feature) for feature in features]
    if kinds - {Kind.OTHER}:
        features = [feature for feature in features if feature.kind is not Kind.OTHER]
    return replace(floor_sheet(features, path, level), to_open=TO_OPEN)


def as_room(feature: Feature) -> Feature:
    """Take an area with a name for a room: maps call rooms by their use, in words without number."""
    is_area = feature.shape.geom_type in ("Polygon", "MultiPolygon")
    is_room = feature.kind is Kind.OTHER and is_area and feature.name
    return replace(feature, kind=Kind.ROOM) if is_room else feature


def raw_features(collection: Json) -> list[Json]:
    """Return the features of a collection, or a single feature or geometry as one."""
    kind = collection.get("type")
    if kind == "Feature":
        return [collection]
    if kind == "FeatureCollection":
        return objects(collection.get("features"))
    is_geometry = "coordinates" in collection or "geometries" in collection
    return [{"type": "Feature", "geometry": collection}] if is_geometry else []


def imdf_levels(found: list[Json]) -> dict[str, str]:
    """Return the names of IMDF levels by their ids."""
    levels = [raw for raw in found if raw.get("feature_type") == "level"]
    names = {}
    for raw in levels:
        properties = properties_of(raw)
        name = text_of(properties.get("short_name")) or text_of(properties.get("name"))
        names[words(raw.get("id"))] = name or str(properties.get("ordinal", ""))
    return names


def properties_of(raw: Json) -> Json:
    """Return what a feature says of itself; converters keep the tags of OpenStreetMap by themselves."""
    properties = raw.get("properties")
    if not isinstance(properties, dict):
        return {}
    tags = properties.get("tags")
    return properties | tags if isinstance(tags, dict) else properties


def read_feature(raw: Json, index: int) -> Feature | None:
    """Read one feature; None if it draws nothing."""
    told = {key: text for key, value in properties_of(raw).items() if (text := text_of(value))}
    said = {form: text for key, text in told.items() for form in (key.lower(), "_".join(name_words(key)))}
    tags = said | ({"feature_type": standard} if (standard := words(raw.get("feature_type"))) else {})
    kind = kind_of(tags)
    shape = read_shape(raw.get("geometry"))
    if kind is None or shape is None:
        return None
    levels = levels_of(first(tags, LEVELS)) or tuple(filter(None, [first(tags, LEVEL_IDS)]))
    return Feature(
        shape,
        kind,
        levels,
        first(tags, NAMES),
        width=length_in_metres(tags.get("width", "")),
        source=f"feature {raw.get('id', index + 1)}",
        layer=tags.get("layer", ""),
    )


def first(tags: Tags, keys: Sequence[str]) -> str:
    """Return the first of some tags that is there."""
    return next((tags[key] for key in keys if key in tags), "")


def text_of(value: object) -> str:
    """Return a property as text; of texts in several languages the English one, else the first."""
    if isinstance(value, Mapping):
        return words(value.get("en")) or next(filter(None, map(words, value.values())), "")
    if isinstance(value, bool):
        return "yes" if value else "no"
    return str(value) if isinstance(value, str | int | float) else ""


def read_shape(raw: object) -> shapely.Geometry | None:
    """Read a geometry; None if it is none, or is damaged."""
    if not isinstance(raw, dict):
        return None
    try:
        shape = shapely.geometry.shape(raw)
    except DAMAGED:
        return None
    if shape.is_empty or not all(map(_finite, shape.bounds)):
        return None
    shape = shapely.force_2d(shape)
    return shape if shape.is_valid else shapely.make_valid(shape)


def _finite(value: float) -> bool:
    return abs(value) < 1e12
