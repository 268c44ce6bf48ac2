"""Compare divisions of a picture: those of people with cells."""

from pathlib import Path

import numpy as np
import shapely
from numpy.typing import NDArray
from PIL import Image, ImageDraw
from skimage.measure import label

from pilotage.maps import CellGraph

LEAST_PIXELS = 100
"""Pixels of a region below which it is not counted."""

HALF = 0.5
"""Share of its union with a room that a cell must have in common with it to be that room."""

Labels = NDArray[np.int64]


def read_gray(path: Path) -> NDArray[np.uint8]:
    """Read a picture, transparent pixels black."""
    image = Image.open(path).convert("RGBA")
    ground = Image.new("RGBA", image.size, (0, 0, 0, 255))
    return np.asarray(Image.alpha_composite(ground, image).convert("L"))


def rasterize(graph: CellGraph, shape: tuple[int, int]) -> Labels:
    """Give the pixels of each cell its number, from 1; 0 elsewhere. The drawing is in pixels, y up."""
    image = Image.new("I", (shape[1], shape[0]), 0)
    draw = ImageDraw.Draw(image)
    whole = [shapely.Polygon(cell.outline).area for cell in graph.cells]
    for index in np.argsort(whole)[::-1]:
        cell = graph.cells[index]
        draw.polygon(pixels(cell.outline), fill=int(index) + 1)
        for hole in cell.holes:
            draw.polygon(pixels(hole), fill=0)
    return np.asarray(image, dtype=np.int64)


def pixels(points: NDArray[np.float64]) -> list[tuple[float, float]]:
    """Carry points to the centers of pixels, y down."""
    return [(float(x) - 0.5, -float(y) - 0.5) for x, y in points]


def overlaps(rooms: Labels, cells: Labels) -> NDArray[np.float64]:
    """Count the pixels of each room and cell together, (rooms + 1, cells + 1)."""
    columns = int(cells.max()) + 1
    both = rooms.astype(np.int64) * columns + cells
    return (
        np.bincount(both.ravel(), minlength=(int(rooms.max()) + 1) * columns)
        .reshape(-1, columns)
        .astype(float)
    )


def precision_and_recall(table: NDArray[np.float64]) -> tuple[float, float]:
    """Average the best overlaps of cells and of rooms (Bormann et al. 2016)."""
    rooms = np.flatnonzero(table[1:].sum(axis=1) > LEAST_PIXELS) + 1
    cells = np.flatnonzero(table[:, 1:].sum(axis=0) > LEAST_PIXELS) + 1
    inner = table[np.ix_(rooms, cells)]
    precision = inner.max(axis=0) / table[:, cells].sum(axis=0)
    recall = inner.max(axis=1) / table[rooms].sum(axis=1)
    return float(precision.mean()), float(recall.mean())


def adjacent_rooms(free: NDArray[np.bool_], rooms: Labels) -> set[tuple[int, int]]:
    """Find the rooms that only a drawn line parts: it lies where the plan is free."""
    lines = label(free & (rooms == 0), connectivity=2)
    large = np.bincount(rooms.ravel()) > LEAST_PIXELS
    touched: dict[int, set[int]] = {}
    for down, right in [(0, 1), (1, 0), (1, 1), (1, -1)]:
        for sign in (1, -1):
            shifted = np.roll(rooms, (sign * down, sign * right), axis=(0, 1))
            pairs = np.unique(
                np.column_stack([lines[(lines > 0) & (shifted > 0)], shifted[(lines > 0) & (shifted > 0)]]),
                axis=0,
            )
            for line, room in pairs.tolist():
                if large[room]:
                    touched.setdefault(line, set()).add(room)
    return {(a, b) for met in touched.values() for a in met for b in met if a < b}


def edge_f1(graph: CellGraph, room_of: dict[int, int], adjacent: set[tuple[int, int]]) -> float:
    """Score gateways against the lines between rooms, as pairs of rooms; unknown cells are rooms below 0."""
    index = graph.index_from_id
    found = set()
    for gateway in graph.gateways:
        ends = sorted(room_of.get(index[name] + 1, -index[name] - 1) for name in gateway.cell_ids)
        found.add((ends[0], ends[1]))
    found = {pair for pair in found if pair[0] != pair[1]}
    count = len(found) + len(adjacent)
    return 2.0 * len(found & adjacent) / count if count else 1.0


def best_rooms(table: NDArray[np.float64]) -> dict[int, int]:
    """Tell the room that each cell overlaps most."""
    return {
        cell: int(table[1:, cell].argmax()) + 1 for cell in range(1, table.shape[1]) if table[1:, cell].any()
    }


def matched_rooms(table: NDArray[np.float64]) -> dict[int, int]:
    """Tell the room that each cell is, if they overlap by half of their union."""
    union = table.sum(axis=1, keepdims=True) + table.sum(axis=0, keepdims=True) - table
    fit = (table / np.maximum(union, 1.0))[1:, 1:]
    return {int(cell) + 1: int(room) + 1 for room, cell in np.argwhere(fit > HALF)}


def matthews(rooms: Labels, cells: Labels) -> float:
    """Average over rooms the correlation with the cell that fits best."""
    table = overlaps(rooms, cells)
    inside = table[1:, 1:]
    room_only = table[1:].sum(axis=1, keepdims=True) - inside
    cell_only = table[:, 1:].sum(axis=0, keepdims=True) - inside
    neither = table.sum() - inside - room_only - cell_only
    size = (inside + cell_only) * (inside + room_only) * (neither + cell_only) * (neither + room_only)
    return float(
        ((inside * neither - cell_only * room_only) / np.sqrt(np.maximum(size, 1.0))).max(axis=1).mean()
    )
