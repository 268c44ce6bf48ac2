"""Write small bags of every kind by rosbags, message by message."""

import math
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_typestore

KINDS = (".bag", ".db3", ".mcap")
STORES = {
    kind: get_typestore(Stores.ROS1_NOETIC if kind == ".bag" else Stores.ROS2_JAZZY) for kind in (".bag", "")
}
SCAN, ODOMETRY, TRANSFORMS = "sensor_msgs/msg/LaserScan", "nav_msgs/msg/Odometry", "tf2_msgs/msg/TFMessage"


class Maker:
    """Makes messages for ROS 1 (`.bag`) or ROS 2 (all else)."""

    def __init__(self, kind: str) -> None:
        self.is_first = kind == ".bag"
        self.store = STORES[".bag" if self.is_first else ""]

    def make(self, name: str, *values: object) -> Any:  # noqa: ANN401  # types of ROS are made at run time
        """Make a message of the values of its fields in order."""
        return self.store.types[name](*values)

    def header(self, stamp: float, frame: str) -> Any:  # noqa: ANN401  # as above
        """Make a header; ROS 1 counts messages in it."""
        nanoseconds = round(stamp * 1e9)
        time = self.make("builtin_interfaces/msg/Time", *divmod(nanoseconds, 10**9))
        return self.make("std_msgs/msg/Header", *([0] if self.is_first else []), time, frame)

    def scan(
        self,
        stamp: float,
        ranges: Any,  # noqa: ANN401  # of numbers
        *,
        frame: str = "laser",
        angle_min: float = -math.pi / 2,
        increment: float | None = None,
        range_max: float = 30.0,
    ) -> tuple[str, Any]:
        """Make a sensor_msgs/LaserScan, and name its type; without an increment it spans 180 degrees."""
        increment = math.pi / (len(ranges) - 1) if increment is None else increment
        header, nothing = self.header(stamp, frame), np.zeros(0, np.float32)
        values = (angle_min, angle_min + increment * (len(ranges) - 1), increment, 0.0, 0.1, 0.02, range_max)
        return SCAN, self.make(SCAN, header, *values, np.array(ranges, np.float32), nothing)

    def odometry(self, stamp: float, pose: Iterable[float], child: str = "base_link") -> tuple[str, Any]:
        """Make a nav_msgs/Odometry of x, y, theta, and name its type."""
        x, y, theta = pose
        place = self.make("geometry_msgs/msg/Pose", self.point(x, y), self.turned(theta))
        zero = self.make("geometry_msgs/msg/Vector3", 0.0, 0.0, 0.0)
        twist = self.make("geometry_msgs/msg/Twist", zero, zero)
        return ODOMETRY, self.make(
            ODOMETRY,
            self.header(stamp, "odom"),
            child,
            self.make("geometry_msgs/msg/PoseWithCovariance", place, np.zeros(36)),
            self.make("geometry_msgs/msg/TwistWithCovariance", twist, np.zeros(36)),
        )

    def transform(
        self,
        parent: str,
        child: str,
        stamp: float = 0.0,
        *,
        position: tuple[float, float, float] = (0.0, 0.0, 0.0),
        quaternion: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0),
    ) -> tuple[str, Any]:
        """Make a TFMessage of one transform, and name its type."""
        body = self.make(
            "geometry_msgs/msg/Transform",
            self.make("geometry_msgs/msg/Vector3", *position),
            self.make("geometry_msgs/msg/Quaternion", *quaternion),
        )
        return TRANSFORMS, self.make(
            TRANSFORMS,
            [self.make("geometry_msgs/msg/TransformStamped", self.header(stamp, parent), child, body)],
        )

    def point(self, x: float, y: float) -> Any:  # noqa: ANN401  # as above
        """Make a point of the plane."""
        return self.make("geometry_msgs/msg/Point", x, y, 0.0)

    def turned(self, theta: float) -> Any:  # noqa: ANN401  # as above
        """Make a turn about the vertical."""
        return self.make("geometry_msgs/msg/Quaternion", 0.0, 0.0, math.sin(theta / 2), math.cos(theta / 2))


def write_bag(
    path: Path, messages: Iterable[tuple[str, float, tuple[str, Any]]], kind: str = ".mcap"
) -> Path:
    """Write (topic, time of recording, (type, message)) in their order; return what is to be opened."""
    store = Maker(kind).store
    plugin = StoragePlugin.MCAP if kind == ".mcap" else StoragePlugin.SQLITE3
    with Writer1(path) if kind == ".bag" else Writer2(path, version=9, storage_plugin=plugin) as writer:
        connections = {}
        for topic, recorded, (name, message) in messages:
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, name, typestore=store)
            raw = (
                store.serialize_ros1(message, name) if kind == ".bag" else store.serialize_cdr(message, name)
            )
            writer.write(connections[topic], round(recorded * 1e9), raw)
    return path


def decoded(path: Path, topic: str | None = None) -> Iterator[tuple[str, str, Any]]:
    """Go through (topic, type, message) of an MCAP file by a reader that is not rosbags."""
    with path.open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        for schema, channel, _, message in reader.iter_decoded_messages(topics=topic and [topic]):
            yield channel.topic, schema.name, message
