"""Standard messages of ROS 2 that say what is believed; see docs/reference/ros.md for topics and frames."""

import math
from collections.abc import Iterable, Sequence
from functools import cache
from typing import Any

import numpy as np

from pilotage.geometry import Array, Pose2, Twist
from pilotage.io.bags.belief import Belief, MapFrame
from pilotage.io.bags.ground import Ground
from pilotage.maps import CellGraph
from pilotage.perception import LaserScan
from pilotage.perception.scan import MAX_TRUSTED_RANGE

MAP, ODOM, BASE, LASER = "map", "odom", "base_link", "laser"
"""Frames (REP-105)."""

HEADING_STD = math.radians(5.0)
"""[rad] Told with every pose: the filter does not tell the spread of headings by itself."""

RESOLUTION = 0.05
"""[m] Size of a cell of the occupancy grid, unless it would have more than `MOST_CELLS` on a side."""
MOST_CELLS = 2000
MARGIN = 0.5
"""[m] of unknown space around the drawing in the occupancy grid."""
FREE, OCCUPIED, UNKNOWN = 0, 100, -1

LINE_WIDTH = 0.05  # [m]
INK, CELL, GUESS, WAY = (0.1, 0.1, 0.1, 1.0), (0.2, 0.4, 0.9, 0.8), (0.9, 0.4, 0.1, 1.0), (0.1, 0.7, 0.2, 1.0)
"""Colors of strokes, cells, hypotheses and the route: red, green, blue, opacity."""

ARROW, LINE_STRIP, LINE_LIST, TEXT = 0, 4, 5, 9
DELETE_ALL = 3
"""Constants of visualization_msgs/Marker."""
LEVELS = {"located": 0, "lost": 1, "mismatch": 2}
"""Levels of diagnostic_msgs/DiagnosticStatus."""


@cache
def typestore() -> Any:  # noqa: ANN401  # rosbags is imported late
    """Return the definitions of messages of ROS 2 (Jazzy)."""
    from rosbags.typesys import Stores, get_typestore

    return get_typestore(Stores.ROS2_JAZZY)


def make(name: str, *values: object) -> Any:  # noqa: ANN401  # types of ROS are made at run time
    """Make a message of `package/Name` from the values of its fields in order."""
    package, _, kind = name.partition("/")
    return typestore().types[f"{package}/msg/{kind}"](*values)


def header(stamp: float, frame: str) -> Any:  # noqa: ANN401  # as above
    """Make a header."""
    return make("std_msgs/Header", time(stamp), frame)


