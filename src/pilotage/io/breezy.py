"""Read laser logs in the text format of BreezySLAM's examples (Bajracharya 2014): a line is a scan.

A line holds numbers only: the time [us], a counter, the ticks of the left and the right wheel, 20 more, and
682 ranges [mm] over 240 degrees. It does not describe its robot: all these logs are of the one below.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from pilotage.geometry import Array, Pose2
from pilotage.io.carmen import BrokenLine
from pilotage.perception import LaserScan, Odometry, Reading

BEAMS = 682
FIELD_OF_VIEW = math.radians(240.0)
FIRST_RANGE = 24
"""Number of words before the ranges."""
RANGE_LIMITS = 0.02, 5.6
"""[m] Below and above, the scanner (Hokuyo URG-04LX) writes codes of errors."""
BASE_FROM_LASER = Pose2(0.145, 0.0, 0.0)
WHEEL_RADIUS, HALF_AXLE, TICKS_PER_TURN = 0.077, 0.165, 2000  # [m], [m]


@dataclass(frozen=True, slots=True)
class BreezyLog:
    """All that was read from one log."""

    readings: tuple[Reading, ...]
    broken_lines: tuple[BrokenLine, ...]


def is_breezy(line: str) -> bool:
    """Tell whether a line is of this format."""
    words = line.split()
    return len(words) >= FIRST_RANGE + BEAMS and all(word.lstrip("-").isdecimal() for word in words[:4])


def read_breezy(lines: Iterable[str]) -> BreezyLog:
    """Read what can be read and name each line that cannot."""
    readings: list[Reading] = []
    broken: list[BrokenLine] = []
    pose, last_wheels = Pose2.identity(), np.full(2, np.nan)
    for number, line in enumerate(lines, start=1):
        if not line.strip():
            continue
        try:
            values = numbers_of(line)
            wheels = values[2:4] * (2.0 * math.pi / TICKS_PER_TURN * WHEEL_RADIUS)
            if np.isfinite(last_wheels).all():
                pose = pose @ motion(wheels - last_wheels)
            last_wheels = wheels
            stamp = float(values[0]) / 1e6
            readings.append(Reading(scan(stamp, values[FIRST_RANGE:] / 1000.0), Odometry(stamp, pose)))
        except ValueError as error:
            broken.append(BrokenLine(number, str(error)))
    return BreezyLog(tuple(readings), tuple(broken))


def numbers_of(line: str) -> Array:
    """Read the numbers of a line, (706,)."""
    values = np.array([float(word) for word in line.split()[: FIRST_RANGE + BEAMS]])
    if len(values) < FIRST_RANGE + BEAMS or not np.isfinite(values[:4]).all():
        raise ValueError(f"a line must hold {FIRST_RANGE + BEAMS} numbers, it holds {len(values)}")
    return values


def motion(way: Array) -> Pose2:
    """Return the motion on an arc by which the left and the right wheel rolled so far, (2,) [m]."""
    distance, turn = float(way.mean()), float(way[1] - way[0]) / (2.0 * HALF_AXLE)
    return Pose2(distance * math.cos(turn / 2.0), distance * math.sin(turn / 2.0), turn)


def scan(stamp: float, ranges: Array) -> LaserScan:
    """Build the scan of ranges, (682,) [m]."""
    return LaserScan(
        stamp,
        -FIELD_OF_VIEW / 2.0,
        FIELD_OF_VIEW / (BEAMS - 1),
        np.where(ranges == 0.0, np.nan, ranges),
        range_min=RANGE_LIMITS[0],
        range_max=RANGE_LIMITS[1],
        base_from_laser=BASE_FROM_LASER,
    )
