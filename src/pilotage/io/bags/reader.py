"""Read a bag in two passes: the first finds frames, odometry and stamps, the second streams the scans.

Only one scan is held at a time, so that an hour of a fast laser takes no more memory than a minute.
"""

import math
from array import array
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from pilotage.errors import FileError
from pilotage.geometry import Array, Pose2
from pilotage.io.bags.frames import (
    Mount,
    Transform,
    find_mount,
    frame_name,
    heading,
    seconds,
    transforms_in,
)
from pilotage.io.bags.messages import (
    ODOMETRY_TYPE,
    SCAN_TYPE,
    TRANSFORM_TYPES,
    Bag,
    opened,
    suffix_by_content,
)
from pilotage.io.bags.scans import laser_scan
from pilotage.io.bags.stamps import OdometryTrack, counted, pose_of, put_in_order
from pilotage.perception import Odometry, Reading

DEFAULT_BASE = "base_link"
"""The robot's frame (REP-105), where odometry does not name one."""

ODOMETRY_FRAME = "odom"
"""The frame of odometry (REP-105)."""

HALF = 0.5
"""If the stamps of fewer scans than this share meet odometry, the two were stamped by different clocks."""


@dataclass(frozen=True, eq=False)
class BagLog:
    """What a bag holds for us."""

    readings: "BagReadings"
    remarks: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class BagReadings(Sequence[Reading]):
    """The readings of a bag, read from the file whenever they are gone through."""

    path: Path
    topic: str
    stamps: Array  # (n,) [s] of all scans in the file
    poses: Array  # (n, 3) odom_from_base
    used: NDArray[np.int64]  # (m,) indices of the scans that are readings, rising
    mount: Mount
    has_odometry: bool

    def __len__(self) -> int:
        """Count the readings."""
        return len(self.used)

    @overload
    def __getitem__(self, index: int) -> Reading: ...
    @overload
    def __getitem__(self, index: slice) -> "BagReadings": ...
    def __getitem__(self, index: int | slice) -> "Reading | BagReadings":
        """Read one reading, or take some of them without reading any."""
        if isinstance(index, slice):
            return replace(self, used=np.sort(self.used[index]))
        one = self.used[index]  # raises IndexError
        return next(iter(replace(self, used=np.array([one]))))

    def __iter__(self) -> Iterator[Reading]:
        """Read the scans in the order of the file."""
        if len(self.used) == 0:
            return
        wanted = np.zeros(len(self.stamps), dtype=bool)
        wanted[self.used] = True
        last = int(self.used[-1])
        with opened(self.path) as bag:
            for index, message in enumerate(bag.messages([self.topic])):
                if index > last:
                    return
                if wanted[index]:
                    yield self._reading(message.body, index)

    def _reading(self, body: Any, index: int) -> Reading:  # noqa: ANN401  # of rosbags
        """Join a scan and its odometry."""
        stamp = float(self.stamps[index])
        pose = pose_of(self.poses[index])
        return Reading(laser_scan(body, stamp, self.mount), Odometry(stamp, pose, self.has_odometry))


@dataclass(eq=False)
class Recording:
    """What the first pass gathers; arrays of numbers only, so that it stays small."""

    scan_stamps: "array[float]" = field(default_factory=lambda: array("d"))
    scan_recorded: "array[float]" = field(default_factory=lambda: array("d"))
    laser_frame: str = ""
    broken: dict[int, str] = field(default_factory=dict)  # index of a scan, and what is wrong with it
    odometry: "array[float]" = field(default_factory=lambda: array("d"))  # stamp, recorded, x, y, theta
    base_frame: str = ""
    _sound: object = None  # what the last sound scan was like
    edges: dict[str, Transform] = field(default_factory=dict)  # the first transform of each child
    moves: "dict[str, array[float]]" = field(default_factory=dict)  # of each child on /tf, as odometry

    def add(self, topic_kind: str, body: Any, recorded: float) -> None:  # noqa: ANN401  # of rosbags
        """Take one message in."""
        if topic_kind == "scan":
            self._add_scan(body, recorded)
        elif topic_kind == "odometry":
            self._add_odometry(body, recorded)
        else:
            self._add_transforms(body, recorded)

    def _add_scan(self, body: Any, recorded: float) -> None:  # noqa: ANN401  # of rosbags
        stamp = seconds(body.header.stamp)
        kind = body.angle_min, body.angle_increment, body.range_min, body.range_max, len(body.ranges) > 0
        if kind != self._sound:  # ranges may be any numbers: scans alike but for them are sound alike
            try:
                laser_scan(body, stamp, Mount(Pose2.identity()), beams=2)
                self._sound = kind
            except ValueError as error:
                self.broken[len(self.scan_stamps)] = str(error)
        self.laser_frame = self.laser_frame or frame_name(body.header.frame_id)
        self.scan_stamps.append(stamp)
        self.scan_recorded.append(recorded)

    def _add_odometry(self, body: Any, recorded: float) -> None:  # noqa: ANN401  # of rosbags
        place, turn = body.pose.pose.position, body.pose.pose.orientation
        theta = heading(turn.x, turn.y, turn.z, turn.w)
        if not all(map(math.isfinite, (place.x, place.y, theta))):
            return
        self.base_frame = self.base_frame or frame_name(body.child_frame_id)
        self.odometry.extend((seconds(body.header.stamp), recorded, place.x, place.y, theta))

    def _add_transforms(self, body: Any, recorded: float) -> None:  # noqa: ANN401  # of rosbags
        for one in transforms_in(body):
            self.edges.setdefault(one.child, one)
            pose = one.pose
            rows = self.moves.setdefault(one.child, array("d"))
            rows.extend((one.stamp, recorded, pose.x, pose.y, pose.theta))

    def odometry_from_transforms(self) -> None:
        """Take odometry from /tf: the transform above the laser whose parent is `odom`, if there is one."""
        frame, seen = self.laser_frame, set[str]()
        while frame in self.edges and frame not in seen:
            seen.add(frame)
            parent = self.edges[frame].parent
            if parent.rpartition("/")[2] == ODOMETRY_FRAME:
                self.odometry, self.base_frame = self.moves[frame], frame
                return
            frame = parent


