"""Carry points between a building and its drawing by control points, triangle by triangle."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Self

import numpy as np
import shapely
from numpy.typing import NDArray

from pilotage.errors import FileError
from pilotage.evaluation.rooms import read_json
from pilotage.geometry import Array, Pose2, Similarity2, frozen_points
from pilotage.maps import SchematicMap

LEAST_HEIGHT = 0.3
"""Triangles flatter than this [m], along a straight wall, are left out: their maps mean nothing."""
MOST_STRETCH = 12.0
"""Triangles that the drawing stretches by more than this ratio are left out on the way back."""


@dataclass(frozen=True, eq=False)
class Patches:
    """Triangles, each with the affine map of its corners; a point in none takes the map of the nearest."""

    triangles: Array  # (k, 3, 2) corners
    maps: Array  # (k, 3, 2) of rows x, y, 1

    @classmethod
    def between(cls, triangles: Array, images: Array) -> Self:
        """Map the corners of triangles (k, 3, 2) to their images (k, 3, 2)."""
        return cls(triangles, np.asarray(np.linalg.solve(with_ones(triangles), images), dtype=np.float64))

    @cached_property
    def tree(self) -> shapely.STRtree:
        """The triangles, indexed."""
        return shapely.STRtree(shapely.polygons(self.triangles))

    def nearest(self, points: Array) -> NDArray[np.intp]:
        """Find the triangle of each point (n, 2), (n,)."""
        return np.asarray(self.tree.nearest(shapely.points(points)), dtype=np.intp)

    def carry(self, points: Array) -> Array:
        """Carry points (n, 2)."""
        return np.asarray(np.einsum("ni,nij->nj", with_ones(points), self.maps[self.nearest(points)]))


@dataclass(frozen=True, eq=False)
class Warp:
    """The truth about where a place of the building is on the drawing, where control points are close enough.

    Row by row, `in_world` [m] and `in_sketch` [drawing units, y up] are the same place (n >= 3, 2). Between
    them the map is affine over the Delaunay triangles of `in_world`; outside it goes on as in the nearest.

    >>> square = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]])
    >>> Warp(square, 10.0 * square).sketch_from_world(np.array([[1.0, 2.0]])).round(9).tolist()
    [[10.0, 20.0]]
    """

    in_world: Array
    in_sketch: Array

    def __post_init__(self) -> None:
        """Copy and freeze the points; reject fewer than three, and points on a line."""
        for name in ("in_world", "in_sketch"):
            object.__setattr__(self, name, frozen_points(getattr(self, name), name=name, at_least=3))
        if len(self.in_world) != len(self.in_sketch):
            raise ValueError(
                f"control points must come in pairs, got {len(self.in_world)} and {len(self.in_sketch)}"
            )
        if len(self.corners) == 0:
            raise ValueError(f"control points must span a triangle at least {LEAST_HEIGHT} m high")

    @cached_property
    def corners(self) -> NDArray[np.intp]:
        """The control points at the corners of each triangle that is not too flat, (k, 3)."""
        number_at = {(x, y): number for number, (x, y) in enumerate(self.in_world.tolist())}
        found = shapely.get_parts(shapely.delaunay_triangles(shapely.multipoints(self.in_world)))
        rings = shapely.get_coordinates(found).reshape(-1, 4, 2)[:, :3]
        sides = np.hypot(*(rings - np.roll(rings, 1, axis=1)).T).max(axis=0)
        kept = rings[2.0 * shapely.area(found) >= LEAST_HEIGHT * sides]
        return np.array(
            [[number_at[x, y] for x, y in ring] for ring in kept.tolist()], dtype=np.intp
        ).reshape(-1, 3)

    @cached_property
    def there(self) -> Patches:
        """From the world to the drawing."""
        return Patches.between(self.in_world[self.corners], self.in_sketch[self.corners])

    @cached_property
    def back(self) -> Patches:
        """From the drawing to the world; triangles that the drawing folds over or squeezes are left out."""
        linear = self.there.maps[:, :2]
        determinants, stretches = np.linalg.det(linear), np.linalg.cond(linear)
        main = np.sign(shapely.area(shapely.polygons(self.there.triangles)) @ determinants)
        chosen = self.corners[(np.sign(determinants) == main) & (stretches < MOST_STRETCH)]
        return Patches.between(self.in_sketch[chosen], self.in_world[chosen])

    def sketch_from_world(self, points: Array) -> Array:
        """Carry points (n, 2) [m] to the drawing."""
        return self.there.carry(points)

    def world_from_sketch(self, points: Array) -> Array:
        """Carry points (n, 2) of the drawing to the world [m]."""
        return self.back.carry(points)

    def sketch_from_base(self, world_from_base: Pose2) -> Similarity2:
        """Return where on the drawing a robot stands, its heading there, and the local scale."""
        here = np.array([world_from_base.position])
        linear = self.there.maps[self.there.nearest(here)[0], :2]
        x, y = self.sketch_from_world(here)[0].tolist()
        ahead = world_from_base.rotation[:, 0] @ linear
        scale = float(np.sqrt(abs(np.linalg.det(linear))))
        return Similarity2(scale, Pose2(x, y, float(np.arctan2(ahead[1], ahead[0]))))


def with_ones(points: Array) -> Array:
    """Append a one to each point (..., 2)."""
    return np.concatenate([points, np.ones((*points.shape[:-1], 1))], axis=-1)


def read_warp(path: Path, sketch: SchematicMap) -> Warp:
    """Read the control points of a drawing: `world` [m] and `sketch`, in the axes of the drawing's file."""
    try:
        pairs = read_json(path)["control_points"]
        in_world, in_file = (
            np.array([pair[side] for pair in pairs], dtype=np.float64) for side in ("world", "sketch")
        )
        return Warp(in_world, sketch.sketch_from_file(in_file))
    except (KeyError, TypeError, ValueError) as error:
        raise FileError(f"control points are pairs of `world` and `sketch` points ({error})", path) from error
