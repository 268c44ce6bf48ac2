"""What an indoor map says of a place: a room, a wall, a door, and on which level.

Tags are those of OpenStreetMap's Simple Indoor Tagging and of the Indoor Mapping Data Format (IMDF).
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import Enum

import shapely

from pilotage.interpretation.names import SPACES, meaning_of, name_words
from pilotage.interpretation.sheet import Role

Tags = Mapping[str, str]


class Kind(Enum):
    """What a feature is; the value is its name on the sheet."""

    ROOM = "room"
    CORRIDOR = "corridor"  # no wall where it borders on a corridor or an area
    AREA = "area"  # no walls of its own
    WALL = "wall"
    COLUMN = "column"
    OPENING = "door"
    STAIRS = "stairs"
    ELEVATOR = "elevator"
    FURNITURE = "furniture"
    BUILDING = "building"
    OTHER = ""  # of a map that is not an indoor map


@dataclass(frozen=True, slots=True)
class Feature:
    """A place with what is said of it; its coordinates are those of the file."""

    shape: shapely.Geometry
    kind: Kind
    levels: tuple[str, ...] = ()  # none: on all of them
    name: str = ""
    width: float | None = None  # of an opening [m]
    source: str = ""
    layer: str = ""  # of the drawing that a map was made of


ROOMS = {
    "stairs": Kind.STAIRS,
    "steps": Kind.STAIRS,
    "escalator": Kind.STAIRS,
    "staircase": Kind.STAIRS,
    "elevator": Kind.ELEVATOR,
    "corridor": Kind.CORRIDOR,
    "walkway": Kind.CORRIDOR,
    "column": Kind.COLUMN,
}
"""Kinds of rooms (OSM `room`, IMDF `category`) that are more than a room."""

INDOOR = {
    "room": Kind.ROOM,
    "corridor": Kind.CORRIDOR,
    "area": Kind.AREA,
    "wall": Kind.WALL,
    "column": Kind.COLUMN,
    "pillar": Kind.COLUMN,
    "door": Kind.OPENING,
    "yes": Kind.AREA,
}
"""Values of OSM's `indoor`; `buildingpart` of older maps has the same."""

IMDF = {
    "unit": Kind.ROOM,
    "opening": Kind.OPENING,
    "fixture": Kind.FURNITURE,
    "kiosk": Kind.FURNITURE,
    "section": None,
    "geofence": None,
    "footprint": None,
    "level": None,
    "venue": None,
    "building": None,
    "address": None,
    "amenity": None,
    "anchor": None,
    "occupant": None,
    "detail": None,
    "relationship": None,
}
"""Feature types of IMDF; those without a kind draw no walls."""

OTHERS = {
    ("highway", "elevator"): Kind.ELEVATOR,
    ("highway", "steps"): Kind.STAIRS,
    ("barrier", "wall"): Kind.WALL,
    ("building", "*"): Kind.BUILDING,
    ("osmAG:type", "area"): Kind.ROOM,
    ("osmAG:type", "passage"): Kind.OPENING,
    ("osmAG:furniture_type", "*"): Kind.FURNITURE,
}
"""Tags of OSM and of osmAG, area graphs for robots, that tell what a feature is where `indoor` does not."""

TYPES = (
    "feature_type",
    "objecttype",
    "object_type",
    "type",
    "typ",
    "tipo",
    "art",
    "kind",
    "class",
    "use_type",
    "room_type",
    "category",
)
"""Where maps that keep to no standard say what a feature is, in words."""

CALLED = {
    **dict.fromkeys(SPACES, Kind.ROOM),
    **dict.fromkeys(("corridor", "hallway", "walkway", "flur", "gang", "couloir", "pasillo"), Kind.CORRIDOR),
    **dict.fromkeys(("building", "envelope", "gebäude"), Kind.BUILDING),
    **dict.fromkeys(("elevator", "lift", "aufzug", "ascenseur", "ascensor"), Kind.ELEVATOR),
    **dict.fromkeys(("opening", "entrance"), Kind.OPENING),
    **dict.fromkeys(("column", "pillar"), Kind.COLUMN),
}
"""What these words call a feature, beside those for walls, doors, stairs and furniture."""

ROLES = {
    Role.WALL: Kind.WALL,
    Role.WINDOW: Kind.WALL,  # closes it
    Role.DOOR: Kind.OPENING,
    Role.STAIRS: Kind.STAIRS,
    Role.FURNITURE: Kind.FURNITURE,
}

LEVEL_RANGE = re.compile(r"(-?\d+)\s*-\s*(-?\d+)")
MOST_LEVELS = 200
"""Levels of a range at most."""


def kind_of(tags: Tags) -> Kind | None:
    """Tell what a feature is from its tags; None if it is nothing of a floor plan."""
    feature_type = tags.get("feature_type", "")
    if feature_type in IMDF:
        kind, category = IMDF[feature_type], tags.get("category", "")
        is_wall = kind is Kind.FURNITURE and category == "wall"
        return Kind.WALL if is_wall else ROOMS.get(category, kind) if kind is Kind.ROOM else kind
    if any(tags.get(key, "no") != "no" for key in ("door", "entrance")):
        return Kind.OPENING
    indoor = INDOOR.get(tags.get("indoor", tags.get("buildingpart", "")))
    if tags.get("stairs") == "yes" and indoor is not None:
        return Kind.STAIRS
    if indoor is not None:
        return ROOMS.get(tags.get("room", ""), indoor) if indoor is Kind.ROOM else indoor
    found = next((kind for (key, value), kind in OTHERS.items() if matches(tags, key, value)), None)
    return found or next(filter(None, (kind_called(tags.get(key, "")) for key in TYPES)), Kind.OTHER)


def kind_called(words: str) -> Kind | None:
    """Tell what a feature is from what a map calls it, by the last word that says something.

    >>> [kind_called(words) for words in ("Interior Wall", "door", "building_envelope", "Laboratory")]
    [<Kind.WALL: 'wall'>, <Kind.OPENING: 'door'>, <Kind.BUILDING: 'building'>, None]
    """
    for word in reversed(name_words(words)):
        role = meaning_of(word)
        kind = CALLED.get(word) or (None if role is None else ROLES.get(role))
        if kind is not None:
            return kind
    return None


def matches(tags: Tags, key: str, value: str) -> bool:
    """Tell whether a tag has a value; "*" stands for any but "no"."""
    return tags.get(key, "no") != "no" if value == "*" else tags.get(key) == value


def levels_of(text: str) -> tuple[str, ...]:
    """Return the levels of a list or a range.

    >>> levels_of("0;1"), levels_of("-1-1"), levels_of("1.0")
    (('0', '1'), ('-1', '0', '1'), ('1',))
    """
    return tuple(dict.fromkeys(level for part in re.split("[;,]", text) for level in level_range(part)))


def level_range(part: str) -> Iterator[str]:
    """Return the levels of one part of a list."""
    part = part.strip()
    match = LEVEL_RANGE.fullmatch(part)
    if match is not None:
        first, last = int(match[1][:6]), int(match[2][:6])
        yield from (str(level) for level in range(first, min(last, first + MOST_LEVELS) + 1))
    elif part:
        yield part.removesuffix(".0")