def is_bag(path: Path) -> bool:
    """Tell whether a file or folder looks like a recording of ROS."""
    return path.is_dir() or suffix_by_content(path) is not None


def read_bag(path: Path, scan_topic: str | None = None, odometry_topic: str | None = None) -> BagLog:
    """Read all but the scans themselves; raise FileError if there is nothing to localize by.

    Topics are found by type if they are not named.
    """
    suffix = None if path.is_dir() else suffix_by_content(path)
    if suffix is not None and path.suffix != suffix:
        raise FileError(f"the name of such a bag must end in {suffix}", path)
    remarks: list[str] = []
    with opened(path) as bag:
        scans = choose(bag, path, SCAN_TYPE, (scan_topic, "--scan-topic"), remarks)
        if scans is None:
            raise FileError(f"the bag holds no topic of type {SCAN_TYPE}", path)
        odometry = choose(bag, path, ODOMETRY_TYPE, (odometry_topic, "--odom-topic"), remarks)
        recording = first_pass(bag, scans, odometry)
    if not recording.odometry:
        recording.odometry_from_transforms()
    if not len(recording.scan_stamps) > len(recording.broken):
        reasons = f": {next(iter(recording.broken.values()))}" if recording.broken else ""
        raise FileError(f"the topic {scans} holds no scan that can be read{reasons}", path)
    return joined(path, scans, recording, remarks)


def choose(
    bag: Bag, path: Path, type_name: str, wanted: tuple[str | None, str], remarks: list[str]
) -> str | None:
    """Choose a topic: the one that an option names, or the only one, or the one with most messages."""
    name, option = wanted
    topics = {each: count for each, count in bag.topics(type_name).items() if count or each == name}
    if name is not None:
        if name not in topics:
            there = ", ".join(topics) or "none"
            raise FileError(
                f"{option} must name a topic of type {type_name}, got {name}; there are: {there}", path
            )
        return name
    if not topics:
        return None
    best = max(topics, key=lambda each: topics[each])
    if len(topics) > 1:
        others = ", ".join(each for each in topics if each != best)
        remarks.append(f"{best} is used, {option} chooses another ({others})")
    return best


def first_pass(bag: Bag, scans: str, odometry: str | None) -> Recording:
    """Go through all messages that matter."""
    kinds = dict.fromkeys(bag.topics(*TRANSFORM_TYPES), "transforms")
    kinds[scans] = "scan"
    if odometry is not None:
        kinds[odometry] = "odometry"
    recording = Recording()
    for message in bag.messages(list(kinds)):
        recording.add(kinds[message.topic], message.body, message.recorded)
    return recording


def joined(path: Path, topic: str, recording: Recording, remarks: list[str]) -> BagLog:
    """Give each scan its odometry, and say what had to be left out."""
    stamps, recorded = np.array(recording.scan_stamps), np.array(recording.scan_recorded)
    rows = np.array(recording.odometry).reshape(-1, 5)
    has_odometry = len(rows) > 0
    order, track = put_in_order(stamps), OdometryTrack.of(rows[:, 0], rows[:, 2:])
    poses, known = track.at(stamps, order.epochs)
    if not stamps.any() or (has_odometry and known[order.kept].mean() < HALF):
        by_recording = put_in_order(recorded), OdometryTrack.of(rows[:, 1], rows[:, 2:])
        other_poses, other_known = by_recording[1].at(recorded, by_recording[0].epochs)
        if not stamps.any() or other_known.mean() > known.mean():
            stamps, (order, track), poses, known = recorded, by_recording, other_poses, other_known
            remarks.append("the stamps of scans and odometry do not agree, the times of recording are used")
    sound = np.ones(len(stamps), dtype=bool)
    sound[list(recording.broken)] = False
    usable = order.kept & sound & (known if has_odometry else True)
    if recording.broken:
        index, reason = next(iter(recording.broken.items()))
        remarks.append(
            f"{counted(len(recording.broken), 'broken scan')} left out, the first is {index}: {reason}"
        )
    remarks.extend(order.remarks)
    if not has_odometry:
        remarks.append("the log holds no odometry, the motion is taken from the scans alone")
    elif without := int((order.kept & sound & ~known).sum()):
        remarks.append(f"{counted(without, 'scan')} without odometry at the time, left out")
    if not usable.any():
        raise FileError(f"no scan of {topic} has odometry at its time", path)
    mount = mount_of(path, recording, remarks)
    used = np.flatnonzero(usable)
    readings = BagReadings(path, topic, stamps, poses, used, mount, has_odometry)
    return BagLog(readings, tuple(remarks))


def mount_of(path: Path, recording: Recording, remarks: list[str]) -> Mount:
    """Find where the laser sits; at the robot's center, looking ahead, if nothing tells."""
    base, laser = recording.base_frame, recording.laser_frame
    if not base:
        base = DEFAULT_BASE if recording.edges else laser
    try:
        mount = find_mount(recording.edges, base, laser)
    except ValueError as error:
        raise FileError(str(error), path) from error
    if mount is None:
        remarks.append(
            f"no transform leads from {base} to {laser}: the laser is taken to sit at the robot's center"
        )
        return Mount(Pose2.identity())
    return mount
