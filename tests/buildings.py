"""Small buildings and robots for the tests."""

import itertools
import math

import numpy as np

from pilotage.geometry import Polyline, Pose2
from pilotage.kernels.raycast import cast
from pilotage.maps import AtlasSettings, RangeTableSettings, SchematicMap
from pilotage.perception import LaserScan, Odometry

# An L-shaped flat [m]: a long room with an alcove, and a smaller room behind a door.
WALLS = (
    Polyline.through([(0, 0), (8, 0), (8, 3), (10, 3), (10, 7), (6, 7), (6, 4.2)]),
    Polyline.through([(6, 3.2), (6, 3), (3, 3), (3, 7), (0, 7), (0, 0)]),
    Polyline.through([(6, 7), (3, 7)]),
)


# A corridor across, and two rooms on each side of it, a door each: strokes, each a list of points.
CORRIDOR_AND_FOUR_ROOMS = (
    [(0, 0), (20, 0), (20, 12), (0, 12), (0, 0)],
    [(10, 0), (10, 5)],
    [(10, 7), (10, 12)],
    [(0, 5), (4, 5)],
    [(5, 5), (14, 5)],
    [(15, 5), (20, 5)],
    [(0, 7), (4, 7)],
    [(5, 7), (14, 7)],
    [(15, 7), (20, 7)],
)


def flat(scale=1.0, sketch_from_world=None):
    """Draw the flat, so many units a metre, moved as a whole."""
    pose = sketch_from_world or Pose2.identity()
    return SchematicMap(tuple(Polyline(scale * wall.vertices).moved(pose) for wall in WALLS))


def coarse(cells=60, directions=60):
    """Look at a drawing coarsely, for the sake of time."""
    return AtlasSettings(range_table=RangeTableSettings(cells=cells, directions=directions))


def scan_at(pose, stamp=0.0, beams=181, fov=math.pi, walls=WALLS):
    """Sense the true flat without noise."""
    directions = np.linspace(-fov / 2, fov / 2, beams)
    segments = np.vstack([np.hstack([wall.ring[:-1], wall.ring[1:]]) for wall in walls])
    ranges = cast(np.tile(pose.position, (beams, 1)), pose.theta + directions, segments)
    return LaserScan(stamp, -fov / 2, fov / (beams - 1), ranges, range_max=30.0)


def walk():
    """Walk from the long room's far end through the alcove's side, in steps of 0.25 m; poses in the world."""
    corners = np.array([(1.0, 6.0), (1.0, 1.5), (7.0, 1.5), (7.0, 3.6), (8.5, 5.0)])
    poses = []
    for start, end in itertools.pairwise(corners):
        heading = math.atan2(*(end - start)[::-1])
        steps = max(round(np.hypot(*(end - start)) / 0.25), 1)
        poses += [Pose2(*(start + (end - start) * k / steps), heading) for k in range(steps)]
    return poses


def readings_of(poses, **scanner):
    """Take a scan at each pose; odometry is right but for its frame."""
    odom_from_world = Pose2(3.0, -2.0, 0.7)
    return [
        (scan_at(pose, float(k), **scanner), Odometry(float(k), odom_from_world @ pose))
        for k, pose in enumerate(poses)
    ]
