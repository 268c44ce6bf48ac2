"""Correct the map beside a live session in the packed office: what it costs a step, and how scans lie on it.

    python -m benchmarks corrected_map

The robot drives to several rooms, once with the process beside that corrects the map, and once without.
Time goes five times as fast as in reality, so the process has a fifth of the time that it would have. A step
is all that stands between a scan and its command. How far a scan lies off is the median distance of its ends
from the walls of the map that is told, at the pose that is told, while the robot is sure of its place.
"""

import argparse
import itertools
import time

import numpy as np
import shapely

from benchmarks.lib.arguments import positive
from benchmarks.lib.results import Figures
from pilotage import Settings, open_map, open_world, worlds
from pilotage.drives.loop import put_down
from pilotage.io.bags.bent_frame import BentFrame
from pilotage.io.bags.ground import Ground
from pilotage.maps import Atlas, build_atlas
from pilotage.ros.correcting import Correcting
from pilotage.ros.session import Session, Told

GOALS = ("kitchen", "hall", "archive", "library", "lab", "workshop")
LIMIT = 400.0  # [s] of simulated time
PACE = 0.02  # [s] a step of 0.1 s of simulated time takes at least
SURE = 0.9
THINNED = 8
SETTINGS = Settings()


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose how many drives."""
    parser.add_argument("--seeds", type=positive, default=2, help="for each drawing (default: %(default)s)")


def measure(arguments: argparse.Namespace) -> Figures:
    """Print a line for each drive, and return times and distances."""
    figures: Figures = {"drives": 2 * arguments.seeds}
    for hand in ("careful", "quick"):
        atlas = build_atlas(open_map(getattr(worlds.OFFICE, hand)), SETTINGS.localizer.atlas)
        for beside, seed in itertools.product((False, True), range(arguments.seeds)):
            steps, off, maps = drive(atlas, seed, beside=beside)
            median, slowest, longest = np.percentile(1e3 * np.array(steps), [50, 99, 100]).tolist()
            distance = float(np.mean(off))
            print(
                f"{hand}, seed {seed}, {'corrected' if beside else 'as drawn'}: step {median:.1f} ms, 99 % "
                f"{slowest:.0f} ms, longest {longest:.0f} ms; {maps} maps; scans lie {distance:.2f} m off",
                flush=True,
            )
            told = {"step_ms": [median, slowest, longest], "off_m": distance, "maps": maps}
            figures[f"{hand} {seed} {'corrected' if beside else 'drawn'}"] = told
    return figures


def drive(atlas: Atlas, seed: int, *, beside: bool) -> tuple[list[float], list[float], int]:
    """Drive once; return the times of steps [s], how far scans lay off [m], and how many maps were told."""
    simulator = put_down(
        open_world(worlds.OFFICE.world), None, np.random.default_rng(seed), SETTINGS.simulator
    )
    session = Session(atlas, (SETTINGS.localizer, SETTINGS.navigator), seed=seed, keeps_sightings=beside)
    correcting = Correcting(session, lambda _text: None, clock=lambda: simulator.stamp) if beside else None
    steps, off, frames, goals = [], [], [session.frame], list(GOALS)
    session.set_goal(goals.pop(0))
    while simulator.stamp < LIMIT:
        reading = simulator.read()
        began = time.perf_counter()
        told = session.update(reading)
        if correcting is not None:
            correcting.look()
        steps.append(time.perf_counter() - began)
        if session.frame is not frames[-1]:
            frames.append(session.frame)
        elif len(steps) % 10 == 0 and session.position.estimate.probability > SURE:
            off.append(off_walls(session, told))
        simulator.step(told.command)
        if told.step is not None and told.step.outcome is not None:
            if not goals:
                break
            session.set_goal(goals.pop(0))
        time.sleep(max(0.0, PACE - (time.perf_counter() - began)))
    if correcting is not None:
        correcting.close()
    return steps, off, len(frames)


def off_walls(session: Session, told: Told) -> float:
    """Return the median distance of a scan's ends from the walls of the frame `map` [m]."""
    frame = session.frame
    ground = frame.ground if isinstance(frame, BentFrame) else Ground.drawn(frame, None)
    walls = shapely.multilinestrings(ground.walls.reshape(-1, 2, 2))
    ends = shapely.points(told.belief.pose @ told.scan.points_in_base[::THINNED])
    return float(np.median(np.abs(shapely.distance(ends, walls) - ground.thickness / 2.0)))
