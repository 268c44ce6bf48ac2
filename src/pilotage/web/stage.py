"""The stage of a drive: robot, world and drawing, and what is known of how they belong together."""

import time
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from pilotage.config import Settings
from pilotage.correction import Sighting, append_sighting
from pilotage.drives import Drive, Instant, make_building, set_out
from pilotage.errors import FileError, PilotageError
from pilotage.evaluation.warp import Warp, read_warp
from pilotage.geometry import Array, Pose2
from pilotage.io import open_world
from pilotage.io.records import is_records
from pilotage.maps import Atlas, CellGraph, build_atlas
from pilotage.navigation import Navigator, Step
from pilotage.simulation import Scene, Simulator
from pilotage.simulation.proportions import Proportions
from pilotage.web.drawings import Json, Page, UnreadableError, describe_drawing, read_sent
from pilotage.web.frames import FrameMaker, Truth, describe_world
from pilotage.web.order import MadeRealOrder, Order, Place, RecordingOrder, RobotOrder
from pilotage.web.playback import playback
from pilotage.web.replay import replay
from pilotage.web.show import Show

Carry = Callable[[Array], Array]
"""Carries points (n, 2) from the drawing (y up) to the world [m]."""

MOST_INSTANTS = 40_000
"""Steps that are kept for journal and film: more than an hour."""


class NoGoalError(PilotageError):
    """A drive has no goal."""


class NoWorldError(PilotageError):
    """A drive has no world."""


@dataclass(slots=True)
class Stage:
    """All that a drive is made of; truth, carry and boxes are for spectators only."""

    navigator: Navigator
    simulator: Simulator
    page: Page
    truth: Truth | None = None  # None if it is not known where the world is on the drawing
    world_from_sketch: Carry | None = None
    boxes: Array = field(default_factory=lambda: np.empty((0, 4)))  # sides of what a person put there [m]
    instants: list[Instant] = field(default_factory=list)  # the record of the drive
    sightings: list[Sighting] = field(default_factory=list)  # by which the drawing can be corrected
    frames: FrameMaker = field(init=False)
    scene: Scene = field(init=False)  # as it is shown

    def __post_init__(self) -> None:
        """Begin with what is there."""
        self.frames = FrameMaker(self.navigator, self.page, self.truth)
        self.scene = self.simulator.scene

    @property
    def graph(self) -> CellGraph:
        """The cells of the drawing."""
        return self.navigator.planner.graph

    @property
    def stamp(self) -> float:
        """The time since the drive began [s]."""
        return self.simulator.stamp

    @property
    def time_step(self) -> float:
        """The time between two steps [s]."""
        return self.simulator.settings.time_step

    @property
    def is_over(self) -> bool:
        """Whether the robot has ended the drive."""
        return bool(self.instants) and self.instants[-1].step.outcome is not None

    @property
    def goal_name(self) -> str:
        """What the goal is called."""
        return self.navigator.planner.goal.name or "the goal"

    def step(self) -> Step:
        """Read, step, move."""
        reading = self.simulator.read()
        began = time.process_time()
        step = self.navigator.step(reading.scan, reading.odometry)
        self.scene = self.simulator.scene
        self.instants.append(Instant(step, self.scene, 1e3 * (time.process_time() - began)))
        del self.instants[: max(0, len(self.instants) - MOST_INSTANTS)]
        if self.navigator.position.is_fresh:
            append_sighting(self.sightings, self.navigator.position.localizer, reading.scan)
        self.frames.note()
        self.simulator.step(step.command)
        return step

    def look_again(self) -> None:
        """Show what a person has changed since the last step."""
        self.scene = self.simulator.scene

    def frame(self) -> Json:
        """Describe the last step."""
        step = self.instants[-1].step
        told = self.frames.frame(step, self.scene.scan, step.stamp, self.goal_name)
        return {**told, "world": self.frames.world(self.scene)}

    def describe(self, title: str) -> Json:
        """Describe the drawing and the goal."""
        goal = self.page.point(self.navigator.planner.goal.point)
        drawn = {**describe_drawing(self.page.sketch), "goal": goal}
        return {"kind": "drive", "title": title, "drawing": drawn, "goal": self.goal_name}

    def describe_world(self) -> Json:
        """Describe all that stands."""
        goal = None
        if self.world_from_sketch is not None:
            goal = self.world_from_sketch(np.array([self.navigator.planner.goal.point]))[0]
        return describe_world(self.simulator.world, self.boxes, goal, self.stamp)

    def set_goal(self, goal: Place) -> None:
        """Send the robot elsewhere."""
        self.navigator.set_goal(goal if isinstance(goal, str) else self.page.file_point(*goal))

    def record(self) -> Drive:
        """Gather all that happened."""
        planner = self.navigator.planner
        return Drive.of(planner.atlas, self.simulator.world, planner.goal, self.instants)


