"""Read laser logs in CARMEN's text format, as the Carnegie Mellon navigation toolkit wrote them.

A line is one message. Read are `FLASER` and `RLASER` (front and rear laser), `ROBOTLASER1` and `ODOM`; all
others are passed over:

    FLASER n r_1 .. r_n  x y theta  odom_x odom_y odom_theta  stamp host logger_stamp
    ROBOTLASER1 type start fov step max_range accuracy remission_mode n r_1 .. r_n m e_1 .. e_m
        x y theta  odom_x odom_y odom_theta  tv rv safety safety turn_axis  stamp host logger_stamp
    ODOM x y theta tv rv accel  stamp host logger_stamp
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from pilotage.geometry import Array, Pose2, wrap_angle
from pilotage.perception import LaserScan, Odometry, Reading

KNOWN_MESSAGES = frozenset(
    {
        "FLASER",
        "RLASER",
        "ROBOTLASER1",
        "ODOM",
        "PARAM",
        "RAWLASER1",
        "RAWLASER2",
        "ROBOTLASER2",
        "SYNC",
        "TRUEPOS",
    }
)
TRUSTED_RANGE = 50.0  # [m] SICK lasers report what did not return as 50 m or a little more, or as 81.91 m
SHORTEST_RANGE = 0.02  # [m] nothing nearer is a return; some drivers write 0 for a fault
SATURATION_NEIGHBORHOOD = 1.0  # [m] below the largest range, to compare how often ranges occur
SATURATION_COUNT = 20  # a largest range that occurs less often than this is no sign of a limit
FIELDS_OF_VIEW_DEG = {401: 100.0, 541: 270.0, 1081: 270.0}  # by number of beams; all others 180
MOUNT_SPREAD = 0.01  # [m, rad] a mount that moves more than this is no mount but a corrected pose
MOUNT_REACH = 2.0  # [m] no laser sits farther from its robot's center
FARTHEST = 1e9  # [m] a position beyond this is a broken number


@dataclass(frozen=True, slots=True)
class BrokenLine:
    """A line that could not be read and was passed over."""

    number: int  # counted from 1
    reason: str

    def __str__(self) -> str:
        """Say where and why."""
        return f"line {self.number}: {self.reason}"


@dataclass(frozen=True, slots=True)
class CarmenLog:
    """All that was read from one log."""

    readings: tuple[Reading, ...]  # in the order of the file
    odometry: tuple[Odometry, ...]  # of scans and ODOM lines, in the order of the file
    broken_lines: tuple[BrokenLine, ...]
    recognized: bool  # whether any line is CARMEN's


@dataclass(frozen=True, slots=True)
class _Message:
    """A laser message, before the limits of the laser and its mount are known."""

    name: str
    angle_min: float
    angle_increment: float
    range_max: float
    ranges: Array
    odom_from_laser: Pose2
    odometry: Odometry


def read_carmen(lines: Iterable[str]) -> CarmenLog:
    """Read what can be read and name each line that cannot."""
    messages: list[_Message] = []
    odometry: list[Odometry] = []
    broken: list[BrokenLine] = []
    recognized = False
    for number, line in enumerate(lines, start=1):
        name, *words = line.split() or ["#"]
        recognized = recognized or name in KNOWN_MESSAGES
        try:
            if name in ("FLASER", "RLASER"):
                messages.append(_old_laser(name, words))
                odometry.append(messages[-1].odometry)
            elif name == "ROBOTLASER1":
                messages.append(_new_laser(name, words))
                odometry.append(messages[-1].odometry)
            elif name == "ODOM":
                odometry.append(_odometry(words[:3], words[6:7]))
        except ValueError as error:
            broken.append(BrokenLine(number, str(error)))
    return CarmenLog(_readings(messages), tuple(odometry), tuple(broken), recognized)


def _old_laser(name: str, words: Sequence[str]) -> _Message:
    """Read FLASER or RLASER, which tell nothing about the laser but how many beams it has."""
    ranges, rest = _counted(words)
    field_of_view = math.radians(FIELDS_OF_VIEW_DEG.get(len(ranges), 180.0))
    inclusive = len(ranges) % 2 == 1 and len(ranges) > 1
    return _Message(
        name,
        angle_min=-field_of_view / 2,
        angle_increment=field_of_view / (len(ranges) - inclusive),
        range_max=math.inf,
        ranges=ranges,
        odom_from_laser=_pose(rest[:3]),
        odometry=_odometry(rest[3:6], rest[6:7]),
    )


def _new_laser(name: str, words: Sequence[str]) -> _Message:
    """Read ROBOTLASER1, which describes its laser."""
    _, angle_min, field_of_view, increment, range_max, *_ = _numbers(words[:7], 7)
    ranges, rest = _counted(words[7:])
    _, rest = _counted(rest, at_least=0)
    if not increment > 0.0:
        increment = field_of_view / max(len(ranges) - 1, 1)
    if not (math.isfinite(angle_min) and math.isfinite(increment)):
        raise ValueError(f"the angles must be finite, got {angle_min} and steps of {increment} rad")
    if not (increment > 0.0 or len(ranges) == 1):
        raise ValueError(f"the angular resolution must be > 0 rad, got {increment}")
    return _Message(
        name,
        angle_min=angle_min,
        angle_increment=increment,
        range_max=range_max if range_max > 0.0 else math.inf,
        ranges=ranges,
        odom_from_laser=_pose(rest[:3]),
        odometry=_odometry(rest[3:6], rest[11:12]),
    )


def _numbers(words: Sequence[str], count: int) -> list[float]:
    """Read exactly so many numbers."""
    if len(words) != count:
        raise ValueError(f"the line is cut short: {count} numbers are missing or incomplete")
    return [float(word) for word in words]


def _counted(words: Sequence[str], at_least: int = 1) -> tuple[Array, Sequence[str]]:
    """Split a count and as many numbers from the words that follow."""
    if not words or not words[0].isdecimal() or int(words[0]) < at_least:
        raise ValueError(
            f"a count of at least {at_least} is expected, got {words[0] if words else 'nothing'}"
        )
    count = int(words[0])
    return np.array(_numbers(words[1 : 1 + count], count)), words[1 + count :]


def _pose(words: Sequence[str]) -> Pose2:
    """Read x, y and theta."""
    pose = Pose2(*_numbers(words, 3))
    if max(abs(pose.x), abs(pose.y)) > FARTHEST:
        raise ValueError(f"a position must be within {FARTHEST:g} m, got ({pose.x:g}, {pose.y:g})")
    return pose


def _odometry(pose: Sequence[str], stamp: Sequence[str]) -> Odometry:
    """Read a pose and its stamp."""
    (seconds,) = _numbers(stamp, 1)
    if not math.isfinite(seconds):
        raise ValueError(f"a stamp must be finite, got {seconds}")
    return Odometry(seconds, _pose(pose))


def _readings(messages: Sequence[_Message]) -> tuple[Reading, ...]:
    """Give every scan the limit and the mount that all scans of its laser agree on."""
    by_laser = {name: [m for m in messages if m.name == name] for name in sorted({m.name for m in messages})}
    limits = {name: _range_limit(group) for name, group in by_laser.items()}
    mounts = {name: _mount(group) for name, group in by_laser.items()}
    return tuple(
        Reading(
            LaserScan(
                message.odometry.stamp,
                message.angle_min,
                message.angle_increment,
                message.ranges,
                range_min=SHORTEST_RANGE,
                range_max=max(min(limits[message.name], message.range_max), 2 * SHORTEST_RANGE),
                base_from_laser=mounts[message.name],
            ),
            message.odometry,
        )
        for message in messages
    )


def _range_limit(messages: Sequence[_Message]) -> float:
    """Find the range [m] that means no return.

    A largest range that occurs more often than all ranges of the last meter below it is where the laser
    saturates.
    """
    ranges = np.concatenate([message.ranges for message in messages])
    ranges = ranges[np.isfinite(ranges) & (ranges < TRUSTED_RANGE)]
    if len(ranges) == 0:
        return TRUSTED_RANGE
    largest = float(ranges.max())
    near = int(np.count_nonzero((ranges > largest - SATURATION_NEIGHBORHOOD) & (ranges < largest)))
    full = int(np.count_nonzero(ranges == largest))
    return largest if full >= SATURATION_COUNT and full > near else TRUSTED_RANGE


def _mount(messages: Sequence[_Message]) -> Pose2:
    """Find `base_from_laser` from the two poses of each line, if they stand still against each other.

    In corrected logs they do not, since only one of them was corrected; then the laser is taken to sit at the
    robot's center. A rear laser looks backward, even where its pose was written without the half turn.
    """
    mounts = [message.odometry.odom_from_base.inverse() @ message.odom_from_laser for message in messages]
    first = mounts[0]
    steady = math.hypot(first.x, first.y) <= MOUNT_REACH and all(
        max(abs(mount.x - first.x), abs(mount.y - first.y), abs(wrap_angle(mount.theta - first.theta)))
        <= MOUNT_SPREAD
        for mount in mounts
    )
    mount = first if steady else Pose2.identity()
    if messages[0].name == "RLASER" and abs(mount.theta) < math.pi / 2:
        return replace(mount, theta=mount.theta + math.pi)
    return mount
