"""Drive to goals on drawings of buildings, and print how often the robot gets there.

    python -m benchmarks navigation

The true worlds of six real buildings were made from their logs (worlds_from_logs.py). In each the robot is
sent from room to room with three drawings: with its start marked on the drawing (known), and without
(unknown). The packed worlds have drawings, furniture and people of their own; there the start is unknown.

A drive has reached its goal if the robot stopped of its own accord in the right room, within 1.5 m of the
marked point (carried over by the control points) or within 10 % of the room's longer side. The path ratio is
the way driven over the shortest in the true world, median over the drives that reached their goal; "lost" and
"found again" are means over drives; "right room" is the share of steps at which the place claimed lies in
the drawn room where the robot truly is, of those in rooms that are drawn. Milliseconds are of the processor,
median and 95th percentile over all steps of all drives.
Intervals are 95 % bootstrap intervals over drives.
"""

import argparse
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import replace
from functools import partial
from itertools import product
from multiprocessing import get_context
from pathlib import Path

import numpy as np

from benchmarks.lib.arguments import add_drawings, add_jobs, add_names, positive, seconds
from benchmarks.lib.data import PACKED_HANDS, TUNED
from benchmarks.lib.drives import Job, Options, Result, make, sites
from benchmarks.lib.errands import choose_errands
from benchmarks.lib.results import Figures
from benchmarks.lib.sites import packed_site, real_site
from benchmarks.lib.tables import number, percent, percent_in, prose, table
from pilotage.config import Settings
from pilotage.evaluation.intervals import bootstrap_interval
from pilotage.worlds import ALL

MODES = {"known": "known_start", "unknown": "unknown_start", "packed": "packed"}

