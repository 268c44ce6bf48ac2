"""Where a robot begins if its start is not given."""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Pose2
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
    left, bottom, right, top = world.bounds
    xs, ys = (np.arange(low, high + MESH, MESH) for low, high in ((left, right), (bottom, top)))
    places = np.stack(np.meshgrid(xs, ys), axis=-1)
    free = world.is_free(places.reshape(-1, 2), radius + ROOM).reshape(places.shape[:2])
    found = places[largest_enclosed(free)]
    if len(found) == 0:
        raise StartError("a world must have free space that walls enclose, found none where the robot fits")
    x, y = found[rng.integers(len(found))]
    return Pose2(x, y, rng.uniform(-math.pi, math.pi))


def largest_enclosed(free: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Mark the largest connected part of a mesh that does not touch its rim; nothing if there is none.

    >>> largest_enclosed(np.array([[0, 0, 0, 0], [0, 1, 0, 1], [0, 0, 0, 1]], dtype=bool)).nonzero()
    (array([1]), array([1]))
    """
    from skimage.measure import label

    parts: NDArray[np.intp] = label(free, connectivity=1)
    sizes = np.bincount(parts.ravel())
    sizes[[0, *np.unique(np.concatenate([parts[0], parts[-1], parts[:, 0], parts[:, -1]]))]] = 0
    return np.asarray((parts == sizes.argmax()) & bool(sizes.any()))
