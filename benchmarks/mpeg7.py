"""Retrieve silhouettes by shape: the bull's-eye test of MPEG-7 CE-Shape-1, part B.

    python -m benchmarks mpeg7

Each of 1400 silhouettes in 70 classes of 20 is the query once. Counted is how many of its class are among the
40 least dissimilar of all, itself included. The measure of Latecki and Lakämper, eq. (2), is published with
76.45 % (Latecki, Lakämper and Eckhardt, CVPR 2000).

Two silhouettes are as unlike as they are at the best of three levels of evolution, one of them mirrored or
not. The combination of the paper is ten times as dear: it only puts the best 80 of eq. (2) in order again,
each at its best level.
"""

import argparse
import math
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from skimage.measure import find_contours

from benchmarks.lib.arguments import add_jobs, positive
from benchmarks.lib.data import DATA
from benchmarks.lib.results import Figures
from benchmarks.lib.tables import percent, table
from pilotage.contours import ArcSequence, Comparison, Measure
from pilotage.geometry import Array, Polyline
from pilotage.kernels.arc_correspondence import closed_dissimilarity
from pilotage.kernels.evolution_compiled import evolve_runs
from pilotage.kernels.steps import ArcSteps

IMAGES = DATA / "shapes" / "mpeg7"
PUBLISHED = 0.7645
RETRIEVED = 40  # silhouettes that a query may return
CLASS_SIZE = 20
LEVELS = (0.004, 0.006, 0.010)  # relevance at which the evolution stops [rad], perimeters made equal
RERANKED = 80  # best by eq. (2), compared by the combination too
BLOCK = 5  # queries a task
PAIRS = 200  # pairs a task

SETTINGS = Comparison()

Indices = NDArray[np.int64]
Task = TypeVar("Task")


@dataclass(frozen=True)
class Silhouette:
    """A contour at every level of evolution, and its mirror image."""

    label: str
    straight: tuple[ArcSteps, ...]
    mirrored: tuple[ArcSteps, ...]


def read_contour(path: Path) -> Polyline:
    """Trace the longest outline in an image, the silhouette on its left."""
    mask = np.pad(np.asarray(Image.open(path).convert("L")) > 0, 2).astype(float)
    outline = max(find_contours(mask, 0.5), key=len)[:-1, ::-1] * (1.0, -1.0)
    return Polyline(outline[::-1], closed=True)


def evolve(contour: Polyline, level: float) -> Polyline:
    """Simplify until every vertex is relevant in proportion to the perimeter."""
    starts, closed = np.array([0, len(contour)]), np.array([True])
    return contour.subset(
        np.flatnonzero(evolve_runs(contour.vertices, starts, closed, level * contour.length))
    )


def mirror(contour: Polyline) -> Polyline:
    """Flip left and right, the silhouette still on the left."""
    return Polyline(contour.vertices[::-1] * (-1.0, 1.0), contour.closed)


def read_silhouette(path: Path) -> Silhouette:
    """Trace, evolve and cut into arcs."""
    contour = read_contour(path)
    evolved = [evolve(contour, level) for level in LEVELS]
    return Silhouette(
        path.stem.rsplit("-", 1)[0],
        tuple(ArcSequence.of(line).steps(1.0) for line in evolved),
        tuple(ArcSequence.of(mirror(line)).steps(1.0) for line in evolved),
    )


def compare(a: ArcSteps, b: ArcSteps, measure: Measure) -> float:
    """Compare two contours by the settings that are the package's defaults."""
    return closed_dissimilarity(a, b, SETTINGS.largest_group, measure.value, SETTINGS.largest_run)


silhouettes: list[Silhouette] = []  # filled before the worker processes are forked off


def eq2_task(first: int) -> Array:
    """Compare a block of queries with all silhouettes from its first on: (b, m, levels x mirrored or not)."""
    return np.array(
        [
            [
                [
                    compare(straight, other, Measure.TANGENT)
                    for straight, *others in zip(a.straight, b.straight, b.mirrored, strict=True)
                    for other in others
                ]
                for b in silhouettes[first:]
            ]
            for a in silhouettes[first : first + BLOCK]
        ]
    )


def combination_task(pairs: Indices) -> Array:
    """Compare pairs, each with its best variant (p, 3), by the combination, (p,)."""
    costs = []
    for i, j, variant in pairs:
        level, is_mirrored = divmod(variant, 2)
        other = silhouettes[j].mirrored if is_mirrored else silhouettes[j].straight
        costs.append(compare(silhouettes[i].straight[level], other[level], Measure.COMBINED))
    return np.array(costs)