Row = dict[str, object]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose drives, and what is kept of each."""
    add_drawings(parser)
    add_names(parser, "--modes", tuple(MODES))
    parser.add_argument("--pairs", type=positive, default=6, help="drives a drawing (default: %(default)s)")
    parser.add_argument("--only", type=int, help="make only the drive of this number of each drawing")
    add_jobs(parser)
    parser.add_argument("--seed", type=int, default=0, help="(default: %(default)s)")
    parser.add_argument("--time-limit", type=seconds, default=300.0, help="[s] (default: %(default)s)")
    parser.add_argument("--journal", type=Path, help="folder for a journal of every drive")
    parser.add_argument("--figure", type=Path, help="folder for a picture of every drive")


def measure(arguments: argparse.Namespace) -> Figures:
    """Make all drives, print the tables, and return the figures."""
    settings = Settings()
    navigator = replace(settings.navigator, time_limit=arguments.time_limit)
    options = Options(
        arguments.seed, replace(settings, navigator=navigator), arguments.journal, arguments.figure
    )
    jobs = list(plan(arguments))
    warm_up(jobs[0], options)
    results = run(jobs, options, arguments.jobs)
    rows = {
        MODES[mode]: tables_of(mode, [result for result in results if result.job.mode == mode])
        for mode in dict.fromkeys(job.mode for job in jobs)
    }
    print_reasons(results)
    if complaints := [result.complaint for result in results if result.complaint]:
        return {**rows, "failed": f"{len(complaints)} drives, the first: {complaints[0]}"}
    return rows


def plan(arguments: argparse.Namespace) -> Iterator[Job]:
    """Open the buildings, and list the drives to be made."""
    real = [mode for mode in arguments.modes if mode != "packed"]
    opened = [
        (partial(real_site, building), real, arguments.hands) for building in arguments.buildings if real
    ]
    if "packed" in arguments.modes:
        opened += [(partial(packed_site, packed), ["packed"], PACKED_HANDS) for packed in ALL]
    for opening, modes, hands in opened:
        began = time.perf_counter()
        site = opening()
        sites[site.name] = site
        errands = choose_errands(site, arguments.pairs, arguments.seed)
        ways = ", ".join(f"{errand.shortest:.0f}" for errand in errands)
        seconds = time.perf_counter() - began
        print(f"{site.name}: {len(errands)} errands of {ways} m; {seconds:.1f} s", flush=True)
        for mode, hand, (index, errand) in product(modes, hands, enumerate(errands)):
            if arguments.only in {None, index}:
                yield Job(mode, site.name, hand, index, errand)


def warm_up(job: Job, options: Options) -> None:
    """Compile what is compiled once, before the processes part."""
    short = replace(options.settings, navigator=replace(options.settings.navigator, time_limit=5.0))
    make(job, replace(options, settings=short, journal=None, figure=None))


def run(jobs: Sequence[Job], options: Options, processes: int) -> list[Result]:
    """Share drives among processes, and tell how each went; results come in the order of jobs."""
    began = time.monotonic()
    with ProcessPoolExecutor(processes, mp_context=get_context("fork")) as pool:
        futures = [pool.submit(make, job, options) for job in jobs]
        for count, future in enumerate(as_completed(futures), 1):
            head = f"[{count}/{len(jobs)}, {time.monotonic() - began:.0f} s]"
            print(f"{head} {told(future.result())}", flush=True)
        return [future.result() for future in futures]


def told(result: Result) -> str:
    """Write how a drive went in one line."""
    job, scored = result.job, result.score
    head = f"{job.name} {job.errand.start_room} to {job.errand.goal_room}: {result.reason}"
    if scored is None:
        return head
    return (
        f"{head}; {scored.miss:.1f} m off, {scored.way:.0f} m driven ({scored.way_ratio:.2f} x), "
        f"{scored.minutes:.1f} min, {scored.collisions} collisions, lost {scored.times_lost}, found again "
        f"{scored.times_recovered}, right room {result.right_room:.0%}, "
        f"{scored.ms_median:.0f}/{scored.ms_p95:.0f} ms; {result.seconds:.0f} s"
    )


COLUMNS = (
    ("minutes", 8, 1),
    ("lost", 6, 1),
    ("recovered", 12, 1),
    ("right_room", 11, 2),
    ("ms_median", 5, 0),
    ("ms_p95", 5, 0),
)
HEAD = (
    f"{'':24s}{'drives':>7s}{'reached':>19s}{'collisions':>11s}{'path ratio':>20s}{'minutes':>8s}{'lost':>6s}"
    f"{'found again':>12s}{'right room':>11s}{'ms':>5s}{'p95':>5s}"
)


def tables_of(mode: str, results: Sequence[Result]) -> Row:
    """Print the table of a mode, and return its figures: by hand, or those of all packed worlds."""
    print(f"\n{MODES[mode].replace('_', ' ')}\n{HEAD}")
    if mode == "packed":
        hands = {hand: hand_rows(hand, own) for hand, own in by_hand(results).items()}
        return {**row_of("  all", results), "hands": hands}
    hands = {}
    for hand, own in by_hand(results).items():
        hands[hand] = hand_rows(hand, own)
        groups = {
            "held_out": [result for result in own if result.job.site not in TUNED],
            "tuned": [result for result in own if result.job.site in TUNED],
        }
        for name, part in groups.items():
            if part:
                hands[hand][name] = row_of(f"  {hand}, {name.replace('_', ' ')}", part)
    print(f"  t: defaults were tuned on {', '.join(TUNED)}; the other buildings were held out")
    return hands


def by_hand(results: Sequence[Result]) -> dict[str, list[Result]]:
    """Gather results by hand, in the order of drives."""
    hands: dict[str, list[Result]] = {}
    for result in results:
        hands.setdefault(result.job.hand, []).append(result)
    return hands


def hand_rows(hand: str, results: Sequence[Result]) -> Row:
    """Print the lines of a hand, building by building, and return its figures."""
    buildings = {}
    for site in dict.fromkeys(result.job.site for result in results):
        mark = "t" if site in TUNED else " "
        own = [result for result in results if result.job.site == site]
        buildings[site] = row_of(f"{mark} {site}", own)
    return {**row_of(f"  {hand}, all", results), "buildings": buildings}


def row_of(title: str, results: Sequence[Result]) -> Row:
    """Print one line of a table and return its figures."""
    scores = [result.score for result in results if result.score]
    reached = [float(bool(result.score and result.score.reached)) for result in results]
    ratios = [scored.way_ratio for scored in scores if scored.reached]
    right = [result.right_room for result in results if result.right_room >= 0.0]
    step_ms = np.concatenate([result.step_ms for result in results])
    row: Row = {
        "reached": float(np.mean(reached)),
        "reached_interval": bootstrap_interval(reached, np.random.default_rng(0)),
        "drives": len(results),
        "collisions": sum(scored.collisions for scored in scores),
        "path_ratio_median": float(np.median(ratios)) if ratios else None,
        "path_ratio_interval": median_interval(ratios),
        "minutes": mean_of([scored.minutes for scored in scores]),
        "lost": mean_of([scored.times_lost for scored in scores]),
        "recovered": mean_of([scored.times_recovered for scored in scores]),
        "right_room": mean_of(right),
        "ms_median": float(np.median(step_ms)) if len(step_ms) else None,
        "ms_p95": float(np.quantile(step_ms, 0.95)) if len(step_ms) else None,
    }
    print(line_of(title, row), flush=True)
    return row


def median_interval(values: Sequence[float]) -> tuple[float, float] | None:
    """Say how sure the median is; None if there is nothing."""
    return bootstrap_interval(values, np.random.default_rng(0), np.median) if values else None


def mean_of(values: Sequence[float]) -> float | None:
    """Average; None if there is nothing to average."""
    return float(np.mean(values)) if values else None


def line_of(title: str, row: Row) -> str:
    """Format one line of a table."""
    low, high = row["reached_interval"]
    cells = [f"{row['drives']:7d}{row['reached']:6.2f} [{low:4.2f}, {high:4.2f}]{row['collisions']:11d}"]
    if row["path_ratio_interval"]:
        low, high = row["path_ratio_interval"]
        cells.append(f"{row['path_ratio_median']:6.2f} [{low:5.2f},{high:5.2f}]")
    else:
        cells.append(f"{'-':>20s}")
    for name, width, digits in COLUMNS:
        value = row[name]
        cells.append(f"{'-':>{width}s}" if value is None else f"{value:{width}.{digits}f}")
    return f"{title:24s}{''.join(cells)}"


def print_reasons(results: Sequence[Result]) -> None:
    """Print how drives ended, the most frequent ending first."""
    for mode in dict.fromkeys(result.job.mode for result in results):
        endings = Counter(result.reason for result in results if result.job.mode == mode)
        print(f"\nHow drives ended, {MODES[mode].replace('_', ' ')}")
        for reason, count in endings.most_common():
            print(f"{count:6d}  {reason}")


STARTS = {"known_start": "marked", "unknown_start": "unknown", "packed": "unknown, packed worlds"}


def render(figures: Figures) -> str:
    """Write the table of README."""
    rows = [
        rendered_row(STARTS[mode], hand, row)
        for mode, hands in figures.items()
        if mode in STARTS
        for hand, row in (hands["hands"] if mode == "packed" else hands).items()
    ]
    return "\n".join(
        [
            prose(
                "A robot is sent from room to room in the true worlds of six real buildings, made from"
                " their logs, its start marked on the drawing and not; and through the packed worlds. A"
                " drive has reached its goal if the robot stopped of its own accord in the right room,"
                " within 1.5 m of the marked point or within 10 % of the room's longer side."
            ),
            "",
            table(
                (
                    "start",
                    "drawings",
                    "drives",
                    "reached",
                    "of these in held-out buildings",
                    "way / shortest, median",
                    "collisions",
                    "ms a step, median and 95th percentile",
                ),
                rows,
            ),
        ]
    )


def rendered_row(start: str, hand: str, row: Figures) -> tuple[str, ...]:
    """Write one row of the table of README."""
    held_out = row.get("held_out")
    return (
        start,
        f"`{hand}`",
        str(row["drives"]),
        percent_in(row["reached"], row["reached_interval"]),
        percent(held_out["reached"]) if held_out else "",
        number(row["path_ratio_median"], 2),
        str(row["collisions"]),
        f"{number(row['ms_median'], 0)}, {number(row['ms_p95'], 0)}",
    )
