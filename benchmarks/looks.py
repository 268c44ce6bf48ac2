"""Rank the rooms of a drawing by one look, and tell how often the right one is first or among the first five.

    python -m benchmarks looks

A look is a single scan, or the scans of the last 5 or 10 m joined by registration. No motion before it, no
start and no scale are known: this is the evidence alone, without a filter. Rooms are ranked by the evidence
of the places in them, as the search of the localizer finds it: ranges as log-ratios to those of any building.
So many proposals are tried that it is the evidence that counts and not the search (decision 0025).
Drawings are `freehand`, the ladder of deformation, `schematic`, and the sketches of thirteen people. Looks in
rooms that a drawing leaves out are not counted.
"""

import argparse
from collections.abc import Iterator

import numpy as np

from benchmarks.lib.arguments import add_names, positive
from benchmarks.lib.data import BUILDINGS
from benchmarks.lib.looks import looks_of
from benchmarks.lib.people import SKETCHED, SKETCHES
from benchmarks.lib.protocols import Sketch, sketch_of, travel_of
from benchmarks.lib.results import Figures
from benchmarks.lib.rungs import PREFIX, rung_name
from pilotage.localization.global_search import Keyframe, global_search
from pilotage.localization.prior import Prior
from pilotage.localization.sensor_model import SensorModel, SensorSettings

DRAWINGS = ("freehand", "schematic", "ladder-0.5", "ladder-1", "people")
LENGTHS = {"scan": 0.0, "map5": 5.0, "map10": 10.0}  # [m]
LOOKS, PROPOSALS = 12, 100_000
FIRST = 5

Ranks = dict[str, list[int]]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose drawings and the number of looks."""
    add_names(parser, "--drawings", DRAWINGS)
    add_names(parser, "--buildings", BUILDINGS)
    parser.add_argument("--looks", type=positive, default=LOOKS, help="for each log (default: %(default)s)")
    parser.add_argument(
        "--people", type=positive, default=1, help="drawings of each rung (default: %(default)s)"
    )
    parser.add_argument(
        "--proposals", type=positive, default=PROPOSALS, help="places tried (default: %(default)s)"
    )


def measure(arguments: argparse.Namespace) -> Figures:
    """Rank the rooms of all drawings, print a line for each kind, and return the figures."""
    print(
        f"{'drawing':12s}" + "".join(f"{name + suffix:>10s}" for name in LENGTHS for suffix in ("", " of 5"))
    )
    rows: Figures = {}
    for kind in arguments.drawings:
        ranks: Ranks = {name: [] for name in LENGTHS}
        for building, hand in drawings_of(kind, arguments.buildings, arguments.people):
            for name, found in ranks_on(building, hand, arguments.looks, arguments.proposals).items():
                ranks[name] += found
        rows[kind] = {
            name: [float(np.mean(np.array(found) < limit)) for limit in (1, FIRST)]
            for name, found in ranks.items()
        }
        print(
            f"{kind:12s}" + "".join(f"{share:10.2f}" for pair in rows[kind].values() for share in pair),
            flush=True,
        )
    return rows


def drawings_of(kind: str, buildings: list[str], people: int) -> Iterator[tuple[str, str]]:
    """List the drawings of a kind."""
    if kind == "people":
        yield from ((SKETCHED, number) for number in SKETCHES)
    elif kind == "freehand":
        yield "belgioioso", kind
    elif kind == "schematic":
        yield from ((building, kind) for building in buildings)
    else:
        severity = float(kind.removeprefix(f"{PREFIX}-"))
        yield from ((name, rung_name(severity, person)) for name in buildings for person in range(people))


def ranks_on(building: str, hand: str, count: int, proposals: int) -> Ranks:
    """Rank the true room of each look on one drawing; 0 is first."""
    sketch, travel = sketch_of(building, hand), travel_of(building, hand)
    model = SensorModel(sketch.atlas, SensorSettings())
    ranks: Ranks = {name: [] for name in LENGTHS}
    for number, look in enumerate(looks_of(building, count)):
        truth = travel.truths[look.scan]
        if truth in sketch.rooms.names:
            for name, metres in LENGTHS.items():
                rng = np.random.default_rng(number)
                scores = rank_rooms(look.last(metres), sketch, model, proposals, rng)
                ranks[name].append(sum(score > scores[truth] for score in scores.values()))
    return ranks


def rank_rooms(
    window: tuple[Keyframe, ...],
    sketch: Sketch,
    model: SensorModel,
    proposals: int,
    rng: np.random.Generator,
) -> dict[str, float]:
    """Return the log-evidence of each drawn room."""
    found = global_search(window, model, Prior(), proposals, rng)
    names = np.array(sketch.rooms.names_at(sketch.atlas.sketch.file_from_sketch(found.states[:2].T)))
    return {name: found.members(np.flatnonzero(names == name)).log_mass for name in set(sketch.rooms.names)}
