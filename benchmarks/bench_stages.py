"""Time the stages of localizing and driving in the packed office; `make bench` runs this."""

from dataclasses import dataclass

import numpy as np
import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from pilotage.io import open_map, open_world
from pilotage.localization import Localizer
from pilotage.maps import (
    Atlas,
    AtlasSettings,
    DecompositionSettings,
    RangeTableSettings,
    SchematicMap,
    build_atlas,
    decompose,
)
from pilotage.maps.range_table import build_range_table
from pilotage.navigation import Navigator
from pilotage.perception import PerceptionSettings, Reading, perceive
from pilotage.scan_matching import ScanMatcher, ScanMatchingSettings
from pilotage.simulation import Simulator, SimulatorSettings, find_start
from pilotage.worlds import OFFICE

STEPS = 300  # of a tenth of a second
GOAL = "kitchen"

pytestmark = pytest.mark.benchmark(group="stages")


@dataclass(frozen=True, eq=False)
class Office:
    """The packed office as drawn, and a drive through it."""

    sketch: SchematicMap
    atlas: Atlas
    readings: tuple[Reading, ...]


@pytest.fixture(scope="module")
def office() -> Office:
    """Drive through the office once, to gather readings."""
    rng, settings = np.random.default_rng(0), SimulatorSettings()
    world, sketch = open_world(OFFICE.world), open_map(OFFICE.quick)
    atlas = build_atlas(sketch, AtlasSettings())
    simulator = Simulator(world, find_start(world, settings.body.radius, rng), rng, settings)
    navigator = Navigator(Localizer(atlas, seed=0), GOAL)
    readings = []
    for _ in range(STEPS):
        reading = simulator.read()
        readings.append(reading)
        simulator.step(navigator.step(reading.scan, reading.odometry).command)
    return Office(sketch, atlas, tuple(readings))


def test_scan_to_shapes(benchmark: BenchmarkFixture, office: Office) -> None:
    """2.1 and 2.2: scan to partial shapes."""
    benchmark(perceive, office.readings[-1].scan, PerceptionSettings())


def test_register(benchmark: BenchmarkFixture, office: Office) -> None:
    """2.1 to 3.3: register a scan into the local map."""
    matcher, last = ScanMatcher(ScanMatchingSettings()), office.readings[-1]
    for reading in office.readings[-100:]:
        matcher.update(reading.scan, reading.odometry)
    benchmark(matcher.update, last.scan, last.odometry)


def test_range_table(benchmark: BenchmarkFixture, office: Office) -> None:
    """What could be seen from everywhere on a drawing."""
    build_range_table(office.sketch, RangeTableSettings())
    benchmark.pedantic(build_range_table, (office.sketch, RangeTableSettings()), rounds=5)


def test_decompose(benchmark: BenchmarkFixture, office: Office) -> None:
    """4.1: divide a drawing into cells."""
    benchmark.pedantic(decompose, (office.sketch, DecompositionSettings()), rounds=5)


def test_localizer_from_scratch(benchmark: BenchmarkFixture, office: Office) -> None:
    """The first ten scans of a robot that is told nothing, with a global search."""

    def start() -> None:
        localizer = Localizer(office.atlas, seed=0)
        for reading in office.readings[::30]:
            localizer.update(reading.scan, reading.odometry)

    start()
    benchmark.pedantic(start, rounds=3)


def test_localizer_update(benchmark: BenchmarkFixture, office: Office) -> None:
    """One update along a drive, on average."""
    localizer, later = Localizer(office.atlas, seed=0), iter(office.readings)

    def update() -> None:
        reading = next(later)
        localizer.update(reading.scan, reading.odometry)

    benchmark.pedantic(update, rounds=STEPS - 10, warmup_rounds=5)


def test_navigator_step(benchmark: BenchmarkFixture, office: Office) -> None:
    """One step of driving, on average: localization, local grid, reachable set, steering."""
    navigator, later = (
        Navigator(Localizer(office.atlas, seed=0), GOAL),
        iter(office.readings),
    )

    def step() -> None:
        reading = next(later)
        navigator.step(reading.scan, reading.odometry)

    benchmark.pedantic(step, rounds=STEPS - 10, warmup_rounds=5)


def test_steering(benchmark: BenchmarkFixture) -> None:
    """From a way to a command among a thousand obstacles."""
    from pilotage.navigation.braking import SteeringSettings
    from pilotage.navigation.steering import steer

    rng = np.random.default_rng(0)
    obstacles = rng.uniform((-2.0, -2.0), (3.0, 2.0), (1000, 2))
    obstacles = obstacles[np.abs(obstacles[:, 1]) > 0.4]
    way = np.column_stack([np.linspace(0.0, 5.0, 101), np.zeros(101)])
    benchmark(steer, way, obstacles, 0.2, SteeringSettings())


def test_reachable_set(benchmark: BenchmarkFixture, office: Office) -> None:
    """The cheapest ways to everything that is seen free."""
    from pilotage.navigation.local_grid import LocalGrid

    grid = LocalGrid.unknown()
    for reading in office.readings:
        grid = grid.seen(reading.scan, reading.odometry.odom_from_base)
    grid.reachable_set(0.2)
    benchmark(grid.reachable_set, 0.2)
