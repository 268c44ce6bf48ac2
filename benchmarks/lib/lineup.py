"""Drawings of several buildings as files, among which one has to be chosen, and logs made in them."""

import itertools
from collections.abc import Iterator, Sequence
from pathlib import Path

import shapely

from benchmarks.lib.data import HANDS, PEOPLE, drawing_of, drawings
from benchmarks.lib.protocols import travel_of
from benchmarks.lib.rungs import rung_name, rung_of
from pilotage.evaluation.deformation import Plan
from pilotage.evaluation.episodes import spread_episodes
from pilotage.io import write_log
from pilotage.io.files import write_text

SEVERITIES = (0.25, 0.5, 0.75, 1.0)
MARGIN = 5.0  # [m] of travel in a file beyond what is looked at: odometry and truth differ


def line_up(folder: Path, buildings: Sequence[str], count: int) -> dict[Path, str]:
    """Choose drawings, those of people first, then of the ladder; return the building of each file.

    Drawings of the ladder are written to the folder, by persons 0, 1, ... at all severities.
    """
    made = (drawing_of(*one) for one in drawings(list(buildings), [*HANDS, *PEOPLE]))
    chosen: dict[Path, str] = {}
    for path in itertools.chain(made, rungs(folder, buildings)):
        if len(chosen) == count:
            break
        chosen[path] = path.parent.name
    return chosen


def rungs(folder: Path, buildings: Sequence[str]) -> Iterator[Path]:
    """Write drawings of the ladder without end, in a folder for each building."""
    for person in itertools.count():
        for severity, building in itertools.product(SEVERITIES, buildings):
            hand = rung_name(severity, person)
            path = folder / building / f"{hand}.svg"
            path.parent.mkdir(exist_ok=True)
            write_svg(path, rung_of(building, hand))
            yield path


def write_svg(path: Path, plan: Plan) -> None:
    """Write the strokes of a plan, and nothing else that is known of it."""
    flipped = shapely.transform(plan.strokes, lambda points: points * (1.0, -1.0))
    left, top, right, bottom = flipped.bounds
    lines = "".join(
        f'<polyline points="{" ".join(f"{x:.2f},{y:.2f}" for x, y in line.coords)}"/>'
        for line in flipped.geoms
    )
    box = f"{left:.2f} {top:.2f} {right - left:.2f} {bottom - top:.2f}"
    style = 'fill="none" stroke="black" stroke-width="1"'
    write_text(
        path, f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}"><g {style}>{lines}</g></svg>\n'
    )


def write_pieces(folder: Path, building: str, count: int, travel: float) -> list[Path]:
    """Write pieces of a building's log, whose starts are spread evenly, as logs of their own."""
    log = travel_of(building, HANDS[0])
    paths = []
    for number, piece in enumerate(spread_episodes(log.positions, count, travel + MARGIN)):
        paths.append(folder / f"{building}-{number}.log.gz")
        write_log(paths[-1], log.readings[piece.first : piece.last + 1])
    return paths
