"""Find the robot on drawings of six real buildings, episode by episode, and print how often it is right.

    python -m benchmarks localization [--json FILE] [--episodes N] [--buildings A,B] [--hands A,B] [--jobs N]

Each episode puts the robot down somewhere in the log of a building and takes the next 40 m of travel: no
start, no heading, no scale. Scans in rooms that a drawing leaves out are not counted. Apart stand two
drawings of one building that were made by people. Intervals are 95 % bootstrap intervals over episodes.
Defaults were chosen on aces, csail and freiburg-079; the other buildings were held back, but for the weight
of a scan, of which three values were first tried on all six.
"""

import argparse
import json
import os
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np

from pilotage.evaluation.episodes import EpisodeScore, run_episode, spread_episodes, way_along
from pilotage.evaluation.intervals import bootstrap_interval
from pilotage.evaluation.rooms import read_drawn_rooms, read_world_rooms
from pilotage.evaluation.trajectory import associate
from pilotage.io import open_log, open_map
from pilotage.io.tum import read_trajectory
from pilotage.localization import Localizer
from pilotage.maps import AtlasSettings, build_atlas

DATA = Path(__file__).resolve().parents[1] / ".." / "shared" / "data"
BUILDINGS = ("aces", "belgioioso", "csail", "fhw", "freiburg-079", "freiburg-101")
HANDS = ("draftsman", "quick", "schematic")
PEOPLE = ("freehand", "plan")
LENGTH = 40.0  # [m] of an episode

Job = tuple[str, str, int]
Row = dict[str, float]


def main() -> None:
    """Run all episodes and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--json", type=Path, help="write the figures here")
    parser.add_argument("--episodes", type=int, default=20, help="for each drawing (default: %(default)s)")
    parser.add_argument("--buildings", default=",".join(BUILDINGS), help="(default: %(default)s)")
    parser.add_argument("--hands", default=",".join((*HANDS, *PEOPLE)), help="(default: %(default)s)")
    parser.add_argument(
        "--jobs", type=int, default=2, help="processes; 1 for honest times (default: %(default)s)"
    )
    arguments = parser.parse_args()
    if not DATA.is_dir():
        parser.error("the data folder is not there: ../shared/data beside the repository")
    jobs = [
        (building, hand, arguments.episodes)
        for building in arguments.buildings.split(",")
        for hand in arguments.hands.split(",")
        if folder_of(building, hand).joinpath(f"{hand}.svg").exists()
    ]
    build_atlas(open_map(folder_of(*jobs[0][:2]) / f"{jobs[0][1]}.svg"), AtlasSettings())  # fills the cache
    print(HEAD)
    rows: dict[str, dict[str, Row]] = {}
    with ProcessPoolExecutor(arguments.jobs) as pool:
        for (building, hand, _), (scores, atlas_s) in zip(jobs, pool.map(run, jobs), strict=True):
            rows.setdefault(building, {})[hand] = summarize(scores, atlas_s)
            print(line(building, hand, scores, atlas_s), flush=True)
    rows["mean"] = {
        hand: mean_of([rows[building][hand] for building in rows if hand in rows[building]])
        for hand in dict.fromkeys(job[1] for job in jobs)
    }
    for hand, row in rows["mean"].items():
        print(line_of_mean(hand, row))
    if arguments.json:
        arguments.json.write_text(json.dumps(rows, indent=1) + "\n")


def folder_of(building: str, hand: str) -> Path:
    """Return the folder of a drawing."""
    return DATA / ("people-drawings" if hand in PEOPLE else "sketches") / building


def run(job: Job) -> tuple[list[EpisodeScore], float]:
    """Run the episodes of one drawing; return their scores and the seconds that its atlas took."""
    building, hand, count = job
    sketch = open_map(folder_of(building, hand) / f"{hand}.svg")
    log = open_log(DATA / "logs" / f"{building}.log.gz")
    truth = read_trajectory(DATA / "logs" / f"{building}.truth.tum")
    stamps = np.array([reading.scan.stamp for reading in log])
    positions = truth.poses[associate(stamps, truth), :2]
    truths = read_world_rooms(folder_of(building, hand) / "rooms.geojson").names_at(positions)
    drawn_rooms = read_drawn_rooms(folder_of(building, hand) / f"{hand}.json")
    began = time.perf_counter()
    atlas = build_atlas(sketch, AtlasSettings())
    atlas_s = time.perf_counter() - began
    scores = []
    for seed, episode in enumerate(spread_episodes(positions, count, LENGTH)):
        chosen = slice(episode.first, episode.last + 1)
        way = way_along(positions[chosen])
        localizer = Localizer(atlas, seed=seed)
        scores.append(run_episode(localizer, log.readings[chosen], truths[chosen], way, drawn_rooms))
    return scores, atlas_s


def summarize(scores: Sequence[EpisodeScore], atlas_s: float) -> Row:
    """Return the figures of one drawing."""
    scan_ms = np.concatenate([score.scan_ms for score in scores])
    return {
        "room_end": float(np.mean([score.right_at_end for score in scores])),
        "room_last10": float(np.mean([score.right_last for score in scores])),
        "metres_to_fix": float(np.median([score.meters_to_fix for score in scores])),
        "confident_wrong": float(np.mean([score.sure_and_wrong for score in scores])),
        "confident": float(np.mean([score.sure for score in scores])),
        "ms_median": float(np.median(scan_ms)),
        "ms_p95": float(np.quantile(scan_ms, 0.95)),
        "atlas_s": atlas_s,
    }


def mean_of(rows: Sequence[Row]) -> Row:
    """Average figures over buildings."""
    return {name: float(np.mean([row[name] for row in rows])) for name in rows[0]}


HEAD = (
    f"{'building':13s}{'hand':11s}{'room at end':>19s}{'last 10 m':>19s}{'m to fix':>9s}"
    f"{'sure':>7s}{'sure+wrong':>11s}{'ms':>6s}{'p95':>6s}{'atlas s':>8s}"
)


def line(building: str, hand: str, scores: Sequence[EpisodeScore], atlas_s: float) -> str:
    """Format the figures of one drawing, with intervals."""
    rng = np.random.default_rng(0)
    ends = [float(score.right_at_end) for score in scores]
    lasts = [score.right_last for score in scores]
    spans = [(np.mean(values), *bootstrap_interval(np.array(values), rng)) for values in (ends, lasts)]
    shares = "".join(f"{mean:6.2f} [{low:4.2f}, {high:4.2f}]" for mean, low, high in spans)
    return f"{building:13s}{hand:11s}{shares}{tail_of(summarize(scores, atlas_s))}"


def line_of_mean(hand: str, row: Row) -> str:
    """Format the mean over buildings."""
    return f"{'mean':13s}{hand:11s}{row['room_end']:19.3f}{row['room_last10']:19.3f}{tail_of(row)}"


def tail_of(row: Row) -> str:
    """Format the figures that have no interval."""
    return (
        f"{row['metres_to_fix']:9.1f}{row['confident']:7.2f}{row['confident_wrong']:11.3f}"
        f"{row['ms_median']:6.0f}{row['ms_p95']:6.0f}{row['atlas_s']:8.2f}"
    )


if __name__ == "__main__":
    main()