def run(
    title: str, work: Callable[[Task], Array], tasks: list[Task], efforts: list[int], processes: int
) -> Iterator[tuple[Task, Array]]:
    """Share tasks among processes, and tell how far they are."""
    started, done = time.monotonic(), 0
    with ProcessPoolExecutor(processes, mp_context=get_context("fork")) as pool:
        for task, effort, result in zip(tasks, efforts, pool.map(work, tasks), strict=True):
            done += effort
            elapsed = time.monotonic() - started
            progress = (
                f"{done / sum(efforts):4.0%}, {elapsed:4.0f} s of {elapsed * sum(efforts) / done:4.0f} s"
            )
            print(f"\r{title}: {progress} ", end="", flush=True)
            yield task, result
    print()


def compare_all(processes: int) -> tuple[Array, Indices]:
    """Compare all with all by eq. (2): least dissimilarities and the variants that gave them, (n, n) each."""
    n = len(silhouettes)
    costs, variants = np.zeros((n, n)), np.zeros((n, n), dtype=np.int64)
    firsts = list(range(0, n, BLOCK))
    for first, block in run(
        "eq. (2), all pairs", eq2_task, firsts, [n - first for first in firsts], processes
    ):
        rows = slice(first, first + len(block))
        costs[rows, first:], variants[rows, first:] = block.min(axis=2), block.argmin(axis=2)
        costs[first:, rows], variants[first:, rows] = costs[rows, first:].T, variants[rows, first:].T
    return costs, variants


def rank_again(ranking: Indices, variants: Indices, processes: int) -> Indices:
    """Put the first candidates of each query in the order of the combination; the rest stay behind them."""
    n = len(silhouettes)
    queries = np.repeat(np.arange(n), RERANKED)
    pairs = np.column_stack([queries, ranking[:, :RERANKED].ravel()])
    pairs = np.unique(np.sort(pairs, axis=1), axis=0)
    pairs = np.column_stack([pairs, variants[pairs[:, 0], pairs[:, 1]]])
    costs = np.zeros((n, n))
    tasks = np.array_split(pairs, math.ceil(len(pairs) / PAIRS))
    title = f"combination, {len(pairs)} pairs"
    for task, block in run(title, combination_task, tasks, [len(task) for task in tasks], processes):
        costs[task[:, 0], task[:, 1]] = costs[task[:, 1], task[:, 0]] = block
    order = np.argsort(np.take_along_axis(costs, ranking[:, :RERANKED], axis=1), axis=1, kind="stable")
    return np.take_along_axis(ranking, order, axis=1)


def score(ranking: Indices) -> float:
    """Count how many of a query's class are among the retrieved, as a share of all there are."""
    labels = np.array([silhouette.label for silhouette in silhouettes])
    return float((labels[ranking[:, :RETRIEVED]] == labels[:, None]).sum() / (len(labels) * CLASS_SIZE))


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose classes and processes."""
    parser.add_argument("--classes", type=positive, default=70, help="take only so many, evenly chosen")
    add_jobs(parser)


def measure(arguments: argparse.Namespace) -> Figures:
    """Run the test, print both shares and return them."""
    started = time.monotonic()
    paths = sorted(IMAGES.glob("*.gif"))
    if not paths:
        return {"failed": f"no silhouettes in {IMAGES}"}
    labels = sorted({path.stem.rsplit("-", 1)[0] for path in paths})
    chosen = {labels[k * len(labels) // arguments.classes] for k in range(arguments.classes)}
    paths = [path for path in paths if path.stem.rsplit("-", 1)[0] in chosen]
    silhouettes.extend(read_silhouette(path) for path in paths)
    print(f"{len(paths)} silhouettes of {len(chosen)} classes read in {time.monotonic() - started:.0f} s")
    for comparison in Measure:  # compiled once, before the processes part
        compare(silhouettes[0].straight[0], silhouettes[1].straight[0], comparison)

    costs, variants = compare_all(arguments.jobs)
    ranking = np.argsort(costs, axis=1, kind="stable")
    shares = {"eq2": score(ranking)}
    print(f"eq. (2) over arcs: {shares['eq2']:.2%} (published for all classes: {PUBLISHED:.2%})", flush=True)
    shares["combination"] = score(rank_again(ranking, variants, arguments.jobs))
    print(f"the paper's combination among the best {RERANKED} of each: {shares['combination']:.2%}")
    print(f"{time.monotonic() - started:.0f} s in all, {arguments.jobs} processes")
    return shares


def render(figures: Figures) -> str:
    """Write the table of README."""
    return table(
        ("MPEG-7 CE-Shape-1 part B, bull's-eye score", "share"),
        [
            (f"eq. (2) over arcs (published {percent(PUBLISHED, 2)})", percent(figures["eq2"], 1)),
            (
                f"the best {RERANKED} of each put in order by the paper's combination",
                percent(figures["combination"], 1),
            ),
        ],
    )
