"""Buildings to drive in: the true world, its rooms, drawings of it, and what is true between the two."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Self

import numpy as np
import shapely
from numpy.typing import NDArray

from benchmarks.lib.data import DATA, HANDS, LOGS, PACKED_HANDS
from benchmarks.lib.worlds import world_of
from pilotage.evaluation.rooms import Rooms, read_drawn_rooms, read_world_rooms
from pilotage.evaluation.warp import Warp, read_warp
from pilotage.geometry import Array
from pilotage.io import open_map, open_world
from pilotage.io.tum import read_trajectory
from pilotage.maps import Atlas, AtlasSettings, build_atlas
from pilotage.simulation import World
from pilotage.worlds import PackedWorld

SAMPLES = 4000  # random poses of which those are kept that a robot can stand at
THERE_AND_BACK = 0.1  # [m] a place that the drawing folds over comes back from it farther off


@dataclass(frozen=True, eq=False)
class Drawing:
    """A drawing of a building, and where the building's places are on it."""

    hand: str
    atlas: Atlas
    warp: Warp
    rooms: Rooms  # as drawn, in the units and axes of its file

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read a drawing and the truth about it, which lies beside it as JSON."""
        sketch, truth = open_map(path), path.with_suffix(".json")
        atlas = build_atlas(sketch, AtlasSettings())
        return cls(path.stem, atlas, read_warp(truth, sketch), read_drawn_rooms(truth))

    def shows(self, points: Array, names: tuple[str, ...]) -> NDArray[np.bool_]:
        """Tell which points (n, 2) [m] of these rooms are drawn in that room and nowhere else, (n,)."""
        drawn = self.warp.sketch_from_world(points)
        found = self.claimed_rooms(drawn)
        off = np.hypot(*(self.warp.world_from_sketch(drawn) - points).T)
        same = np.array([a == b != "" for a, b in zip(found, names, strict=True)])
        return np.asarray(same & (off <= THERE_AND_BACK))

    def has_cell(self, points: Array) -> NDArray[np.bool_]:
        """Tell which points (n, 2) [m] are drawn inside a cell, (n,)."""
        drawn, graph = self.warp.sketch_from_world(points), self.atlas.cell_graph
        assert graph is not None  # all these drawings have cells
        cells = np.array([cell.polygon for cell in graph.cells])[graph.cell_indices_at(drawn)]
        return np.asarray(shapely.intersects_xy(cells, *drawn.T))

    def claimed_rooms(self, points: Array) -> tuple[str, ...]:
        """Name the drawn room of each point (n, 2) of the sketch, the empty name in none."""
        return self.rooms.names_at(self.atlas.sketch.file_from_sketch(points))


@dataclass(frozen=True, eq=False)
class Site:
    """A building with its drawings."""

    name: str
    world: World
    rooms: Rooms  # [m]
    poses: Array  # (n, 3) where a robot can stand [m, m, rad]
    drawings: tuple[Drawing, ...]

    @cached_property
    def drawing_by(self) -> dict[str, Drawing]:
        """The drawing of each hand."""
        return {drawing.hand: drawing for drawing in self.drawings}


def real_site(building: str) -> Site:
    """Read a real building: its world was made from its log, a robot can stand where the real one did."""
    folder = DATA / "sketches" / building
    return Site(
        building,
        open_world(world_of(building)),
        read_world_rooms(folder / "rooms.geojson"),
        read_trajectory(LOGS / f"{building}.truth.tum").poses,
        tuple(Drawing.read(folder / f"{hand}.svg") for hand in HANDS),
    )


def packed_site(packed: PackedWorld) -> Site:
    """Read a world of the package; a robot can stand anywhere in its rooms where there is space."""
    world, rooms = open_world(packed.world), read_world_rooms(packed.folder / "rooms.geojson")
    rng = np.random.default_rng(0)
    left, bottom, right, top = world.bounds
    poses = rng.uniform((left, bottom, -np.pi), (right, top, np.pi), (SAMPLES, 3))
    return Site(
        packed.name,
        world,
        rooms,
        poses,
        tuple(Drawing.read(packed.folder / f"{hand}.svg") for hand in PACKED_HANDS),
    )
