"""A step of a drive as the page shows it: small, rounded, and in the axes of the page."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from pilotage.geometry import Array, Pose2
from pilotage.io.journal import finite
from pilotage.localization import Estimate, Localizer
from pilotage.localization.particles import HEADING, displacements
from pilotage.maps import CellGraph
from pilotage.navigation import Navigator, Step
from pilotage.navigation.route_leg import RouteLeg
from pilotage.perception import LaserScan
from pilotage.simulation import Scene, World
from pilotage.web.drawings import Json, Page, Rows, rounded_rows
from pilotage.web.words import place_of, sentence

PARTICLES = 250
"""Particles that are shown."""
BEAMS = 120
"""Beams that are shown."""
CENTIMETRES = 2
"""Decimals of metres."""

Truth = Callable[[Pose2], tuple[float, float, float]]
"""Where on the drawing a true pose is: x, y, heading (y up)."""


class Cloud:
    """The particles of the localizer, moved along between its updates."""

    def __init__(self, localizer: Localizer) -> None:
        self._localizer = localizer
        self._tracks = localizer.tracks
        self._odom_from_base = Pose2.identity()

    def note(self, odom_from_base: Pose2) -> None:
        """Note at each scan where the robot is by odometry, to know where the particles were made."""
        if self._localizer.tracks is not self._tracks:
            self._tracks, self._odom_from_base = self._localizer.tracks, odom_from_base

    def states(self, odom_from_base: Pose2) -> Array:
        """Return x, y and heading of equally probable particles as they are now, (3, n)."""
        states = self._localizer.sample(PARTICLES)
        motion = self._odom_from_base.inverse() @ odom_from_base
        moved = states[:2] + displacements(states, motion.x, motion.y)
        return np.vstack([moved, states[HEADING] + motion.theta])


def told_frame(step: Step, now: Estimate, t: float, *, page: Page, graph: CellGraph, goal: str) -> Json:
    """Describe what a step tells; `now` is its estimate moved along, `goal` where the robot is going."""
    gateway = next((one for one in graph.gateways if one.gateway_id == step.gateway_id), None)
    return {
        "v": 1,
        "type": "frame",
        "live": True,
        "t": round(t, 2),
        "text": sentence(step, graph, goal),
        "believed": {
            "status": now.status.value,
            "place": step.estimate.place,
            "cell": step.estimate.cell_id,
            "probability": round(now.probability, 3),
            "cell_probability": round(step.estimate.cell_probability, 3),
            "fit": round(now.fit, 3),
            "pose": page.pose(*values(now.sketch_from_base.pose)),
            "scale": finite(now.scale),
            "places": [
                {
                    "place": place_of(one.cell_id, graph),
                    "cell": one.cell_id,
                    "pose": page.pose(*values(one.sketch_from_base.pose)),
                    "probability": round(one.probability, 3),
                }
                for one in now.hypotheses
            ],
            "particles": [],
            "scan": [],
            "behavior": step.behavior.value,
            "route": [],
            "next_cell": step.next_cell_id,
            "gateway": None if gateway is None else page.points(gateway.segment),
            "closed_gateways": list(step.closed_gateway_ids),
            "distance": round(step.distance, 1) if math.isfinite(step.distance) else None,
            "times_lost": step.times_lost,
        },
        "speed": [round(step.command.linear, 3), round(step.command.angular, 3)],
        "world": None,
    }


def with_senses(
    told: Json, now: Estimate, states: Array, scan: LaserScan, leg: RouteLeg | None, *, page: Page
) -> Json:
    """Add to a frame the particles (3, n), the scan and the route behind it."""
    believed = told["believed"]
    assert isinstance(believed, dict)
    senses = {
        "particles": poses_of(states, page),
        "scan": flat(page.points(now.sketch_from_base @ seen(scan))),
        "route": [] if leg is None else page.points(leg.route.way),
    }
    return {**told, "believed": {**believed, **senses}}


def poses_of(states: Array, page: Page) -> list[float]:
    """List x, y and heading of particles (3, n), one after the other."""
    x, y, headings = states
    points = np.array(page.points(np.column_stack([x, y])))
    wrapped = np.round(np.arctan2(np.sin(headings), np.cos(headings)), 2)
    listed: list[float] = np.column_stack([points, wrapped]).ravel().tolist()
    return listed


@dataclass(slots=True)
class FrameMaker:
    """Makes frames of the steps of a navigator that is at work here."""

    navigator: Navigator
    page: Page
    truth: Truth | None = None  # None if it is not known where the world is on the drawing
    cloud: Cloud = field(init=False)

    def __post_init__(self) -> None:
        """Begin with the particles that are there."""
        self.cloud = Cloud(self.navigator.position.localizer)

    def note(self) -> None:
        """Note after each step where the robot is by odometry."""
        self.cloud.note(self.navigator.position.odom_from_base)

    def frame(self, step: Step, scan: LaserScan, t: float, goal: str) -> Json:
        """Describe a step and the particles, the scan and the route behind it."""
        position, graph = self.navigator.position, self.navigator.planner.graph
        told = told_frame(step, position.estimate, t, page=self.page, graph=graph, goal=goal)
        states = self.cloud.states(position.odom_from_base)
        leg = None if step.outcome else self.navigator.plan.leg
        return with_senses(told, position.estimate, states, scan, leg, page=self.page)

    def world(self, scene: Scene) -> Json:
        """Describe what is true now."""
        pose = scene.world_from_base
        truly = self.truth(pose) if self.truth is not None else None
        return {
            **true_pose(pose, scene.collisions),
            "scan": flat(world_points(pose @ seen(scene.scan))),
            "people": world_points(scene.people),
            "doors": world_segments(scene.closed_doors),
            "on_drawing": None if truly is None else self.page.pose(*truly),
        }


def true_pose(pose: Pose2, collisions: int) -> Json:
    """Describe where the robot truly is, in a world of which nothing else is known."""
    return {
        "pose": [*true_place(pose), round(pose.theta, 3)],
        "scan": [],
        "people": [],
        "doors": [],
        "on_drawing": None,
        "collisions": collisions,
    }


def true_place(pose: Pose2) -> list[float]:
    """List a point of the world, y down."""
    return world_points(np.array([pose.position]))[0]


def describe_world(world: World, boxes: Array, goal: Array | None, stamp: float) -> Json:
    """Describe all that stands; a person put `boxes` (n, 4) there, and `goal` (2,) is the true one."""
    left, bottom, right, top = world.bounds
    return {
        "v": 1,
        "type": "world",
        "bounds": [round(value, CENTIMETRES) for value in (left, -top, right, -bottom)],
        "walls": world_segments(world.segments[: len(world.segments) - len(boxes)]),
        "glass": world_segments(world.glass),
        "boxes": world_segments(boxes),
        "doors": [
            {
                "segment": world_segments(door.segment[np.newaxis])[0],
                "closed": door.should_be_closed(stamp),
            }
            for door in world.doors
        ],
        "goal": None if goal is None else world_points(goal[np.newaxis])[0],
    }


def seen(scan: LaserScan) -> Array:
    """Return where beams came back, in the robot's frame, thinned, (n, 2) [m]."""
    return scan.points_in_base[:: max(1, len(scan) // BEAMS)]


def world_points(points: Array) -> Rows:
    """List points (n, 2) of the world, y down."""
    return rounded_rows(points.reshape(-1, 2) * (1.0, -1.0), CENTIMETRES)


def world_segments(segments: Array) -> Rows:
    """List segments (n, 4) of the world, y down."""
    return rounded_rows(segments.reshape(-1, 4) * (1.0, -1.0, 1.0, -1.0), CENTIMETRES)


def flat(rows: Rows) -> list[float]:
    """List all numbers of rows one after the other."""
    return [value for row in rows for value in row]


def values(pose: Pose2) -> tuple[float, float, float]:
    """Return x, y and heading."""
    return pose.x, pose.y, pose.theta
