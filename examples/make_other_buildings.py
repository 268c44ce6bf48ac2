"""Draw floor plans of buildings that do not exist: the sheet by which the localizer knows other buildings.

    python examples/make_other_buildings.py src/pilotage/localization/other_buildings.csv

A corridor runs along each building. What lies beside it is cut into rooms, and where it is deep, a corridor
across is cut into it first. All walls are lines, all doors are gaps.
"""

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from pilotage.geometry import Array

SEEDS = (8, 23)
APART = 5.0  # [m] between two buildings on the sheet

Point = tuple[float, float]
Wall = tuple[float, float, float, float]  # x1, y1, x2, y2 [m]


@dataclass(frozen=True)
class Block:
    """A rectangle beside a corridor, in its own axes: x along the corridor, y away from it."""

    origin: Point
    along: Point  # unit vectors
    away: Point
    length: float  # [m] along the corridor
    depth: float  # [m]

    def wall(self, start: Point, end: Point) -> Wall:
        """Return a wall between two points of the block."""
        return (*self.place(start), *self.place(end))

    def place(self, point: Point) -> Point:
        """Return where a point of the block is in the building."""
        (x, y), (ax, ay), (bx, by) = point, self.along, self.away
        return self.origin[0] + x * ax + y * bx, self.origin[1] + x * ay + y * by


def floor_plan(rng: np.random.Generator) -> list[Wall]:
    """Draw a building."""
    length, depth = np.exp(rng.uniform(np.log([20.0, 12.0]), np.log([70.0, 45.0]))).tolist()
    width = rng.uniform(3.5, 8.0) if rng.random() < 1 / 3 else rng.uniform(1.6, 3.5)
    low = rng.uniform(0.15, 0.85) * (depth - width)
    outline = Block((0.0, 0.0), (1.0, 0.0), (0.0, 1.0), length, depth)
    below = Block((length, low), (-1.0, 0.0), (0.0, -1.0), length, low)
    above = Block((0.0, low + width), (1.0, 0.0), (0.0, 1.0), length, depth - low - width)
    return [*around(outline), *divided(below, rng), *divided(above, rng)]


def around(block: Block) -> list[Wall]:
    """Draw the outer walls."""
    right, top = block.length, block.depth
    corners = [(0.0, 0.0), (right, 0.0), (right, top), (0.0, top)]
    return [block.wall(one, other) for one, other in zip(corners, [*corners[1:], corners[0]], strict=True)]


def divided(block: Block, rng: np.random.Generator, level: int = 0) -> list[Wall]:
    """Divide a block: by a corridor across if it is large, else into rooms."""
    if block.depth < 2.0:
        return [block.wall((0.0, 0.0), (block.length, 0.0))]
    if block.depth < 11.0 or block.length < 14.0 or level == 3:
        return rooms(block, rng)
    width = rng.uniform(1.6, 3.2)
    left = rng.uniform(0.2, 0.8) * (block.length - width)
    right = left + width
    ax, ay = block.away
    backward = (-block.along[0], -block.along[1])
    before = Block(block.place((left, 0.0)), (ax, ay), backward, block.depth, left)
    behind = Block(
        block.place((right, block.depth)), (-ax, -ay), block.along, block.depth, block.length - right
    )
    fronts = [block.wall((0.0, 0.0), (left, 0.0)), block.wall((right, 0.0), (block.length, 0.0))]
    return [*fronts, *divided(before, rng, level + 1), *divided(behind, rng, level + 1)]


def rooms(block: Block, rng: np.random.Generator) -> list[Wall]:
    """Cut a block into a row of rooms, each with a door to the corridor."""
    count = max(1, round(block.length / float(np.exp(rng.uniform(np.log(2.8), np.log(9.0))))))
    inner = (np.arange(1, count) + rng.uniform(-0.2, 0.2, count - 1)) / count
    cuts = [0.0, *(inner * block.length).tolist(), block.length]
    walls = [block.wall((x, 0.0), (x, block.depth)) for x in cuts[1:-1]]
    begin = 0.0
    for left, right in pairwise(cuts):
        door = rng.uniform(0.8, 1.3)
        hinge = rng.choice([left + 0.3, (left + right - door) / 2, right - 0.3 - door])
        if right - left < door + 0.6 or rng.random() < 0.05:
            continue  # nobody enters here
        if rng.random() < 0.05:
            hinge, door = left + 0.2, right - left - 0.4  # open to the corridor
        walls.append(block.wall((begin, 0.0), (hinge, 0.0)))
        begin = hinge + door
    return [*walls, block.wall((begin, 0.0), (block.length, 0.0))]


def sheet(seeds: Sequence[int]) -> Array:
    """Draw buildings side by side, (n, 4) as x1, y1, x2, y2 [m]."""
    plans, left = [], 0.0
    for seed in seeds:
        plan = np.array(floor_plan(np.random.default_rng(seed)))
        plans.append(plan + np.array([left, 0.0, left, 0.0]))
        left += plan[:, [0, 2]].max() + APART
    return np.vstack(plans)


if __name__ == "__main__":
    np.savetxt(sys.argv[1], sheet(SEEDS), fmt="%.2f", delimiter=",")
