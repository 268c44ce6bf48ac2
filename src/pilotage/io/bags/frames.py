"""The tree of frames that a robot publishes on /tf and /tf_static (REP-105), and the laser's mount in it."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from pilotage.geometry import Array, Pose2

MOST_TILTED = math.cos(math.radians(25.0))
"""A laser whose axis is farther from the vertical than this measures no floor plan."""

DIGITS = 12
"""Decimals of headings that are kept: a quaternion tells a heading to about 1e-15 rad, and rounding gives
back the number that the robot's driver made it of."""


@dataclass(frozen=True, eq=False)
class Transform:
    """Where a child frame stands in its parent frame, in space."""

    parent: str
    child: str
    stamp: float  # [s]
    rotation: Array  # (3, 3)
    translation: Array  # (3,) [m]

    @property
    def pose(self) -> Pose2:
        """The transform seen from above, for frames that stay upright."""
        return Pose2(float(self.translation[0]), float(self.translation[1]), heading_of(self.rotation))

    @property
    def matrix(self) -> Array:
        """As a homogeneous matrix, (4, 4)."""
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = self.rotation, self.translation
        return matrix


@dataclass(frozen=True, slots=True)
class Mount:
    """How a laser sits on its robot."""

    base_from_laser: Pose2
    is_mirrored: bool = False  # upside down: its beams turn clockwise, seen from above


def transforms_in(message: Any) -> Iterator[Transform]:  # noqa: ANN401  # types of ROS are made at run time
    """Read a tf2_msgs/TFMessage (or tf/tfMessage); transforms that are no numbers are passed over."""
    for one in message.transforms:
        move, turn = one.transform.translation, one.transform.rotation
        values = (move.x, move.y, move.z, turn.x, turn.y, turn.z, turn.w)
        if all(map(math.isfinite, values)) and math.hypot(*values[3:]) > 0.0:
            yield Transform(
                frame_name(one.header.frame_id),
                frame_name(one.child_frame_id),
                seconds(one.header.stamp),
                rotation_of(*values[3:]),
                np.array(values[:3]),
            )


def find_mount(edges: Mapping[str, Transform], base: str, laser: str) -> Mount | None:
    """Find the mount of a laser; None if no transforms lead from the one frame to the other.

    `edges` holds the transform of each child frame. Raises ValueError if the laser is tilted.
    """
    if base == laser:
        return Mount(Pose2.identity())
    above_base, above_laser = path_to_root(edges, base), path_to_root(edges, laser)
    shared = [frame for frame in above_laser if frame in above_base]
    if not shared:
        return None
    matrix = np.linalg.inv(above_base[shared[0]]) @ above_laser[shared[0]]
    upright = float(matrix[2, 2])
    if abs(upright) < MOST_TILTED:
        tilt_deg = math.degrees(math.acos(abs(upright)))
        raise ValueError(f"the laser must scan in a level plane, {laser} is tilted by {tilt_deg:.0f} degrees")
    x, y = np.round(matrix[:2, 3], DIGITS).tolist()
    return Mount(Pose2(x, y, heading_of(matrix[:3, :3])), is_mirrored=upright < 0.0)


def path_to_root(edges: Mapping[str, Transform], frame: str) -> dict[str, Array]:
    """Return each frame on the way up, and the matrix that leads to it from `frame`."""
    matrix = np.eye(4)
    found = {frame: matrix}
    while frame in edges and edges[frame].parent not in found:
        matrix = edges[frame].matrix @ matrix
        frame = edges[frame].parent
        found[frame] = matrix
    return found


def rotation_of(x: float, y: float, z: float, w: float) -> Array:  # the order of ROS
    """Return the rotation matrix of a quaternion of any length > 0, (3, 3)."""
    size = math.hypot(x, y, z, w)
    x, y, z, w = x / size, y / size, z / size, w / size
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def heading(x: float, y: float, z: float, w: float) -> float:  # the order of ROS
    """Return where a quaternion turns the x axis, seen from above [rad]; nan if it is none."""
    size = x * x + y * y + z * z + w * w
    if not size > 0.0:
        return math.nan
    return round(math.atan2(2.0 * (x * y + z * w), size - 2.0 * (y * y + z * z)), DIGITS)


def heading_of(rotation: Array) -> float:
    """Return where the x axis points, seen from above [rad]."""
    return round(math.atan2(float(rotation[1, 0]), float(rotation[0, 0])), DIGITS)


def frame_name(name: str) -> str:
    """Return a frame as ROS 2 writes it: ROS 1 began names with a slash.

    >>> frame_name("/base_link")
    'base_link'
    """
    return name.lstrip("/")


def seconds(stamp: Any) -> float:  # noqa: ANN401  # as above
    """Return the seconds [s] of a builtin_interfaces/Time, rounded once."""
    return float((int(stamp.sec) * 1_000_000_000 + int(stamp.nanosec)) / 1_000_000_000)
