"""Drive a simulated robot to a goal on a drawing: read, step, move, until the drive is over."""

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from pilotage.config import Settings
from pilotage.geometry import Pose2
from pilotage.localization import Localizer
from pilotage.maps import Atlas, SchematicMap, check_reachable
from pilotage.navigation import Navigator, Place, Step, Tour, find_goal, sketch_point
from pilotage.perception import LaserScan, Odometry
from pilotage.simulation import Scene, Simulator, SimulatorSettings, World, find_start
from pilotage.simulation.made_real import MadeReal, make_real

Start = tuple[float, float] | tuple[float, float, float]


class Pilot(Protocol):
    """Anything that drives: takes a scan in, gives a step out."""

    def step(self, scan: LaserScan, odometry: Odometry) -> Step:
        """Say what to do now; a step with an outcome is the last."""


@dataclass(frozen=True, slots=True)
class Instant:
    """One step of a drive, and what was true when it was taken."""

    step: Step
    scene: Scene
    step_ms: float  # [ms] of the processor that the pilot took


def drive(pilot: Pilot, simulator: Simulator) -> Iterator[Instant]:
    """Read, step, move, once a time step of the simulator, until the pilot says that the drive is over."""
    while True:
        reading = simulator.read()
        began = time.process_time()
        step = pilot.step(reading.scan, reading.odometry)
        step_ms = 1e3 * (time.process_time() - began)
        yield Instant(step, simulator.scene, step_ms)
        if step.outcome is not None:
            return
        simulator.step(step.command)


def set_out(
    drawing: SchematicMap | Atlas,
    world: World,
    goal: Place | Sequence[Place] | Tour,
    *,
    start: Start | None = None,
    world_start: Pose2 | None = None,
    scale: float | None = None,
    seed: int = 0,
    settings: Settings | None = None,
) -> tuple[Navigator, Simulator]:
    """Put a robot into a world and give it a drawing with a goal; `drive` then runs the loop.

    `goal` is a name, reached anywhere in the one cell that bears it, or a point, or several of these in
    order, or a `Tour`. `start`, if the robot may know it, is x, y and, if it may know that too, its heading
    [rad]. Points are in the drawing's own units and axes, headings counter-clockwise on the page; `scale` is
    drawing units per metre. The robot truly begins at `world_start`, or where the world says, or anywhere
    free, depending on the seed. Raises PilotageError if a goal cannot be reached on the drawing, from `start`
    if that is given, and ValueError if an argument is invalid.
    """
    settings = settings if settings is not None else Settings()
    localizer = Localizer(drawing, settings.localizer, seed=seed, start=start, scale=scale)
    navigator = Navigator(localizer, goal, settings.navigator)
    planner = navigator.planner
    known = None if start is None else sketch_point(planner.atlas, (start[0], start[1]), "start")
    for place in navigator.tour.goals:
        target = find_goal(planner.atlas, place).point
        check_reachable(planner.graph, target, known)
        if known is not None:
            planner.roadmap.find(known, target)  # zones may be in the way
    return navigator, put_down(world, world_start, np.random.default_rng(seed), settings.simulator)


def make_building(
    atlas: Atlas,
    goal: Place,
    start: Start | None,
    *,
    severity: float,
    seed: int,
    settings: Settings,
) -> MadeReal:
    """Make a building of a drawing, with the robot at its start, told or marked, or in reach of its goal.

    Goal and start are as in `set_out`; `severity`, from 0 to 1, says how little the building is like the
    drawing. Raises PilotageError if goal or start cannot be used.
    """
    return make_real(
        atlas,
        severity,
        np.random.default_rng(seed),
        goal=find_goal(atlas, goal).point,
        start=atlas.sketch.start if start is None else sketch_point(atlas, (start[0], start[1]), "start"),
        heading=start[2] if start is not None and len(start) == 3 else None,
        radius=settings.simulator.body.radius,
    )


def put_down(
    world: World, world_start: Pose2 | None, rng: np.random.Generator, settings: SimulatorSettings
) -> Simulator:
    """Put the robot where it is to begin: there, or where the world says, or somewhere free."""
    truly = world_start if world_start is not None else world.start
    if truly is None:
        truly = find_start(world, settings.body.reach, rng)
    return Simulator(world, truly, rng, settings)
