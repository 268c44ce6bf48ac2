"""A drawing as its file tells it: marks and words in paint order, before anything is understood."""

from dataclasses import dataclass
from enum import Enum

from pilotage.geometry import Homography, Polyline

Color = tuple[float, float, float]
"""Red, green and blue from 0 to 1."""

BLACK: Color = (0.0, 0.0, 0.0)
WHITE: Color = (1.0, 1.0, 1.0)

Bounds = tuple[float, float, float, float]
"""Left, bottom, right and top [drawing units], y up."""

GAP = "leave a gap"
"""How one makes a door in a wall that is drawn."""


class Role(Enum):
    """What a mark is taken for."""

    WALL = "wall"
    DOOR = "door"  # a leaf and its arc: where it stands is an opening
    WINDOW = "window"  # closes a wall
    STAIRS = "stairs"  # nothing that a robot drives on
    FLOOR = "floor"  # the color of a room
    FURNITURE = "furniture"
    LABEL = "label"
    KEEP_OUT = "keep-out"  # an area in which the robot never drives
    SLOW = "slow"  # an area in which it drives slowly
    ONE_WAY = "one-way"  # an arrow across a gateway that is passed only this way
    START = "start"
    GOAL = "goal"
    IGNORE = "ignore"  # dimension lines, frames, symbols


@dataclass(frozen=True, slots=True)
class Pen:
    """How a line is drawn."""

    color: Color = BLACK
    width: float = 0.0  # [drawing units]; 0 is a hairline, as thin as the device draws
    dashed: bool = False


@dataclass(frozen=True, slots=True)
class Mark:
    """One shape of a drawing. Later marks lie over earlier ones."""

    outlines: tuple[Polyline, ...]  # its subpaths, curves cut into chords [drawing units], y up
    pen: Pen | None = None  # None: no line
    fill: Color | None = None  # None: no area. Areas follow the even-odd rule
    names: tuple[str, ...] = ()  # of layers, groups, classes, ids and blocks, the outermost first
    groups: tuple[
        int, ...
    ] = ()  # numbers of the groups and block insertions that hold it, the outermost first
    source: str = ""  # where in the file, as a person can find it: "<path id=p7>", "ARC 2F on A-DOOR"


@dataclass(frozen=True, slots=True)
class Text:
    """A run of words on one line, as it is written. Lines that belong together are joined later."""

    text: str
    position: tuple[float, float]  # its middle [drawing units], y up
    height: float = 0.0  # of a capital letter's line [drawing units]; 0 if the file does not tell
    angle: float = 0.0  # of the baseline [rad], counter-clockwise on the page; nan if it is not known
    names: tuple[str, ...] = ()
    groups: tuple[int, ...] = ()
    source: str = ""


@dataclass(frozen=True, slots=True)
class Sheet:
    """All that was painted, first to last, and what the file says about itself."""

    marks: tuple[Mark, ...]
    texts: tuple[Text, ...] = ()
    page: Bounds | None = None  # the paper, if the file has one
    background: Color = WHITE
    metres_per_unit: float | None = None  # what the file claims; a prior on scale, never believed
    y_down: bool = False  # whether the y axis of the source file points down
    source: str = ""  # path of the file
    photo_from_sheet: Homography | None = None  # to the photo that was straightened, y up in both
    openings: tuple[Polyline, ...] = ()  # doors that the file itself tells, from jamb to jamb
    to_open: str = GAP  # how one makes a door in a wall of such a file
    left_out: tuple[str, ...] = ()  # what the reader could not read, in words: "2 embedded pictures"
    unread: tuple[tuple[float, float], ...] = ()  # where something is written that could not be read
