"""What a person says about a drawing where guessing fails, in a table beside the file.

Beside `office.dxf` it is called `office.dxf.toml`:

    page = 2                  # of a file with several; a level of an indoor map
    shading = "lines"         # of a picture: recognized, light-is-free, dark-is-free, lines

    [layers]                  # a layer, class, id or block name, and what its marks are
    A-FURN = "ignore"

    [labels]                  # names of rooms, in the axes of the file
    kitchen = [120, 80]
    WC = [[40, 20], [200, 20]]
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

from pilotage.errors import FileError, shown
from pilotage.interpretation import Role
from pilotage.io.raster import Shading
from pilotage.io.toml_files import read_toml

SUFFIX = ".toml"
"""Added to the name of a drawing, it is the name of its table."""

LARGEST_COORDINATE = 1e9
"""No drawing is larger."""

KEYS = ("page", "shading", "layers", "labels")

Point = tuple[float, float]
Choice = TypeVar("Choice", Role, Shading)


@dataclass(frozen=True, slots=True)
class DrawingHints:
    """What a person says about a drawing."""

    layers: Mapping[str, Role] = field(default_factory=dict)
    labels: tuple[tuple[str, Point], ...] = ()  # names of rooms, in the axes of the file
    page: str | None = None  # its number, from 1, or its name
    shading: Shading = Shading.RECOGNIZED

    def over(self, other: "DrawingHints") -> "DrawingHints":
        """Add what others say; where both speak, these hints win."""
        named = {name for name, _ in self.labels}
        return DrawingHints(
            {**other.layers, **self.layers},
            self.labels + tuple(label for label in other.labels if label[0] not in named),
            self.page if self.page is not None else other.page,
            self.shading if self.shading is not Shading.RECOGNIZED else other.shading,
        )


def table_beside(drawing: Path) -> Path:
    """Return where the table of a drawing is, if it has one; a page in the drawing's name is left out."""
    name = drawing.name if drawing.exists() else drawing.name.rpartition("#")[0] or drawing.name
    return drawing.parent / (name + SUFFIX)  # `.` has no name, and is refused later on


def read_hints(path: Path) -> DrawingHints:
    """Read the table beside a drawing.

    Raises FileError that names the key, the rule and the value.
    """
    tree = read_toml(path, "a table of hints")
    for key in tree:
        if key not in KEYS:
            raise FileError(f"a table of hints holds {', '.join(KEYS)}, not {key!r}", path)
    try:
        return DrawingHints(
            {name: role_of(name, role) for name, role in table_of(tree, "layers").items()},
            tuple(
                (name, point)
                for name, where in table_of(tree, "labels").items()
                for point in points_of(name, where)
            ),
            page_of(tree.get("page")),
            shading_of(tree.get("shading", Shading.RECOGNIZED.value)),
        )
    except ValueError as error:
        raise FileError(str(error), path) from error


def table_of(tree: Mapping[str, object], key: str) -> Mapping[str, object]:
    """Return a table in a table; an empty one if it is missing."""
    found = tree.get(key, {})
    if not isinstance(found, Mapping):
        raise ValueError(f"{key} must be a table, got {shown(found)}")  # noqa: TRY004  # read_hints names the file
    return found


def role_of(name: str, word: object) -> Role:
    """Read the role of a layer.

    Raises ValueError that lists the roles.
    """
    return chosen(Role, word, f"layer {name!r}")


def points_of(name: str, where: object) -> list[Point]:
    """Read where a label stands: a point, or several for rooms of one name."""
    several = where if isinstance(where, list) and where and isinstance(where[0], list) else [where]
    return [point_of(name, one) for one in several]


def point_of(name: str, where: object) -> Point:
    """Read a point."""
    if isinstance(where, list) and len(where) == 2 and all(map(is_coordinate, where)):
        return float(where[0]), float(where[1])
    raise ValueError(f"label {name!r} must stand at a point [x, y], got {shown(where)}")


def is_coordinate(value: object) -> bool:
    """Tell whether a value is a number that can stand on a drawing."""
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= LARGEST_COORDINATE


def page_of(value: object) -> str | None:
    """Read a page: a number or a name."""
    if value is None or (isinstance(value, str) and value):
        return value
    if isinstance(value, int) and not isinstance(value, bool) and value >= 0:
        return str(value)
    raise ValueError(f"page must be a number or a name, got {shown(value)}")


def shading_of(word: object) -> Shading:
    """Read a shading.

    Raises ValueError that lists them.
    """
    return chosen(Shading, word, "shading")


def chosen(kind: type[Choice], word: object, what: str) -> Choice:
    """Find the member of an enumeration by its value.

    Raises ValueError that lists the members.
    """
    for member in kind:
        if word == member.value:
            return member
    raise ValueError(f"{what} must be one of {', '.join(member.value for member in kind)}, got {shown(word)}")
