"""Drive for simulated hours with goals that change, and check that memory does not grow.

    python -m benchmarks soak

A robot drives through the packed office by its quick drawing, among people and doors, with a noisy laser and
noisy wheels; the start is unknown. Every two minutes, and whenever a drive is over, it is sent to another
place. Resident memory is printed after each simulated quarter hour; the run fails if it grows by more than
the limit after the first of them.
"""

import argparse
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from benchmarks.lib.results import Figures
from benchmarks.lib.tables import prose
from pilotage.io import open_map, open_world
from pilotage.localization import Localizer
from pilotage.navigation import Navigator
from pilotage.simulation import Simulator, SimulatorSettings, find_start
from pilotage.worlds import OFFICE

PATIENCE = 120.0  # [s] after which the goal changes
QUARTER = 900.0  # [s]
MEGABYTE = 2**20


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose how long to drive and how much memory may grow."""
    parser.add_argument("--hours", type=float, default=2.0, help="simulated (default: %(default)s)")
    parser.add_argument("--max-growth", type=float, default=20.0, help="[MB] (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=0, help="(default: %(default)s)")


def measure(arguments: argparse.Namespace) -> Figures:
    """Drive, print memory, and return the figures."""
    rng = np.random.default_rng(arguments.seed)
    world, drawing, settings = open_world(OFFICE.world), open_map(OFFICE.quick), SimulatorSettings()
    names = sorted({label.text for label in drawing.labels})
    localizer = Localizer(drawing, seed=arguments.seed)
    simulator = Simulator(world, find_start(world, settings.body.radius, rng), rng, settings)
    resident: list[float] = []
    goals = steps = 0
    began = time.process_time()
    navigator, sent = None, 0.0
    while simulator.stamp < 3600.0 * arguments.hours:
        if navigator is None or simulator.stamp - sent > PATIENCE:
            navigator, sent = Navigator(localizer, goal=str(rng.choice(names))), simulator.stamp
            goals += 1
        reading = simulator.read()
        step = navigator.step(reading.scan, reading.odometry)
        steps += 1
        simulator.step(step.command)
        if step.outcome is not None:
            navigator = None
        if simulator.stamp >= QUARTER * (len(resident) + 1):
            resident.append(resident_mb())
            print(f"{simulator.stamp / 60.0:6.0f} min{resident[-1]:8.1f} MB, {goals} goals", flush=True)
    return figures_of(
        resident,
        max_growth=arguments.max_growth,
        goals=goals,
        collisions=simulator.collisions,
        ms_a_step=1e3 * (time.process_time() - began) / max(steps, 1),
    )


def figures_of(
    resident: Sequence[float], *, max_growth: float, goals: int, collisions: int, ms_a_step: float
) -> Figures:
    """Sum up a run; it has failed if memory grew too much."""
    growth = max(resident) - resident[0] if resident else 0.0
    figures: Figures = {
        "rss_mb": list(resident),
        "growth_mb": growth,
        "goals": goals,
        "collisions": collisions,
        "ms_a_step": ms_a_step,
    }
    print(f"memory grew by {growth:.1f} MB, {collisions} collisions, {ms_a_step:.1f} ms a step")
    if growth > max_growth:
        figures["failed"] = f"memory grew by {growth:.1f} MB, allowed are {max_growth:.1f} MB"
    return figures


def resident_mb() -> float:
    """Return the resident memory of this process [MB]; Linux only."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) * 1024 / MEGABYTE
    raise OSError("/proc/self/status holds no VmRSS")


def render(figures: Figures) -> str:
    """Write the sentence of README."""
    resident = figures["rss_mb"]
    return prose(
        f"After {len(resident) / 4:.1f} simulated hours of driving to {figures['goals']} goals in a row"
        f" memory is at {resident[-1]:.0f} MB; since the first quarter hour it grew by"
        f" {figures['growth_mb']:.1f} MB."
    )
