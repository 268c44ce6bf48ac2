"""Score cells against people's divisions of floor plans, sketches and drawings.

Floor plans (Bormann et al. 2016): recall of a room is its largest overlap with a cell over its area,
precision of a cell its largest overlap with a room over its area; both averaged over a plan, then over plans.
Regions of up to 100 pixels are left out, as there. Both are counted over the pixels that the ground truth
calls free, so that a cell may lie under furniture, as a room does.

Edges: each cell stands for the room it overlaps most; the pairs of rooms that gateways join are compared with
the pairs that a drawn line across a doorway parts. "strict": a cell stands for a room only if they overlap by
half of their union, and every other gateway is wrong.

Sketches (Mielle et al. 2018): the Matthews correlation of a room with the cell that fits it best, averaged.

Drawings: the share of drawn rooms that overlap with one cell by half of their union, the share of which one
cell holds four fifths, and how much of a room all cells cover.

The defaults were chosen on the TUNING plans and the even sketches, marked t, and by eye on drawings; the rest
is reported beside all.
"""

import argparse
import json
import time
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shapely
from numpy.typing import NDArray
from PIL import Image, ImageDraw
from skimage.measure import label

from pilotage.io.maps import open_map
from pilotage.maps import CellGraph, DecompositionSettings, decompose

SHARED = Path(__file__).resolve().parents[1] / ".." / "shared" / "data"
TUNING = ("Freiburg79_scan", "lab_a_scan", "lab_c_scan", "office_b", "office_d")
LEAST_PIXELS = 100
FREE, SKETCH_FREE = 250, 230
HALF, MOST = 0.5, 0.8

Labels = NDArray[np.int64]


@dataclass(frozen=True)
class PlanScore:
    """How one floor plan went."""

    name: str
    cells: int
    rooms: int
    precision: float
    recall: float
    edge_f1: float
    strict_edge_f1: float
    seconds: float


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


def score_plan(name: str, suffix: str) -> PlanScore:
    """Divide a floor plan and compare it with its rooms."""
    folder = SHARED / "rooms"
    start = time.perf_counter()
    graph = decompose(open_map(folder / f"{name}{suffix}.png"), DecompositionSettings())
    seconds = time.perf_counter() - start
    truth = read_gray(folder / f"{name}_gt_segmentation.png") > FREE
    rooms = label(truth, connectivity=2)
    table = overlaps(rooms, np.where(truth, rasterize(graph, truth.shape), 0))
    precision, recall = precision_and_recall(table)
    adjacent = adjacent_rooms(read_gray(folder / f"{name}.png") > FREE, rooms)
    count = int((table[1:].sum(axis=1) > LEAST_PIXELS).sum())
    best, strict = (edge_f1(graph, rooms_of(table), adjacent) for rooms_of in (best_rooms, matched_rooms))
    return PlanScore(name, len(graph.cells), count, precision, recall, best, strict, seconds)


def score_plans(title: str, suffix: str) -> dict[str, float]:
    """Print a table of plans, and return their means."""
    names = sorted(
        path.name.removesuffix("_gt_segmentation.png") for path in (SHARED / "rooms").glob("*_gt_*")
    )
    scores = [score_plan(name, suffix) for name in names]
    print(f"\n{title}\n  plan               cells rooms precision  recall  edge F1   strict      s")
    for score in scores:
        mark = "t" if score.name in TUNING else " "
        print(
            f"{mark} {score.name:18} {score.cells:5} {score.rooms:5} {score.precision:9.3f} "
            f"{score.recall:7.3f} {score.edge_f1:8.3f} {score.strict_edge_f1:8.3f} {score.seconds:6.2f}"
        )
    for group, chosen in (
        ("all", scores),
        ("held back", [score for score in scores if score.name not in TUNING]),
    ):
        print(f"  mean of {group}: {mean_line(chosen)}")
    return means(scores)


