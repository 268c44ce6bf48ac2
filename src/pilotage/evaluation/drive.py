"""Drive a simulated robot to a goal on a drawing, and hold what came out against the truth."""

import math
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Protocol

import numpy as np
import shapely

from pilotage.config import Settings
from pilotage.evaluation.episodes import way_along
from pilotage.geometry import Array, Pose2
from pilotage.localization import Localizer, LocalizerSettings, Status
from pilotage.maps import Atlas, NotEnclosedError, SchematicMap, check_place, check_reachable, find_labeled
from pilotage.navigation import Navigator, Outcome, Step
from pilotage.perception import LaserScan, Odometry
from pilotage.simulation import Scene, Simulator, SimulatorSettings, World, find_start

NEAR_GOAL = 1.5
"""How far from the marked point the robot may stop [m]: a drawing tells no better."""
NEAR_GOAL_SHARE = 0.1
"""The same, as a share of the room's size."""

Point = tuple[float, float]


class Pilot(Protocol):
    """Whoever drives: takes a scan in, gives a step out."""

    def step(self, scan: LaserScan, odometry: Odometry) -> Step:
        """Say what to do now; a step with an outcome is the last."""


@dataclass(frozen=True, slots=True)
class Instant:
    """One step of a drive, and what was true when it was taken."""

    step: Step
    scene: Scene
    step_ms: float  # [ms] of the processor that the pilot took


def drive(pilot: Pilot, simulator: Simulator) -> Iterator[Instant]:
    """Read, step, move, ten times a second, until the pilot says that the drive is over."""
    while True:
        reading = simulator.read()
        began = time.process_time()
        step = pilot.step(reading.scan, reading.odometry)
        step_ms = 1e3 * (time.process_time() - began)
        yield Instant(step, simulator.scene, step_ms)
        if step.outcome is not None:
            return
        simulator.step(step.command)


@dataclass(frozen=True, eq=False)
class Drive:
    """A whole drive, from the first scan to its outcome."""

    instants: tuple[Instant, ...]

    def __post_init__(self) -> None:
        """Refuse a drive without a step."""
        if not self.instants:
            raise ValueError("a drive needs at least one step, got none")

    @property
    def last(self) -> Instant:
        """How it ended."""
        return self.instants[-1]

    @property
    def outcome(self) -> Outcome | None:
        """How the pilot says that it ended; None if it goes on."""
        return self.last.step.outcome

    @property
    def reason(self) -> str:
        """Why it ended, in plain words."""
        return self.last.step.reason

    @property
    def collisions(self) -> int:
        """Contacts, each counted once."""
        return self.last.scene.collisions

    @cached_property
    def positions(self) -> Array:
        """Where the robot truly was at each step, (n, 2) [m]."""
        return np.array([instant.scene.world_from_base.position for instant in self.instants])

    @cached_property
    def way(self) -> float:
        """How far the robot truly drove [m]."""
        return float(way_along(self.positions)[-1])

    @property
    def minutes(self) -> float:
        """How long it took, on the robot's clock."""
        return (self.last.step.stamp - self.instants[0].step.stamp) / 60.0

    @property
    def times_lost(self) -> int:
        """How often the place was lost after it had been found."""
        return self.last.step.times_lost

    @cached_property
    def times_recovered(self) -> int:
        """How often a lost place was found again."""
        recovered, waiting = 0, False
        for before, now in pairwise(instant.step for instant in self.instants):
            waiting |= now.times_lost > before.times_lost
            if waiting and now.estimate.status is Status.LOCATED:
                recovered, waiting = recovered + 1, False
        return recovered

    @property
    def step_ms(self) -> Array:
        """How long the pilot took for each step, (n,) [ms]."""
        return np.array([instant.step_ms for instant in self.instants])


