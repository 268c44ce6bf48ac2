"""Carry a robot to another room while it localizes, and tell how soon it notices and finds itself again.

    python -m benchmarks kidnap

On draftsman drawings of three buildings a robot is told nothing. As soon as it is sure (above 0.9) and right
it is set down more than 10 m away in another room: the log goes on elsewhere, odometry without a jump.
Counted is the travel until the old place is doubted (probability below 0.5, or another place is claimed), and
until the claim is right and stays right for 5 m more. After 40 m it counts as never; then the median takes
40 m for it. False alarms: how often the probability of a right place fell below 0.5 after it had been sure
and right, per km, in the episodes of `localization` on the same drawings.
"""

import argparse
import math
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context

import numpy as np

from benchmarks.lib.arguments import add_drawings, add_jobs, positive
from benchmarks.lib.data import drawings
from benchmarks.lib.protocols import LENGTH, Task, all_traces, follow_all, sketch_of, travel_of
from benchmarks.lib.results import Figures
from benchmarks.lib.tables import prose, table
from benchmarks.localization import EPISODES
from pilotage.evaluation.episodes import (
    Trace,
    continued,
    false_alarms,
    first_found,
    follow,
    meters_to_doubt,
    meters_to_right,
    moved_elsewhere,
)
from pilotage.localization import Localizer

BUILDINGS = ("freiburg-079", "csail", "fhw")
HANDS = ("draftsman",)
AWAY = 10.0  # [m]
TAUGHT = 80.0  # [m] of travel after which a robot that was never sure and right is given up


@dataclass(frozen=True, slots=True)
class Attempt:
    """A robot that is to be kidnapped."""

    building: str
    hand: str
    number: int  # of how many
    count: int


@dataclass(frozen=True, slots=True)
class Outcome:
    """The result of a kidnap; a distance is inf if it never happened."""

    attempt: Attempt
    to_doubt: float  # [m]
    to_right: float  # [m]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose drawings and the number of kidnaps."""
    add_drawings(parser, BUILDINGS, HANDS)
    parser.add_argument(
        "--kidnaps", type=positive, default=30, help="for each drawing (default: %(default)s)"
    )
    parser.add_argument(
        "--episodes", type=positive, default=EPISODES, help="without kidnap (default: %(default)s)"
    )
    add_jobs(parser)


def measure(arguments: argparse.Namespace) -> Figures:
    """Make all kidnaps, print a line for each building, and return the figures."""
    chosen = drawings(arguments.buildings, arguments.hands)
    attempts = [
        Attempt(building, hand, number, arguments.kidnaps)
        for building, hand in chosen
        for number in range(arguments.kidnaps)
    ]
    sketch_of(*chosen[0])  # compiles, before processes part
    with ProcessPoolExecutor(arguments.jobs, mp_context=get_context("fork")) as pool:
        outcomes = [outcome for outcome in pool.map(kidnap, attempts) if outcome is not None]
    tasks = [Task(building, hand, arguments.episodes) for building, hand in chosen]
    alarms = [false_alarms(trace) for trace in all_traces(follow_all(tasks, arguments.jobs, reuse=True))]
    print(f"{'':24s}{'kidnaps':>8s}{'m to doubt, 90 %':>18s}{'never':>7s}{'m to right':>12s}{'never':>7s}")
    figures = row_of("all", outcomes)
    figures["buildings"] = {
        f"{building}/{hand}": row_of(
            f"{building}/{hand}",
            [one for one in outcomes if (one.attempt.building, one.attempt.hand) == (building, hand)],
        )
        for building, hand in chosen
    }
    count, meters = (float(sum(values)) for values in zip(*alarms, strict=True))
    figures["false_alarms_per_km"] = 1000.0 * count / meters if meters > 0.0 else None
    figures["false_alarms"], figures["unkidnapped_m"] = int(count), meters
    print(f"false alarms: {count:.0f} in {meters:.0f} m without kidnap")
    return figures


