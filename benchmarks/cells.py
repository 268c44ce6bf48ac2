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

The defaults of merging were searched on the TUNING plans and the even sketches, marked t, then rounded with a
look at all; those of free space were set by eye on drawings. The rest is reported beside all. Seconds are of
the processor, from opening the file to the cells.
"""

import argparse
import json
import time
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import shapely
from skimage.measure import label

from benchmarks.lib.data import DATA
from benchmarks.lib.division import (
    HALF,
    LEAST_PIXELS,
    adjacent_rooms,
    best_rooms,
    edge_f1,
    matched_rooms,
    matthews,
    overlaps,
    precision_and_recall,
    rasterize,
    read_gray,
)
from benchmarks.lib.results import Figures
from benchmarks.lib.tables import percent, prose, table
from pilotage.io.maps import open_map
from pilotage.maps import DecompositionSettings, decompose

TUNING = ("Freiburg79_scan", "lab_a_scan", "lab_c_scan", "office_b", "office_d")
FREE, SKETCH_FREE = 250, 230
MOST = 0.8


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


def score_plan(name: str, suffix: str) -> PlanScore:
    """Divide a floor plan and compare it with its rooms."""
    folder = DATA / "rooms"
    start = time.process_time()
    graph = decompose(open_map(folder / f"{name}{suffix}.png"), DecompositionSettings())
    seconds = time.process_time() - start
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
    names = sorted(path.name.removesuffix("_gt_segmentation.png") for path in (DATA / "rooms").glob("*_gt_*"))
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


def score_sketches() -> dict[str, float]:
    """Print and return how cells of people's sketches agree with two people, and these with each other."""
    rows = []
    print(f"\nSketches by people\n  {'sketch':8} {'cells':>5} {'a':>6} {'b':>6} {'a-b':>6}")
    for number in range(13):
        path = DATA / "people-sketches" / f"{number:02d}.png"
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


def score_drawings() -> dict[str, float]:
    """Print and return how many of the drawn rooms are one cell."""
    print("\nDrawings\n  drawing                  rooms cells  is one  in one covered      s")
    rows = []
    for path in sorted((DATA / "sketches").glob("*/*.svg")):
        sketch = open_map(path)
        start = time.process_time()
        graph = decompose(sketch, DecompositionSettings())
        seconds = time.process_time() - start
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
    is_one, in_one, covered = np.mean(rows, axis=0).tolist()
    print(f"  mean: is one {is_one:.3f}, in one {in_one:.3f}, covered {covered:.3f}")
    return {"is_one": is_one, "in_one": in_one, "covered": covered}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """There is nothing to choose."""


def measure(_arguments: argparse.Namespace) -> Figures:
    """Print all scores, and return the means."""
    return {
        "empty": score_plans("Empty floor plans", ""),
        "furnished": score_plans("Furnished floor plans", "_furnitures"),
        "sketches": score_sketches(),
        "drawings": score_drawings(),
    }


def render(figures: Figures) -> str:
    """Write the table of README."""
    rows = [
        (
            f"11 {name} floor plans",
            f"{row['precision']:.2f}",
            f"{row['recall']:.2f}",
            f"{row['edge_f1']:.2f}",
            f"{row['seconds_max']:.1f} s",
        )
        for name, row in figures.items()
        if name in {"empty", "furnished"}
    ]
    sketches, drawings = figures["sketches"], figures["drawings"]
    return "\n".join(
        [
            "Cells against the rooms that people see in floor plans.",
            "",
            table(("what", "precision", "recall", "F1 of connections", "slowest plan"), rows),
            "",
            prose(
                "In 13 sketches by people the Matthews correlation of cells with the rooms of two people is"
                f" {sketches['mcc_a']:.2f} and {sketches['mcc_b']:.2f}; the two agree with each other by"
                f" {sketches['annotators']:.2f}. Of the drawn rooms of six buildings"
                f" {percent(drawings['is_one'])} are one cell."
            ),
        ]
    )
