"""Time the kernels that simplify, compare and match shapes; best and median of many calls.

python -m benchmarks shape
"""

import argparse
import math
import statistics
import time
from collections.abc import Callable

import numpy as np

from benchmarks.lib.results import Figures
from pilotage.contours import ArcSequence, Comparison, Matching, Measure, match_partial
from pilotage.geometry import Array, Polyline
from pilotage.kernels import evolution, evolution_compiled
from pilotage.kernels.any_start import any_start_dissimilarity
from pilotage.kernels.arc_correspondence import closed_dissimilarity
from pilotage.shape import PartialShape

CALLS = 200
BEAMS = 361
SETTINGS = Comparison()


times_us: dict[str, float] = {}


def report(what: str, call: Callable[[], object]) -> None:
    """Print how long a call takes."""
    call()  # compiled, if it must be
    times = []
    for _ in range(CALLS):
        started = time.perf_counter()
        call()
        times.append(time.perf_counter() - started)
    times_us[what] = 1e6 * statistics.median(times)
    print(f"{what:62}{1e6 * min(times):10.0f} µs{1e6 * statistics.median(times):10.0f} µs")


def lobed_outline(vertices: int, lobes: int, noise: float) -> Array:
    """Draw a closed outline with as many bulges, (n, 2) [m]."""
    directions = np.linspace(0.0, math.tau, vertices, endpoint=False)
    radii = 3.0 + np.cos(lobes * directions) + np.random.default_rng(1).normal(0.0, noise, vertices)
    return radii[:, None] * np.column_stack([np.cos(directions), np.sin(directions)])


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """There is nothing to choose."""


def measure(_arguments: argparse.Namespace) -> Figures:
    """Time one kernel after the other, and return the medians [µs]."""
    times_us.clear()
    print(f"{'':62}{'best':>10}   {'median':>10}")
    scan = (lobed_outline(BEAMS, 5, 0.01), np.array([0, BEAMS]), np.array([True]), 0.03)
    report(f"evolution of {BEAMS} vertices, plain", lambda: evolution.evolve_runs(*scan))
    report(f"evolution of {BEAMS} vertices, compiled", lambda: evolution_compiled.evolve_runs(*scan))

    a, b = (
        ArcSequence.of(Polyline(lobed_outline(32, lobes, 0.0), closed=True)).steps(1.0) for lobes in (5, 6)
    )
    counts = f"{len(a.bends)} against {len(b.bends)} arcs, 32 against 32 segments"
    for measure in Measure:
        report(
            f"{measure.name.lower()} dissimilarity, {counts}",
            lambda measure=measure: closed_dissimilarity(
                a, b, SETTINGS.largest_group, measure.value, SETTINGS.largest_run
            ),
        )
    report("of this, the whole from any start", lambda: any_start_dissimilarity(a.steps, b.steps))

    for vertices in (6, 10):
        walks = np.random.default_rng(2).normal(size=(2, vertices, 2)).cumsum(axis=1)
        seen, known = (PartialShape(Polyline(walk)) for walk in walks)
        what = f"partial match of {vertices} against {vertices} vertices, all poses"
        report(what, lambda seen=seen, known=known: match_partial(seen, known, Matching()))
    return {"median_us": dict(times_us)}
