"""A drawing of a building, as a person made it."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
import shapely

from pilotage.geometry import Array, Homography, Polyline, segments_of
from pilotage.maps.file_axes import FileAxes
from pilotage.maps.zones import Zones

Place = tuple[float, float]
"""A point of a drawing, y up [drawing units]."""


@dataclass(frozen=True, slots=True)
class Label:
    """A word on the drawing and where it stands."""

    text: str
    position: tuple[float, float]  # [drawing units], y up
    told: bool = False  # by a person, instead of what is written in the same room


@dataclass(frozen=True, slots=True)
class SchematicMap:
    """The strokes of a drawing in its own arbitrary units, y up (readers flip), and what is marked on it."""

    strokes: tuple[Polyline, ...]
    start: tuple[float, float] | None = None
    goal: tuple[float, float] | None = None
    labels: tuple[Label, ...] = ()
    source: str = ""
    y_down: bool = False  # whether the y axis of the source file points down, as in SVG and in pictures
    contours: bool = False  # whether the strokes are contours of free space, as in filled plans, not of a pen
    solids: tuple[Polyline, ...] = ()  # rings of thick walls, by the even-odd rule
    metres_per_unit: float | None = None  # what the file says of its scale; localization does not use it
    zones: Zones = field(default_factory=Zones)  # where not to drive, or only in one way
    photo_from_sketch: Homography | None = None  # to the photo that was straightened, y up in both
    doors: tuple[Polyline, ...] = ()  # from hinge to latch, where a leaf or its swing is drawn
    openings: tuple[Polyline, ...] = ()  # doors that the file itself tells, from jamb to jamb
    unread: tuple[tuple[float, float], ...] = ()  # where something is written that could not be read

    def __post_init__(self) -> None:
        """Reject a drawing without a stroke."""
        if not self.strokes:
            raise ValueError("a drawing needs at least one stroke, got none")

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Left, bottom, right and top of the strokes [drawing units]."""
        points = np.vstack([stroke.vertices for stroke in self.strokes])
        (left, bottom), (right, top) = points.min(axis=0), points.max(axis=0)
        return float(left), float(bottom), float(right), float(top)

    @property
    def diagonal(self) -> float:
        """Length of the diagonal of the bounds: the drawing's own unit of size [drawing units]."""
        left, bottom, right, top = self.bounds
        return float(np.hypot(right - left, top - bottom))

    @property
    def segments(self) -> Array:
        """All segments of all strokes, (n, 4) as x1, y1, x2, y2 [drawing units]."""
        return segments_of(self.strokes)

    @property
    def file_axes(self) -> FileAxes:
        """How the source file tells places."""
        return FileAxes(self.y_down, self.photo_from_sketch)

    def file_from_sketch(self, points: Array) -> Array:
        """Carry points (n, 2) from the sketch (y up) to the axes of the source file."""
        return self.file_axes.from_sketch(points)

    def sketch_from_file(self, points: Array) -> Array:
        """Carry points (n, 2) from the axes of the source file to the sketch (y up)."""
        return self.file_axes.to_sketch(points)

    def carried(
        self, line: Callable[[Polyline], Polyline], place: Callable[[Place], Place]
    ) -> "SchematicMap":
        """Carry all that is drawn and marked elsewhere, by what becomes of a line and of a place."""
        return replace(
            self,
            strokes=tuple(map(line, self.strokes)),
            solids=tuple(map(line, self.solids)),
            zones=Zones(*(tuple(map(line, lines)) for lines in self.zones.lines)),
            doors=tuple(map(line, self.doors)),
            openings=tuple(map(line, self.openings)),
            start=self.start and place(self.start),
            goal=self.goal and place(self.goal),
            labels=tuple(replace(label, position=place(label.position)) for label in self.labels),
            unread=tuple(map(place, self.unread)),
        )

    def mirrored(self) -> "SchematicMap":
        """Return the mirror image, left for right; places are told in the axes of the same file."""
        left, _, right, _ = self.bounds
        mirror = Homography(((-1.0, 0.0, left + right), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))
        photo = (
            Homography.from_matrix(np.eye(3)) if self.photo_from_sketch is None else self.photo_from_sketch
        )
        image = self.carried(
            lambda line: Polyline(mirror.points(line.vertices), line.closed),
            lambda here: (left + right - here[0], here[1]),
        )
        return replace(
            image,
            strokes=tuple(line.reversed() for line in image.strokes),  # free space stays on the left
            solids=tuple(line.reversed() for line in image.solids),
            photo_from_sketch=Homography.from_matrix(photo.matrix @ mirror.matrix),
        )


def diameter_of(points: Array) -> float:
    """Measure between the two points (n, 2) that are farthest apart.

    That of a rectangle is its diagonal; unlike the bounds' it does not change when the drawing is turned.

    >>> diameter_of(np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 4.0], [0.0, 4.0]]))
    5.0
    """
    corners = shapely.get_coordinates(shapely.convex_hull(shapely.multipoints(points)))
    gaps = corners[:, None] - corners[None]
    return float(np.hypot(gaps[..., 0], gaps[..., 1]).max())
