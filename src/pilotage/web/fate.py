"""A person plays fate: carries the robot off, closes a door, puts a box or someone into the way.

Each function changes the stage as a message of the page says, and returns what happened in words. What cannot
be done raises OrderError or StartError, and changes nothing.
"""

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from pilotage.geometry import Array, Polyline, Pose2
from pilotage.simulation import Door, Person, World
from pilotage.simulation.starting import is_in_building
from pilotage.web.order import FARTHEST, OrderError, number, switch
from pilotage.web.stage import Stage

NEAR_DOOR = 1.5
"""A door is meant by a click within this distance [m]."""
BOX, SMALLEST_BOX, LARGEST_BOX = 0.6, 0.1, 3.0
"""Side [m] of a box if nothing is said, and between which it may be."""
STROLL = 1.5
"""How far [m] a person walks to either side, if there is room."""
LEAST_STROLL = 0.05
"""A person without room takes small steps [m]."""
PERSON_ROOM = 0.3
"""Space [m] that a person needs."""
PERSON_SPEED = 0.7
"""Speed [m/s] of someone who gets into the way."""
EDGE = 0.1
"""So far [m] beyond the outermost wall a click still means the wall."""
OUTSIDE = "that is outside of the building"

Message = Mapping[str, object]


def kidnap(stage: Stage, message: Message) -> str:
    """Carry the robot elsewhere, unseen by its wheels."""
    x, y = point_within(stage.simulator.world, message)
    heading = number(message, "heading", -FARTHEST, FARTHEST, stage.simulator.world_from_base.theta)
    world, radius = stage.simulator.world, stage.simulator.settings.body.radius
    if not world.is_free([(x, y)], radius)[0]:
        raise OrderError("the robot cannot stand there, a wall or a thing is in the way")
    here = stage.simulator.world_from_base
    if not is_in_building(world, (x, y), (here.x, here.y), radius):
        raise OrderError(OUTSIDE)
    stage.simulator.carry(Pose2(x, y, heading))
    stage.sightings.clear()  # the way between them is broken
    return "the robot was carried elsewhere"


def move_door(stage: Stage, message: Message) -> str:
    """Close or open the nearest door, until a person changes it again."""
    x, y = world_point(message)
    closed = switch(message, "closed", otherwise=True)
    world = stage.simulator.world
    middles = np.array([door.segment.reshape(2, 2).mean(axis=0) for door in world.doors]).reshape(-1, 2)
    distances = np.hypot(middles[:, 0] - x, middles[:, 1] - y)
    if distances.min(initial=math.inf) > NEAR_DOOR:
        raise OrderError(f"there is no door within {NEAR_DOOR} m")
    chosen = int(distances.argmin())
    leaf = Door(world.doors[chosen].segment, ((stage.stamp, math.inf),) if closed else ())
    doors = (*world.doors[:chosen], leaf, *world.doors[chosen + 1 :])
    stage.simulator.rebuild(replace(world, doors=doors))
    return f"a door was {'closed' if closed else 'opened'}"


def put_box(stage: Stage, message: Message) -> str:
    """Put a box into the world."""
    middle = np.array(point_within(stage.simulator.world, message))
    size = number(message, "size", SMALLEST_BOX, LARGEST_BOX, BOX)
    robot = stage.simulator.world_from_base.position
    if float(np.abs(robot - middle).max()) < size / 2.0 + stage.simulator.settings.body.radius:
        raise OrderError("a box cannot stand where the robot is")
    corners = middle + 0.5 * size * np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])
    sides = np.hstack([corners, np.roll(corners, -1, axis=0)])
    world = stage.simulator.world
    stage.simulator.rebuild(replace(world, segments=np.vstack([world.segments, sides])))
    stage.boxes = np.vstack([stage.boxes, sides])
    return "a box was put there"


def put_person(stage: Stage, message: Message) -> str:
    """Let someone walk to and fro, across the way of the robot if there is room."""
    world = stage.simulator.world
    here = np.array(point_within(world, message))
    if not world.is_free([here], PERSON_ROOM)[0]:
        raise OrderError("a person cannot stand in a wall")
    across = stage.simulator.world_from_base.rotation[:, 1]
    ends = [here + sign * free_reach(world, here, sign * across) * across for sign in (-1.0, 1.0)]
    person = Person(Polyline(np.array(ends)), speed=PERSON_SPEED)
    stage.simulator.rebuild(replace(world, people=(*world.people, person)))
    return "someone walks there"


def world_point(message: Message) -> tuple[float, float]:
    """Read a point of the world [m], and turn its y axis up."""
    return number(message, "x", -FARTHEST, FARTHEST), -number(message, "y", -FARTHEST, FARTHEST)


def point_within(world: World, message: Message) -> tuple[float, float]:
    """Read a point [m] within the outermost walls of the world; OrderError if it is not."""
    x, y = world_point(message)
    left, bottom, right, top = world.bounds
    if not (left - EDGE <= x <= right + EDGE and bottom - EDGE <= y <= top + EDGE):
        raise OrderError(OUTSIDE)
    return x, y


def free_reach(world: World, here: Array, along: Array) -> float:
    """Return how far one can walk in a direction (2,) of length 1 [m], from LEAST_STROLL to STROLL."""
    steps = np.linspace(LEAST_STROLL, STROLL, 16)
    is_free = world.is_free(here + steps[:, np.newaxis] * along, PERSON_ROOM)
    count = len(steps) if is_free.all() else int(np.argmin(is_free))
    return float(steps[:count].max(initial=LEAST_STROLL))


FATES = {"kidnap": kidnap, "door": move_door, "box": put_box, "person": put_person}
"""What each message does."""