def set_stage(order: Order) -> Show:
    """Read drawing and world, and put the robot down; PilotageError or ValueError if that cannot be done."""
    if isinstance(order.world, RobotOrder):
        raise NoWorldError("a robot on the network has no world")
    settings = order.settings or Settings()
    atlas = build_atlas(read_sent(order.drawing).sketch, settings.localizer.atlas)
    page = Page(atlas.sketch)
    told = None if order.start is None else (*page.file_point(*order.start[:2]), *order.start[2:])
    if isinstance(order.world, RecordingOrder):
        return open_recording(order.world, atlas, page, told, seed=order.seed, settings=settings)
    goal = goal_of(order, page)
    if isinstance(order.world, MadeRealOrder):
        return made_real(order.world, atlas, page, goal=goal, told=told, seed=order.seed, settings=settings)
    warp = None if order.warp is None else read_warp(order.warp, atlas.sketch)
    begin = None
    if told is not None and warp is not None:
        begin = true_start(warp, page, told)
    navigator, simulator = set_out(
        atlas,
        open_world(order.world),
        goal,
        start=told,  # type: ignore[arg-type]
        world_start=begin,
        seed=order.seed,
        settings=settings,
    )
    if warp is None:
        return Stage(navigator, simulator, page)
    return Stage(navigator, simulator, page, truth_by_warp(warp), warp.world_from_sketch)


def open_recording(
    order: RecordingOrder,
    atlas: Atlas,
    page: Page,
    told: tuple[float, ...] | None,
    *,
    seed: int,
    settings: Settings,
) -> Show:
    """Open a log or a journal; UnreadableError if it cannot be read."""
    try:
        if is_records(order.path):
            return playback(atlas, page, order)
        return replay(atlas, page, order.path, told, seed=seed, settings=settings)
    except FileError as error:
        raise UnreadableError(f"{error.rule}: {order.title}") from error


def made_real(
    order: MadeRealOrder,
    atlas: Atlas,
    page: Page,
    *,
    goal: Place,
    told: tuple[float, ...] | None,
    seed: int,
    settings: Settings,
) -> Stage:
    """Make a building of the drawing, and put the robot into it."""
    made = make_building(
        atlas,
        goal,
        told,  # type: ignore[arg-type]
        severity=order.severity,
        seed=order.seed,
        settings=settings,
    )
    navigator, simulator = set_out(
        atlas,
        made.world,
        goal,
        start=told,  # type: ignore[arg-type]
        seed=seed,
        settings=settings,
    )
    proportions = made.proportions
    return Stage(navigator, simulator, page, truth_by_proportions(proportions), proportions.world_from_sketch)


def goal_of(order: Order, page: Page) -> Place:
    """Return the goal in the axes of the drawing's file, as ordered or as the drawing marks it."""
    if isinstance(order.goal, str):
        return order.goal
    if order.goal is not None:
        return page.file_point(*order.goal)
    if page.sketch.goal is None:
        raise NoGoalError("a drive needs a goal, the drawing marks none")
    x, y = page.sketch.file_from_sketch(np.array([page.sketch.goal]))[0].tolist()
    return x, y


def on_sketch(page: Page, point: tuple[float, ...]) -> tuple[float, float]:
    """Carry a point from the axes of the drawing's file to the sketch (y up)."""
    x, y = page.sketch.sketch_from_file(np.array([point[:2]], dtype=np.float64))[0].tolist()
    return x, y


def true_start(warp: Warp, page: Page, told: tuple[float, ...]) -> Pose2:
    """Carry a start that the robot is told to the building, so that it is told the truth."""
    x, y = warp.world_from_sketch(np.array([on_sketch(page, told)]))[0].tolist()
    return Pose2(x, y, told[2] if len(told) == 3 else 0.0)


def truth_by_warp(warp: Warp) -> Truth:
    """Carry true poses to a packed drawing."""

    def carry(world_from_base: Pose2) -> tuple[float, float, float]:
        pose = warp.sketch_from_base(world_from_base).pose
        return pose.x, pose.y, pose.theta

    return carry


def truth_by_proportions(proportions: Proportions) -> Truth:
    """Carry true poses to the drawing that the building was made of."""
    return proportions.sketch_pose
