"""Drive a robot on the network through the packed office, by DDS on this machine alone.

    python -m benchmarks ros

The robot's side is a simulator with a node of its own. It waits for each command, so that what is measured
does not depend on the machine's load; the clock of the watchdog is the simulated one. Latency is what DDS,
messages and the watchdog add: from a scan's publication to the command's arrival at the robot, which listens
in a thread of its own, less the time of the session's step. What is published after a command delays none.
"""

import argparse
import itertools
import time

import numpy as np

from benchmarks.lib.arguments import positive
from benchmarks.lib.dds_robot import DdsRobot, run_together
from benchmarks.lib.results import Figures
from pilotage import Settings, open_map, open_world, worlds
from pilotage.drives.loop import put_down
from pilotage.maps import Atlas, build_atlas
from pilotage.perception import Reading
from pilotage.ros.node import Node
from pilotage.ros.robot import LiveRobot, Topics
from pilotage.ros.session import Session, Told

GOAL, LIMIT = "kitchen", 900.0  # [s] of simulated time
LOSS = 0.01
RESTARTS = 8.0, 13.0  # [s] when our side and the robot's are started anew
DISCOVERY = 0.5  # [s] for nodes to find each other
SETTINGS = Settings()
DOMAINS = itertools.cycle(range(60, 100))


class TimedSession(Session):
    """Knows how long each step took."""

    steps: list[float]

    def update(self, reading: Reading) -> Told:
        """Take a reading in."""
        began = time.perf_counter()
        told = super().update(reading)
        self.steps.append(time.perf_counter() - began)
        return told


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose how many drives."""
    parser.add_argument("--seeds", type=positive, default=20, help="(default: %(default)s)")


def measure(arguments: argparse.Namespace) -> Figures:
    """Print a line for each drive, and return shares and latencies."""
    atlas = build_atlas(open_map(worlds.OFFICE.careful), SETTINGS.localizer.atlas)
    added: list[float] = []
    reached = {0.0: 0, LOSS: 0}
    collisions = 0
    for loss, seed in itertools.product(reached, range(arguments.seeds)):
        outcome, touched, latencies = drive(atlas, seed, loss)
        reached[loss] += outcome == "reached"
        collisions += touched
        added += latencies if loss == 0.0 else []
        print(f"seed {seed:2d}, {loss:.0%} lost: {outcome}, {touched} collisions", flush=True)
    median, slowest = np.percentile(1e3 * np.array(added), [50, 99]).tolist()
    print(f"reached {reached[0.0]} of {arguments.seeds}, with losses and restarts {reached[LOSS]}")
    print(f"added latency: median {median:.1f} ms, 99 % {slowest:.1f} ms")
    return {
        "drives": arguments.seeds,
        "reached": reached[0.0],
        "collisions": collisions,
        "latency_ms": [median, slowest],
        "lossy_reached": reached[LOSS],
    }


def drive(atlas: Atlas, seed: int, loss: float) -> tuple[str, int, list[float]]:
    """Drive once; return how it ended, the collisions, and the latency that was added to each command [s]."""
    domain, rng = next(DOMAINS), np.random.default_rng(seed)
    simulator = put_down(open_world(worlds.OFFICE.world), None, rng, SETTINGS.simulator)

    def started() -> tuple[LiveRobot, TimedSession]:
        session = TimedSession(atlas, (SETTINGS.localizer, SETTINGS.navigator), seed=seed)
        session.steps = []
        topics = Topics(drives=True)
        live = LiveRobot(Node(domain), session, topics, lambda _text: None, lambda: simulator.stamp)
        live.set_goal(GOAL)
        time.sleep(DISCOVERY)
        return live, session

    robot = DdsRobot(Node(domain), simulator, loss, seed)
    live, session = started()
    if loss > 0.0:
        run_together(robot, live, RESTARTS[0], lambda: live.is_over)
        live, session = started()
        run_together(robot, live, RESTARTS[1] - RESTARTS[0], lambda: live.is_over)
        robot = DdsRobot(Node(domain), simulator, loss, seed + 1000)
        time.sleep(DISCOVERY)
    added = run_together(robot, live, LIMIT, lambda: live.is_over, lambda: sum(session.steps))
    outcome = live.told.step.outcome if live.told and live.told.step else None
    return outcome.value if outcome else "no end", simulator.collisions, added