def kidnap(attempt: Attempt) -> Outcome | None:
    """Teach a robot its place, carry it away, and see what it claims; None if it could not be taught."""
    rng = np.random.default_rng(attempt.number)
    travel, sketch = travel_of(attempt.building, attempt.hand), sketch_of(attempt.building, attempt.hand)
    localizer = Localizer(sketch.atlas, seed=attempt.number)
    start = travel.way[-1] * attempt.number / (attempt.count + 1)
    index = int(np.searchsorted(travel.way, start))
    taken = None
    while index < len(travel.way) and travel.way[index] - start <= TAUGHT:
        told = one_scan(index)
        trace = follow(localizer, travel.readings[told], travel.truths[told], travel.way[told], sketch.rooms)
        if first_found(trace) is not None:
            taken = index
            break
        index += 1
    if taken is None:
        return None
    places = moved_elsewhere(
        travel.positions, drawn(travel.truths, sketch.rooms.names), taken, away=AWAY, length=LENGTH
    )
    if len(places) == 0:
        return None
    new = int(rng.choice(places))
    last = int(np.searchsorted(travel.way, travel.way[new] + LENGTH))
    chosen = slice(new, min(last, len(travel.way) - 1) + 1)
    readings = continued(travel.readings[chosen], travel.readings[taken])
    trace = follow(localizer, readings, travel.truths[chosen], travel.way[chosen], sketch.rooms)
    return outcome_of(attempt, trace)


def one_scan(index: int) -> slice:
    """Return the slice of one scan."""
    return slice(index, index + 1)


def drawn(truths: Sequence[str], names: Sequence[str]) -> list[str]:
    """Forget the rooms that the drawing does not show."""
    return [name if name in names else "" for name in truths]


def outcome_of(attempt: Attempt, trace: Trace) -> Outcome:
    """Score what was claimed after a kidnap."""
    return Outcome(attempt, meters_to_doubt(trace), meters_to_right(trace))


def row_of(title: str, outcomes: Sequence[Outcome]) -> Figures:
    """Print one line and return its figures."""
    if not outcomes:
        return {"kidnaps": 0, "m_to_doubt": None, "m_to_right": None}
    doubts, rights = (
        np.minimum([getattr(one, name) for one in outcomes], LENGTH) for name in ("to_doubt", "to_right")
    )
    row: Figures = {
        "kidnaps": len(outcomes),
        "m_to_doubt": [float(np.median(doubts)), float(np.quantile(doubts, 0.9))],
        "m_to_right": float(np.median(rights)),
        "never_doubted": sum(math.isinf(one.to_doubt) for one in outcomes),
        "never_right": sum(math.isinf(one.to_right) for one in outcomes),
    }
    median, p90 = row["m_to_doubt"]
    print(
        f"{title:24s}{len(outcomes):8d}{f'{median:.1f}, {p90:.1f}':>18s}{row['never_doubted']:7d}"
        f"{row['m_to_right']:12.1f}{row['never_right']:7d}",
        flush=True,
    )
    return row


def render(figures: Figures) -> str:
    """Write the table of README."""
    rows = [
        (
            name,
            str(row["kidnaps"]),
            "{:.1f} m, {:.1f} m".format(*row["m_to_doubt"]),
            f"{row['m_to_right']:.1f} m",
            str(row["never_right"]),
        )
        for name, row in (("all", figures), *figures["buildings"].items())
        if row["kidnaps"]
    ]
    return "\n".join(
        [
            prose(
                "A robot that was sure of its place and right is carried more than 10 m away to another room,"
                " unseen by its odometry, and travels 40 m from there. False alarms, right places that were"
                f" doubted without a kidnap: {figures['false_alarms']} in {figures['unkidnapped_m']:.0f} m."
            ),
            "",
            table(
                (
                    "drawing",
                    "kidnaps",
                    "travel until the old place is doubted, median and 90 %",
                    "until the right room is found for good, median",
                    "not within 40 m",
                ),
                rows,
            ),
        ]
    )
