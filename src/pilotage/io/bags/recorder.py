"""Write beliefs to an MCAP file that Foxglove, Lichtblick and RViz show without a plug-in."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from pilotage.geometry import Pose2
from pilotage.io.bags import outgoing
from pilotage.io.bags.belief import Belief, MapFrame
from pilotage.io.bags.ground import Ground
from pilotage.io.files import replacing
from pilotage.maps import CellGraph
from pilotage.perception import Reading

TYPES = {
    "/tf": "tf2_msgs/msg/TFMessage",
    "/tf_static": "tf2_msgs/msg/TFMessage",
    "/scan": "sensor_msgs/msg/LaserScan",
    "/map": "nav_msgs/msg/OccupancyGrid",
    "/diagnostics": "diagnostic_msgs/msg/DiagnosticArray",
    "/pilotage/pose": "geometry_msgs/msg/PoseWithCovarianceStamped",
    "/pilotage/path": "nav_msgs/msg/Path",
    "/pilotage/drawing": "visualization_msgs/msg/MarkerArray",
    "/pilotage/cells": "visualization_msgs/msg/MarkerArray",
    "/pilotage/hypotheses": "visualization_msgs/msg/MarkerArray",
}
"""The topics of a recording."""

LATCHED = frozenset({"/tf_static", "/map", "/pilotage/drawing", "/pilotage/cells"})
"""Topics whose last message is for all who come later."""

PATH_EVERY, PATH_STEP, PATH_LENGTH = 1.0, 0.25, 2000
"""The path is written once a second, of poses [m] apart, the last so many."""


class Recorder:
    """Turns beliefs into messages, one moment after the other."""

    def __init__(
        self, write: Callable[[str, float, Any], None], frame: MapFrame, graph: CellGraph | None
    ) -> None:
        self._write, self._frame, self._graph = write, frame, graph
        self._path: list[Pose2] = []
        self._path_told = -np.inf
        self._mount: Pose2 | None = None
        self._begun = False

    def add(self, belief: Belief, reading: Reading | None = None) -> None:
        """Write what was believed, and the scan and odometry that it was made of, if they are known."""
        stamp = belief.stamp
        if not self._begun:
            self._begin(stamp)
        if reading is None or not reading.odometry.is_known:
            self._write("/tf", stamp, outgoing.transform(stamp, outgoing.MAP, outgoing.BASE, belief.pose))
        else:
            odom_from_base = reading.odometry.odom_from_base
            map_from_odom = belief.pose @ odom_from_base.inverse()
            self._write("/tf", stamp, outgoing.transform(stamp, outgoing.MAP, outgoing.ODOM, map_from_odom))
            self._write("/tf", stamp, outgoing.transform(stamp, outgoing.ODOM, outgoing.BASE, odom_from_base))
        if reading is not None:
            self._add_scan(reading)
        self._write("/pilotage/pose", stamp, outgoing.pose_estimate(belief))
        self._write("/pilotage/hypotheses", stamp, outgoing.hypotheses(belief))
        self._write("/diagnostics", stamp, outgoing.diagnostics(belief))
        self._add_to_path(belief)

    def _begin(self, stamp: float) -> None:
        """Write what does not change."""
        self._begun = True
        self._write("/pilotage/drawing", stamp, outgoing.drawing(stamp, self._frame))
        self._write("/pilotage/cells", stamp, outgoing.cells(stamp, self._frame, self._graph))
        self._write("/map", stamp, outgoing.occupancy_grid(stamp, Ground.drawn(self._frame, self._graph)))

    def _add_scan(self, reading: Reading) -> None:
        """Write a scan, and the mount of its laser whenever it is another."""
        scan = reading.scan
        if scan.base_from_laser != self._mount:
            self._mount = scan.base_from_laser
            mount = outgoing.transform(scan.stamp, outgoing.BASE, outgoing.LASER, scan.base_from_laser)
            self._write("/tf_static", scan.stamp, mount)
        self._write("/scan", scan.stamp, outgoing.scan_message(scan))

    def _add_to_path(self, belief: Belief) -> None:
        """Write the way so far now and then."""
        here = belief.pose
        if not self._path or np.hypot(*(here.position - self._path[-1].position)) >= PATH_STEP:
            self._path = [*self._path[-PATH_LENGTH + 1 :], here]
        if not 0.0 <= belief.stamp - self._path_told < PATH_EVERY:
            self._path_told = belief.stamp
            self._write("/pilotage/path", belief.stamp, outgoing.path(belief.stamp, self._path))


@contextmanager
def recording(path: Path, frame: MapFrame, graph: CellGraph | None) -> Iterator[Recorder]:
    """Open an MCAP file; it is complete when the block ends, and absent if the block fails."""
    from rosbags.rosbag2 import StoragePlugin, Writer

    store = outgoing.typestore()
    with replacing(path) as beside, TemporaryDirectory(dir=beside.parent, prefix=f".{path.stem}.") as folder:
        bag = Path(folder) / "bag"
        with Writer(bag, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
            connections = {
                topic: writer.add_connection(topic, kind, typestore=store, offered_qos_profiles=qos(topic))
                for topic, kind in TYPES.items()
            }

            def write(topic: str, stamp: float, message: Any) -> None:  # noqa: ANN401  # of rosbags
                raw = store.serialize_cdr(message, TYPES[topic])
                writer.write(connections[topic], max(round(stamp * 1e9), 0), raw)

            yield Recorder(write, frame, graph)
        (file,) = bag.glob("*.mcap")
        file.replace(beside)


def qos(topic: str) -> Sequence[Any]:
    """Say how a topic was offered, so that a player of bags latches what must be latched."""
    from rosbags.interfaces import (
        Qos,
        QosDurability,
        QosHistory,
        QosLiveliness,
        QosReliability,
        QosTime,
    )

    if topic not in LATCHED:
        return ()
    never = QosTime(2147483647, 4294967295)
    return (
        Qos(
            QosHistory.KEEP_LAST,
            1,
            QosReliability.RELIABLE,
            QosDurability.TRANSIENT_LOCAL,
            never,
            never,
            QosLiveliness.AUTOMATIC,
            never,
            avoid_ros_namespace_conventions=False,
        ),
    )