def set_out(
    drawing: SchematicMap | Atlas,
    world: World,
    goal: Point | str,
    *,
    start: Pose2 | Point | None = None,
    world_start: Pose2 | None = None,
    scale: float | None = None,
    seed: int = 0,
    settings: Settings | None = None,
) -> tuple[Navigator, Simulator]:
    """Put a robot into a world and give it a drawing with a goal; `drive` sets it going.

    `goal` is a point of the sketch (y up) or a word that stands in one cell; `start`, if the robot may know
    it, a pose in the sketch, or a point if it does not know its heading, and `scale` drawing units per metre.
    It truly begins at `world_start`, or where the world says, or anywhere free, as the seed has it. Raises
    PilotageError if it cannot be driven to the goal from there.
    """
    settings = settings if settings is not None else Settings()
    localizer = Localizer(
        drawing, informed(settings.localizer, start), seed=seed, start=start_pose(start), scale=scale
    )
    graph = localizer.atlas.cell_graph
    if graph is None:
        raise NotEnclosedError("a drawing to drive by must enclose free space, it has no closed room")
    target = find_labeled(graph, goal) if isinstance(goal, str) else goal
    check_place(graph, target, "goal")
    known = start_pose(start)
    if known is not None:
        check_place(graph, (known.x, known.y), "start")
    check_reachable(graph, target, None if known is None else (known.x, known.y))
    navigator = Navigator(localizer, target, settings.navigator)
    return navigator, put_down(world, world_start, np.random.default_rng(seed), settings.simulator)


def start_pose(start: Pose2 | Point | None) -> Pose2 | None:
    """Make a pose of what is known of a start; a heading that is not known is any."""
    return Pose2(*start, 0.0) if isinstance(start, tuple) else start


def informed(settings: LocalizerSettings, start: Pose2 | Point | None) -> LocalizerSettings:
    """Let the robot know as much of its heading as is known."""
    if not isinstance(start, tuple):
        return settings
    prior = replace(settings.tracking.prior, known_heading=math.pi)
    return replace(settings, tracking=replace(settings.tracking, prior=prior))


def put_down(
    world: World, world_start: Pose2 | None, rng: np.random.Generator, settings: SimulatorSettings
) -> Simulator:
    """Put the robot where it is to begin: there, or where the world says, or somewhere free."""
    truly = world_start if world_start is not None else world.start
    if truly is None:
        truly = find_start(world, settings.body.radius, rng)
    return Simulator(world, truly, rng, settings)


def navigate(
    drawing: SchematicMap | Atlas,
    world: World,
    goal: Point | str,
    *,
    start: Pose2 | Point | None = None,
    world_start: Pose2 | None = None,
    scale: float | None = None,
    seed: int = 0,
    settings: Settings | None = None,
) -> Drive:
    """Drive a simulated robot to a goal on a drawing, to the end; see `set_out`."""
    navigator, simulator = set_out(
        drawing, world, goal, start=start, world_start=world_start, scale=scale, seed=seed, settings=settings
    )
    return Drive(tuple(drive(navigator, simulator)))


@dataclass(frozen=True, slots=True)
class Destination:
    """Where a drive should end, in the world."""

    point: Point  # the marked point of the drawing, carried over by control points [m]
    room: shapely.Polygon  # that it lies in [m]

    @property
    def size(self) -> float:
        """The longer side of the smallest rectangle, however turned, around the room [m]."""
        corners = shapely.get_coordinates(shapely.minimum_rotated_rectangle(self.room))
        return float(np.hypot(*np.diff(corners, axis=0).T).max())

    @property
    def tolerance(self) -> float:
        """How far from the point the robot may stop [m]."""
        return max(NEAR_GOAL, NEAR_GOAL_SHARE * self.size)


@dataclass(frozen=True, slots=True)
class DriveScore:
    """How a drive went."""

    reached: bool  # stopped of its own accord, in the right room, near the marked point
    in_room: bool  # ended in the right room, whatever it says
    miss: float  # [m] from the marked point
    outcome: str  # what the pilot says
    reason: str
    collisions: int
    way: float  # [m] driven
    way_ratio: float  # over the shortest in the true world
    minutes: float
    times_lost: int
    times_recovered: int
    steps: int
    ms_median: float  # [ms] a step
    ms_p95: float


def score(driven: Drive, destination: Destination, shortest: float) -> DriveScore:
    """Hold a drive against the place where it should end and the shortest way there [m]."""
    end = shapely.Point(driven.positions[-1])
    miss = float(end.distance(shapely.Point(destination.point)))
    in_room = bool(destination.room.covers(end))
    step_ms = driven.step_ms
    return DriveScore(
        reached=driven.outcome is Outcome.REACHED and in_room and miss <= destination.tolerance,
        in_room=in_room,
        miss=miss,
        outcome=driven.outcome.value if driven.outcome else "goes on",
        reason=driven.reason,
        collisions=driven.collisions,
        way=driven.way,
        way_ratio=driven.way / shortest,
        minutes=driven.minutes,
        times_lost=driven.times_lost,
        times_recovered=driven.times_recovered,
        steps=len(driven.instants),
        ms_median=float(np.median(step_ms)),
        ms_p95=float(np.quantile(step_ms, 0.95)),
    )
