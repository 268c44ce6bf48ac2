"""Trajectories as TUM text files: `stamp x y z qx qy qz qw` a line, `#` begins a comment."""

import math
from pathlib import Path

import numpy as np

from pilotage.errors import FileError
from pilotage.geometry import Trajectory
from pilotage.io.files import read_bytes


def read_trajectory(path: Path | str) -> Trajectory:
    """Read a trajectory in the plane: height is dropped and of the rotation only the heading is kept."""
    stamps: list[float] = []
    poses: list[tuple[float, float, float]] = []
    lines = read_bytes(path).decode("ascii", errors="replace").splitlines()
    for number, line in enumerate(lines, start=1):
        words = line.partition("#")[0].split()
        if not words:
            continue
        try:
            stamp, x, y, _, qx, qy, qz, qw = (float(word) for word in words)
        except ValueError as error:
            raise FileError(f"line {number} is not `stamp x y z qx qy qz qw`", path) from error
        if not all(map(math.isfinite, (stamp, x, y, qx, qy, qz, qw))):
            raise FileError(f"line {number} holds a number that is not finite", path)
        heading = math.atan2(2.0 * (qw * qz + qx * qy), 1.0 - 2.0 * (qy * qy + qz * qz))
        stamps.append(stamp)
        poses.append((x, y, heading))
    if not poses:
        raise FileError("the trajectory is empty", path)
    return Trajectory(np.array(stamps), np.array(poses))


def write_trajectory(path: Path | str, trajectory: Trajectory) -> None:
    """Write a trajectory to micrometers and microseconds."""
    lines = [
        f"{stamp:.6f} {x:.6f} {y:.6f} 0 0 0 {math.sin(theta / 2):.9f} {math.cos(theta / 2):.9f}\n"
        for stamp, (x, y, theta) in zip(trajectory.stamps, trajectory.poses, strict=True)
    ]
    Path(path).write_text("".join(lines), encoding="ascii")
