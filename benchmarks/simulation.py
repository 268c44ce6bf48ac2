"""Measure how much faster than real time the simulator runs, on one core.

    python -m benchmarks simulation

A robot wanders through the packed world, and through a raster map of 100 m by 100 m whose walls are as rough
as those that robots map; there are five people and a swinging door in each. A step is 0.1 s, and takes a scan
of 181 beams. Printed is also how long it takes to open each world, and to find a shortest way through it.
"""

import argparse
import math
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image

from benchmarks.lib.results import Figures
from benchmarks.lib.tables import table
from pilotage import worlds
from pilotage.geometry import Array, Polyline, Twist
from pilotage.io import open_world
from pilotage.simulation import Door, LaserSettings, Person, Simulator, SimulatorSettings, World, find_start

PIXEL = 0.05  # [m]
SIDE = 2000  # [pixels]
ROOM = 100  # [pixels]
SPECKS = 6000
NEAR = 0.7  # [m] at which the robot turns away
SETTINGS = SimulatorSettings(laser=LaserSettings(beams=181))
RADIUS = SETTINGS.body.radius


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose how long the robot drives."""
    parser.add_argument(
        "--minutes", type=float, default=5.0, help="on the robot's clock (default: %(default)s)"
    )


def measure(arguments: argparse.Namespace) -> Figures:
    """Print a line for each world, and return the figures."""
    figures: Figures = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, path in (("packed", worlds.OFFICE.world), ("raster", write_raster(Path(folder)))):
            open_world(path)  # compiles
            began = time.process_time()
            world = open_world(path)
            opened = time.process_time() - began
            print(f"{name}: {len(world.segments)} segments, opened in {opened:.2f} s")
            world = peopled(world)
            find_long_way(name, world)
            wander(world, 1.0)
            steps, taken, collisions = wander(world, 60.0 * arguments.minutes)
            figures[name] = {
                "times_real_time": 60.0 * arguments.minutes / taken,
                "ms_a_step": 1e3 * taken / steps,
                "opened_s": opened,
            }
            print(
                f"{name}: {60.0 * arguments.minutes / taken:.0f} times as fast as real time,"
                f" {1e3 * taken / steps:.2f} ms a step, {collisions} collisions"
            )
    return figures


def write_raster(folder: Path) -> Path:
    """Write a map of rooms with doorways, specks, and walls with ragged faces."""
    rng = np.random.default_rng(1)
    pixels = np.full((SIDE, SIDE), 254, np.uint8)
    walls = np.arange(0, SIDE + 1, ROOM)
    for wall in walls:
        for k in range(SIDE):
            first, last = wall - rng.integers(2, 4), wall + rng.integers(2, 4)
            pixels[max(first, 0) : last, k] = 0
            pixels[k, max(first, 0) : last] = 0
    for wall in walls[1:-1]:
        for middle in walls[:-1] + ROOM // 2:
            pixels[wall - 4 : wall + 4, middle - 10 : middle + 10] = 254
            pixels[middle - 10 : middle + 10, wall - 4 : wall + 4] = 254
    pixels[tuple(rng.integers(0, SIDE, (2, SPECKS)))] = 205
    Image.fromarray(pixels).save(folder / "map.png")
    path = folder / "map.yaml"
    path.write_text(f"image: map.png\nresolution: {PIXEL}\norigin: [0, 0, 0]\n")
    return path


def peopled(world: World) -> World:
    """Let five people walk along the shortest ways between places drawn at random, and hang a door."""
    rng = np.random.default_rng(2)
    paths: list[Array] = []
    while len(paths) < 5:
        ends = [find_start(world, RADIUS, rng).position for _ in range(2)]
        way = world.shortest_way(ends[0], ends[1], 0.3)
        if 5.0 < way.length < math.inf:
            paths.append(way.points)
    step = np.diff(paths[0][:2], axis=0)[0]
    across = 0.5 * np.array([-step[1], step[0]]) / np.hypot(*step)
    middle = paths[0][0] + step / 2.0
    times = tuple((20.0 * k, 20.0 * k + 10.0) for k in range(30))
    door = Door(np.concatenate([middle - across, middle + across]), times)
    return replace(world, people=tuple(Person(Polyline(path)) for path in paths), doors=(door,))


def find_long_way(name: str, world: World) -> None:
    """Print how long the search for a way between two places takes, the first time and the second."""
    rng = np.random.default_rng(4)
    start, goal = (find_start(world, RADIUS, rng).position for _ in range(2))
    taken = []
    for _ in range(2):
        began = time.process_time()
        way = world.shortest_way(start, goal, RADIUS)
        taken.append(time.process_time() - began)
    print(f"{name}: a way of {way.length:.1f} m found in {taken[0]:.2f} s, and again in {taken[1]:.2f} s")


def wander(world: World, seconds: float) -> tuple[int, float, int]:
    """Drive straight on where there is room ahead and turn where there is none.

    Returns
    -------
    steps, taken, collisions
        How many steps were made, in how many seconds, and how often the robot touched something.
    """
    simulator = Simulator(
        world, find_start(world, RADIUS, np.random.default_rng(0)), np.random.default_rng(3), SETTINGS
    )
    began, steps = time.process_time(), 0
    while simulator.stamp < seconds:
        scan = simulator.read().scan
        ahead = float(np.min(scan.ranges[np.abs(scan.directions) < math.radians(40.0)]))
        simulator.step(Twist(0.6, 0.1) if ahead > NEAR else Twist(0.0, 0.8))
        steps += 1
    return steps, time.process_time() - began, simulator.collisions


def render(figures: Figures) -> str:
    """Write the table of README."""
    return table(
        ("world", "times as fast as real time", "ms a step"),
        [(name, f"{row['times_real_time']:.0f}", f"{row['ms_a_step']:.2f}") for name, row in figures.items()],
    )