def time(stamp: float) -> Any:  # noqa: ANN401  # as above
    """Make a time of seconds [s]; times before 1970 cannot be told."""
    nanoseconds = max(round(stamp * 1e9), 0)
    return make("builtin_interfaces/Time", nanoseconds // 10**9, nanoseconds % 10**9)


def pose_message(pose: Pose2) -> Any:  # noqa: ANN401  # as above
    """Make a pose."""
    return make("geometry_msgs/Pose", point(pose.x, pose.y), quaternion(pose.theta))


def point(x: float, y: float) -> Any:  # noqa: ANN401  # as above
    """Make a point of the plane."""
    return make("geometry_msgs/Point", float(x), float(y), 0.0)


def vector(x: float, y: float, z: float) -> Any:  # noqa: ANN401  # as above
    """Make a vector."""
    return make("geometry_msgs/Vector3", float(x), float(y), float(z))


def quaternion(theta: float) -> Any:  # noqa: ANN401  # as above
    """Make a turn about the vertical."""
    return make("geometry_msgs/Quaternion", 0.0, 0.0, math.sin(theta / 2.0), math.cos(theta / 2.0))


def transform(stamp: float, parent: str, child: str, pose: Pose2) -> Any:  # noqa: ANN401  # as above
    """Make a TFMessage of one transform, `parent_from_child`."""
    body = make("geometry_msgs/Transform", vector(pose.x, pose.y, 0.0), quaternion(pose.theta))
    return make(
        "tf2_msgs/TFMessage", [make("geometry_msgs/TransformStamped", header(stamp, parent), child, body)]
    )


def pose_estimate(belief: Belief) -> Any:  # noqa: ANN401  # as above
    """Make a PoseWithCovarianceStamped in the frame `map`."""
    covariance = np.zeros((6, 6))
    covariance[:2, :2], covariance[5, 5] = belief.covariance, HEADING_STD**2
    pose = make("geometry_msgs/PoseWithCovariance", pose_message(belief.pose), covariance.ravel())
    return make("geometry_msgs/PoseWithCovarianceStamped", header(belief.stamp, MAP), pose)


def path(stamp: float, poses: Iterable[Pose2]) -> Any:  # noqa: ANN401  # as above
    """Make a Path in the frame `map`."""
    above = header(stamp, MAP)
    return make(
        "nav_msgs/Path", above, [make("geometry_msgs/PoseStamped", above, pose_message(one)) for one in poses]
    )


def diagnostics(belief: Belief) -> Any:  # noqa: ANN401  # as above
    """Make a DiagnosticArray: how well the robot knows its place, and by which scale."""
    status = belief.values.get("status", "lost")
    values = [make("diagnostic_msgs/KeyValue", name, value) for name, value in belief.values.items()]
    message = f"{status}, {belief.values.get('place') or 'no place'}, p = {belief.places[0].probability:.2f}"
    one = make(
        "diagnostic_msgs/DiagnosticStatus",
        LEVELS.get(status, 1),
        "pilotage: localization",
        message,
        "",
        values,
    )
    return make("diagnostic_msgs/DiagnosticArray", header(belief.stamp, ""), [one])


def hypotheses(belief: Belief) -> Any:  # noqa: ANN401  # as above
    """Make a MarkerArray of one arrow a hypothesis, as opaque as it is probable."""
    arrows = [marker(belief.stamp, "hypotheses", 0, ARROW, GUESS, action=DELETE_ALL)]
    for number, place in enumerate(belief.places):
        color = (*GUESS[:3], max(place.probability, 0.1))
        arrows.append(
            marker(belief.stamp, "hypotheses", number, ARROW, color, pose=place.pose, scale=(1.0, 0.15, 0.15))
        )
    return make("visualization_msgs/MarkerArray", arrows)


def drawing(stamp: float, frame: MapFrame) -> Any:  # noqa: ANN401  # as above
    """Make a MarkerArray of the strokes."""
    ends = frame.from_sketch(frame.sketch.segments.reshape(-1, 2))
    return make("visualization_msgs/MarkerArray", [marker(stamp, "strokes", 0, LINE_LIST, INK, points=ends)])


def cells(stamp: float, frame: MapFrame, graph: CellGraph | None) -> Any:  # noqa: ANN401  # as above
    """Make a MarkerArray of the outline and the name of each cell."""
    markers = []
    for number, cell in enumerate(graph.cells if graph else ()):
        outline = frame.from_sketch(np.vstack([cell.outline, cell.outline[:1]]))
        markers.append(marker(stamp, "cells", number, LINE_STRIP, CELL, points=outline))
        x, y = frame.from_sketch(np.array([cell.center]))[0].tolist()
        markers.append(
            marker(stamp, "names", number, TEXT, CELL, pose=Pose2(x, y, 0.0), text=cell.label or cell.cell_id)
        )
    return make("visualization_msgs/MarkerArray", markers)


def marker(
    stamp: float,
    namespace: str,
    number: int,
    kind: int,
    color: Sequence[float],
    *,
    action: int = 0,
    pose: Pose2 | None = None,
    scale: tuple[float, float, float] | None = None,
    points: Array | None = None,
    text: str = "",
) -> Any:  # noqa: ANN401  # as above
    """Make one Marker in the frame `map`; lines and letters have a size that can be read."""
    size = scale if scale is not None else (LINE_WIDTH, 0.0, 0.5 if kind == TEXT else 0.0)
    nothing = np.zeros(0, np.uint8)
    return make(
        "visualization_msgs/Marker",
        header(stamp, MAP),
        namespace,
        number,
        kind,
        action,
        pose_message(pose if pose is not None else Pose2.identity()),
        vector(*size),
        make("std_msgs/ColorRGBA", *map(float, color)),
        make("builtin_interfaces/Duration", 0, 0),
        False,  # moves with no frame
        [] if points is None else [point(x, y) for x, y in points.tolist()],
        [],
        "",
        make("sensor_msgs/CompressedImage", make("std_msgs/Header", time(0.0), ""), "", nothing),
        [],
        text,
        "",
        make("visualization_msgs/MeshFile", "", nothing),
        False,
    )


def occupancy_grid(stamp: float, ground: Ground) -> Any:  # noqa: ANN401  # as above
    """Make an OccupancyGrid: the floor is free, walls are occupied, and all else is unknown."""
    left, bottom, right, top = ground.bounds
    left, bottom, right, top = left - MARGIN, bottom - MARGIN, right + MARGIN, top + MARGIN
    resolution = max(RESOLUTION, max(right - left, top - bottom) / MOST_CELLS)
    grid = rasterized(ground, (left, bottom, right, top), resolution)
    origin = pose_message(Pose2(left, bottom, 0.0))
    height, width = grid.shape
    about = make("nav_msgs/MapMetaData", time(stamp), resolution, width, height, origin)
    return make("nav_msgs/OccupancyGrid", header(stamp, MAP), about, grid.ravel())


def rasterized(ground: Ground, bounds: tuple[float, float, float, float], resolution: float) -> Any:  # noqa: ANN401  # an array of int8
    """Draw floor and walls into a grid, (height, width), the lowest row first."""
    from PIL import Image, ImageDraw

    left, bottom, right, top = bounds
    size = math.ceil((right - left) / resolution), math.ceil((top - bottom) / resolution)
    picture = Image.new("L", size, 2)
    pen = ImageDraw.Draw(picture)
    width = max(1, round(ground.thickness / resolution))

    def pixels(points: Array) -> list[tuple[float, float]]:
        return [(x, y) for x, y in ((points - [left, bottom]) / resolution).tolist()]

    for outline, holes in ground.floor:
        pen.polygon(pixels(outline), fill=0)
        for hole in holes:
            pen.polygon(pixels(hole), fill=2)
    for first, second in zip(*[iter(pixels(ground.walls.reshape(-1, 2)))] * 2, strict=True):
        pen.line([first, second], fill=1, width=width)
    return np.array([FREE, OCCUPIED, UNKNOWN], np.int8)[np.asarray(picture)]


def scan_message(scan: LaserScan) -> Any:  # noqa: ANN401  # as above
    """Make a LaserScan in the frame `laser`."""
    count = len(scan)
    limit = scan.range_max if math.isfinite(scan.range_max) else MAX_TRUSTED_RANGE
    values = (scan.angle_min, scan.angle_min + (count - 1) * scan.angle_increment, scan.angle_increment)
    return make(
        "sensor_msgs/LaserScan",
        header(scan.stamp, LASER),
        *values,
        0.0,
        0.0,
        scan.range_min,
        limit,
        scan.ranges.astype(np.float32),
        np.zeros(0, np.float32),
    )


def twist_message(command: Twist) -> Any:  # noqa: ANN401  # as above
    """Make a Twist."""
    return make("geometry_msgs/Twist", vector(command.linear, 0.0, 0.0), vector(0.0, 0.0, command.angular))
