"""Correct drawings of six real buildings after their logs, and tell how far walls are from the true ones.

    python -m benchmarks corrected

The whole log of a building is localized on a drawing, told neither start nor heading nor scale, and the
drawing is corrected. Points along the drawn walls that the robot saw are compared with their true places,
known by control points: the drawing after the best similarity to the truth, the corrected drawing after the
best rigid motion, as its unit is the metre. The gap is the distance to the nearest laser hit at the true
poses, whatever it shows. Defaults were chosen on aces, belgioioso, csail and freiburg-079, but `schematic` of
fhw and of freiburg-101 were in view as well; their other drawings are held out. What was seen along a log
is kept in a cache folder while the code that makes it stays the same. `--figure` draws the first drawing, its
correction and the true walls: docs/images/corrected.png is `schematic` of freiburg-079.
"""

import argparse
import hashlib
import pickle
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import platformdirs
from PIL import Image

from benchmarks.lib.arguments import add_drawings, add_jobs
from benchmarks.lib.data import BUILDINGS, HANDS, LOGS, ROOT, drawing_of, drawings
from benchmarks.lib.occupancy import PIXEL
from benchmarks.lib.results import Figures, means_of_groups
from benchmarks.lib.tables import prose, table
from benchmarks.lib.worlds import OCCUPIED, world_of
from pilotage.correction import NothingBelievedError, Sighting, append_sighting, correct_drawing
from pilotage.evaluation.walls import TrueWalls
from pilotage.evaluation.warp import read_warp
from pilotage.figures.corrected import corrected_figure
from pilotage.figures.style import save
from pilotage.geometry import Array
from pilotage.io import open_log, open_map
from pilotage.io.files import replacing
from pilotage.io.map_server import read_entries
from pilotage.localization import Localizer
from pilotage.maps import AtlasSettings, SchematicMap, build_atlas

STORE = platformdirs.user_cache_path("pilotage") / "sightings"

HEAD = f"{'building':13s}{'hand':11s}{'before':>8s}{'after':>8s}{'ratio':>7s}{'gap before':>12s}{'after':>8s}"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose drawings."""
    add_drawings(parser, BUILDINGS, HANDS)
    add_jobs(parser)
    parser.add_argument("--figure", type=Path, help="draw the first drawing and its correction here")


def measure(arguments: argparse.Namespace) -> Figures:
    """Correct all drawings, print a line for each, and return the figures."""
    tasks = drawings(arguments.buildings, arguments.hands)
    for building in arguments.buildings:
        world_of(building)
    print(HEAD)
    rows: Figures = {}
    for (building, hand), row in zip(tasks, all_rows(tasks, arguments.jobs), strict=True):
        rows.setdefault(building, {})[hand] = row
        print(line(building, hand, row), flush=True)
    means = means_of_groups(rows, arguments.buildings, arguments.hands)
    for name, by_hand in means.items():
        for hand, row in by_hand.items():
            print(line(name.replace("_", " "), hand, row))
    if arguments.figure is not None:
        draw(*tasks[0], arguments.figure)
    return {**rows, **means}


def all_rows(tasks: list[tuple[str, str]], jobs: int) -> Iterator[Figures]:
    """Score drawings in their order, in several processes."""
    with ProcessPoolExecutor(jobs, mp_context=get_context("fork")) as pool:
        yield from pool.map(row_of, *zip(*tasks, strict=True))


def row_of(building: str, hand: str) -> Figures:
    """Localize along a log, correct the drawing, and score it; without a correction it stays as it is."""
    sketch, truth = with_truth(building, hand)
    before, gap_before = truth.error_of_drawing(), truth.gap_of_drawing()
    row = {"before_m": before, "after_m": before, "gap_before_m": gap_before, "gap_after_m": gap_before}
    try:
        corrected = correct_drawing(build_atlas(sketch, AtlasSettings()), kept_sightings(building, hand))
    except NothingBelievedError:
        return {**row, "corrected": 0.0}
    places = corrected.metres_from_sketch @ truth.in_sketch
    return {**row, "after_m": truth.error_of(places), "gap_after_m": truth.gap_of(places), "corrected": 1.0}


def with_truth(building: str, hand: str) -> tuple[SchematicMap, TrueWalls]:
    """Read a drawing, and where its walls truly are."""
    path = drawing_of(building, hand)
    sketch = open_map(path)
    return sketch, TrueWalls.of(sketch, read_warp(path.with_suffix(".json"), sketch), hits_in(building))


def draw(building: str, hand: str, path: Path) -> None:
    """Draw a drawing beside its correction, which lies on the true walls."""
    sketch, truth = with_truth(building, hand)
    corrected = correct_drawing(build_atlas(sketch, AtlasSettings()), kept_sightings(building, hand))
    hits = truth.hits_beside(corrected.metres_from_sketch @ truth.in_sketch)
    save(corrected_figure(sketch, corrected, true_hits=hits), path)


def kept_sightings(building: str, hand: str) -> list[Sighting]:
    """Take the sightings of a log from the store if the code that makes them has not changed since."""
    kept = STORE / code_key() / f"{building}-{hand}.pickle"
    if kept.exists():
        return list(pickle.loads(kept.read_bytes()))  # noqa: S301  # written below
    sightings = sightings_of(building, hand)
    with replacing(kept) as beside:
        beside.write_bytes(pickle.dumps(sightings))
    return sightings


def sightings_of(building: str, hand: str) -> list[Sighting]:
    """Localize along a whole log."""
    localizer = Localizer(open_map(drawing_of(building, hand)))
    sightings: list[Sighting] = []
    for reading in open_log(LOGS / f"{building}.log.gz"):
        localizer.update(reading.scan, reading.odometry)
        append_sighting(sightings, localizer, reading.scan)
    return sightings


def code_key() -> str:
    """Hash the code that sightings depend on."""
    files = [ROOT / "src/pilotage/correction/sighting.py"]
    for package in ("kernels", "geometry", "shape", "perception", "scan_matching", "maps", "localization"):
        files += sorted((ROOT / "src/pilotage" / package).rglob("*.py"))
    return hashlib.sha256(b"".join(file.read_bytes() for file in files)).hexdigest()[:16]


def hits_in(building: str) -> Array:
    """Return the middles of occupied pixels in a building's world, (m, 2) [m]."""
    path = world_of(building)
    entries = read_entries(path)
    shades = np.array(Image.open(path.parent / entries["image"]))[::-1]
    left, bottom = (float(word) for word in entries["origin"].strip("[]").split(",")[:2])
    return (np.argwhere(shades == OCCUPIED)[:, ::-1] + 0.5) * PIXEL + (left, bottom)


