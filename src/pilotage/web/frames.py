"""A step of a drive as the page shows it: small, rounded, and in the axes of the page."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pilotage.drives import Instant
from pilotage.geometry import Array, Pose2
from pilotage.io.journal import finite
from pilotage.localization import Localizer
from pilotage.localization.particles import HEADING, displacements
from pilotage.navigation import Navigator
from pilotage.simulation import Scene, World
from pilotage.web.drawings import Json, Page, Rows, rounded_rows
from pilotage.web.words import sentence

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


@dataclass(slots=True)
class FrameMaker:
    """Makes frames of the steps of a drive."""

    navigator: Navigator
    page: Page
    cloud: Cloud
    truth: Truth | None  # None if it is not known where the world is on the drawing
    shows_world: bool  # whether anything true is known

    def frame(self, instant: Instant, t: float, goal: str) -> Json:
        """Describe a step; `goal` names where the robot is going."""
        step = instant.step
        return {
            "v": 1,
            "type": "frame",
            "live": True,
            "t": round(t, 2),
            "text": sentence(step, self.navigator.planner.graph, goal),
            "believed": self.believed(instant),
            "speed": [round(step.command.linear, 3), round(step.command.angular, 3)],
            "world": self.world(instant.scene) if self.shows_world else None,
        }

    def believed(self, instant: Instant) -> Json:
        """Describe what the robot believes now."""
        step, navigator, page = instant.step, self.navigator, self.page
        planner, now = navigator.planner, navigator.position.estimate
        leg = navigator.plan.leg
        gateway = planner.graph.gateway(step.gateway_id).segment if step.gateway_id else None
        return {
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
                    "place": planner.atlas.place_name(one.cell_id),
                    "cell": one.cell_id,
                    "pose": page.pose(*values(one.sketch_from_base.pose)),
                    "probability": round(one.probability, 3),
                }
                for one in now.hypotheses
            ],
            "particles": self.particles(),
            "scan": flat(page.points(now.sketch_from_base @ seen(instant.scene))),
            "behavior": step.behavior.value,
            "route": [] if leg is None or step.outcome else page.points(leg.route.way),
            "next_cell": step.next_cell_id,
            "gateway": None if gateway is None else page.points(gateway),
            "closed_gateways": list(step.closed_gateway_ids),
            "distance": round(step.distance, 1) if math.isfinite(step.distance) else None,
            "times_lost": step.times_lost,
        }

    def particles(self) -> list[float]:
        """List x, y and heading of particles, one after the other."""
        x, y, headings = self.cloud.states(self.navigator.position.odom_from_base)
        points = np.array(self.page.points(np.column_stack([x, y])))
        wrapped = np.round(np.arctan2(np.sin(headings), np.cos(headings)), 2)
        listed: list[float] = np.column_stack([points, wrapped]).ravel().tolist()
        return listed

    def world(self, scene: Scene) -> Json:
        """Describe what is true now."""
        pose = scene.world_from_base
        truly = self.truth(pose) if self.truth is not None else None
        return {
            "pose": [*world_points(np.array([pose.position]))[0], round(pose.theta, 3)],
            "scan": flat(world_points(pose @ seen(scene))),
            "people": world_points(scene.people),
            "doors": world_segments(scene.closed_doors),
            "on_drawing": None if truly is None else self.page.pose(*truly),
            "collisions": scene.collisions,
        }


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


def seen(scene: Scene) -> Array:
    """Return where beams came back, in the robot's frame, thinned, (n, 2) [m]."""
    points = scene.scan.points_in_base
    return points[:: max(1, len(scene.scan) // BEAMS)]


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
