"""Where a robot begins if its start is not given."""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array, Pose2
from pilotage.simulation.simulator import StartError
from pilotage.simulation.world import World

MESH = 0.1
"""Distance [m] between the places that are tried."""
ROOM = 0.15
"""Distance [m] of a start from walls, beside the radius of the robot."""


def find_start(world: World, radius: float, rng: np.random.Generator) -> Pose2:
    """Draw a pose for a robot of this radius [m] from the largest free space that walls enclose.

    Raises StartError if there is none.
    """
    places, free = mesh_of(world, radius + ROOM)
    found = places[largest_enclosed(free)]
    if len(found) == 0:
        raise StartError("a world must have free space that walls enclose, found none where the robot fits")
    x, y = found[rng.integers(len(found))]
    return Pose2(x, y, rng.uniform(-math.pi, math.pi))


def mesh_of(world: World, radius: float) -> tuple[Array, NDArray[np.bool_]]:
    """Return places (rows, columns, 2) all over a world [m], and where a disc of this radius [m] is free."""
    left, bottom, right, top = world.bounds
    xs, ys = (np.arange(low, high + MESH, MESH) for low, high in ((left, right), (bottom, top)))
    places = np.stack(np.meshgrid(xs, ys), axis=-1)
    return places, world.is_free(places.reshape(-1, 2), radius).reshape(places.shape[:2])


def is_in_building(
    world: World, point: tuple[float, float], robot: tuple[float, float], radius: float
) -> bool:
    """Tell whether a robot of this radius [m] would be in the building at a point [m].

    It is if walls enclose it there, or if a way leads to where the robot is now: through a door that leads
    outside it may go.
    """
    places, free = mesh_of(world, radius)
    parts = parts_of(free)
    there, here = (
        parts.flat[np.where(free, np.hypot(*(places - one).transpose(2, 0, 1)), np.inf).argmin()]
        for one in (point, robot)
    )
    return bool(there == here or there not in rim_of(parts))


def largest_enclosed(free: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Mark the largest connected part of a mesh that does not touch its rim; nothing if there is none.

    >>> largest_enclosed(np.array([[0, 0, 0, 0], [0, 1, 0, 1], [0, 0, 0, 1]], dtype=bool)).nonzero()
    (array([1]), array([1]))
    """
    parts = parts_of(free)
    sizes = np.bincount(parts.ravel())
    sizes[[0, *rim_of(parts)]] = 0
    return np.asarray((parts == sizes.argmax()) & bool(sizes.any()))


def parts_of(free: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Give each connected part of a mesh a number from 1; the rest is 0."""
    from skimage.measure import label

    return np.asarray(label(free, connectivity=1))


def rim_of(parts: NDArray[np.intp]) -> NDArray[np.intp]:
    """List the numbers at the rim of a mesh."""
    return np.unique(np.concatenate([parts[0], parts[-1], parts[:, 0], parts[:, -1]]))