def means(scores: Iterable[PlanScore]) -> dict[str, float]:
    """Average over plans; the slowest plan's seconds."""
    chosen = list(scores)
    return {
        "precision": float(np.mean([score.precision for score in chosen])),
        "recall": float(np.mean([score.recall for score in chosen])),
        "edge_f1": float(np.mean([score.edge_f1 for score in chosen])),
        "strict_edge_f1": float(np.mean([score.strict_edge_f1 for score in chosen])),
        "seconds_max": max(score.seconds for score in chosen),
    }


def mean_line(scores: Iterable[PlanScore]) -> str:
    """Write means in one line."""
    return ", ".join(f"{name} {value:.3f}" for name, value in means(scores).items())


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


def score_sketches() -> dict[str, float]:
    """Print and return how cells of people's sketches agree with two people, and these with each other."""
    rows = []
    print(f"\nSketches by people\n  {'sketch':8} {'cells':>5} {'a':>6} {'b':>6} {'a-b':>6}")
    for number in range(13):
        path = SHARED / "people-sketches" / f"{number:02d}.png"
        graph = decompose(open_map(path), DecompositionSettings())
        a, b = (
            label(read_gray(path.with_name(f"{number:02d}_rooms_{who}.png")) > SKETCH_FREE, connectivity=1)
            for who in "ab"
        )
        height, width = min(a.shape[0], b.shape[0]), min(a.shape[1], b.shape[1])
        cells = rasterize(graph, read_gray(path).shape)
        a, b, cells = (picture[:height, :width] for picture in (a, b, cells))
        cells = np.where((a > 0) | (b > 0), cells, 0)
        rows.append((matthews(a, cells), matthews(b, cells), (matthews(a, b) + matthews(b, a)) / 2.0))
        print(
            f"{' ' if number % 2 else 't'} {number:02d}       {len(graph.cells):5} "
            + " ".join(f"{value:6.3f}" for value in rows[-1])
        )
    mean = np.mean(rows, axis=0)
    print(f"  mean of all: {mean.round(3)}, held back: {np.mean(rows[1::2], axis=0).round(3)}")
    return {"mcc_a": float(mean[0]), "mcc_b": float(mean[1]), "annotators": float(mean[2])}


def score_drawings() -> None:
    """Print how many of the drawn rooms are one cell."""
    print("\nDrawings\n  drawing                  rooms cells  is one  in one covered      s")
    rows = []
    for path in sorted((SHARED / "sketches").glob("*/*.svg")):
        sketch = open_map(path)
        start = time.perf_counter()
        graph = decompose(sketch, DecompositionSettings())
        seconds = time.perf_counter() - start
        cells = np.array([cell.polygon for cell in graph.cells])
        drawn = json.loads(path.with_suffix(".json").read_text())["rooms"].values()
        rooms = [shapely.make_valid(shapely.Polygon(np.array(room) * (1, -1))) for room in drawn]
        common = np.array([shapely.area(shapely.intersection(cells, room)) for room in rooms])
        own = shapely.area(rooms)[:, None]
        fit = (common / (own + shapely.area(cells) - common)).max(axis=1)
        held = (common / own).max(axis=1)
        rows.append(((fit > HALF).mean(), (held > MOST).mean(), (common.sum(axis=1) / own[:, 0]).mean()))
        name = f"{path.parent.name}/{path.stem}"
        shares = " ".join(f"{share:7.2f}" for share in rows[-1])
        print(f"  {name:24} {len(rooms):5} {len(cells):5} {shares} {seconds:6.2f}")
    print(f"  mean: {np.mean(rows, axis=0).round(3)}")


def main() -> None:
    """Print all scores."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--json", type=Path, help="write the means to this file")
    target = parser.parse_args().json
    result = {
        "empty": score_plans("Empty floor plans", ""),
        "furnished": score_plans("Furnished floor plans", "_furnitures"),
        "sketches": score_sketches(),
    }
    score_drawings()
    if target is not None:
        target.write_text(json.dumps(result, indent=2) + "\n")


if __name__ == "__main__":
    main()