def line(building: str, hand: str, row: Figures) -> str:
    """Format the figures of one drawing, or of a mean."""
    return (
        f"{building:13s}{hand:11s}{row['before_m']:8.2f}{row['after_m']:8.2f}"
        f"{row['after_m'] / row['before_m']:7.2f}{row['gap_before_m']:12.2f}{row['gap_after_m']:8.2f}"
    )


def render(figures: Figures) -> str:
    """Write the table of README."""
    rows = []
    for hand in figures["mean"]:
        cells = [f"`{hand}`"]
        for name in ("tuned", "held_out"):
            row = figures.get(name, {}).get(hand)
            cells.append("-" if row is None else f"{row['before_m']:.2f} m, {row['after_m']:.2f} m")
        ratios = {
            building: figures[building][hand]["after_m"] / figures[building][hand]["before_m"]
            for building in BUILDINGS
            if hand in figures.get(building, {})
        }
        worst = max(ratios, key=lambda building: ratios[building])
        halved = sum(ratio <= 0.5 for ratio in ratios.values())
        cells += [f"{halved} of {len(ratios)}", f"{worst}: {ratios[worst]:.2f}"]
        row = figures["mean"][hand]
        cells.append(f"{row['gap_before_m']:.2f} m, {row['gap_after_m']:.2f} m")
        rows.append(tuple(cells))
    return "\n".join(
        [
            prose(
                "How far walls that the robot saw are from their true places, in the drawing at its best"
                " scale and in the drawing as corrected after the log of the building. Defaults were chosen"
                " with `schematic` of the held-out buildings in view, too. Where believed places contradict"
                f" each other nothing is corrected ({left_as_drawn(figures)})."
            ),
            "",
            table(
                (
                    "drawings",
                    "before and after, tuned buildings",
                    "held-out buildings",
                    "halved",
                    "worst ratio",
                    "to the nearest true surface, before and after",
                ),
                rows,
            ),
        ]
    )


def left_as_drawn(figures: Figures) -> str:
    """Name the drawings that were not corrected, by hand."""
    left: dict[str, list[str]] = {}
    for building in BUILDINGS:
        for hand, row in figures.get(building, {}).items():
            if not row["corrected"]:
                left.setdefault(hand, []).append(building)
    return "; ".join(f"{' and '.join(names)}, `{hand}`" for hand, names in left.items()) or "none of these"
