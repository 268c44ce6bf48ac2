"""Logs to read: one run in every format, and a long one."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.lib.bag_making import KINDS, Maker, write_bag
from pilotage import open_log, worlds
from pilotage.geometry import Array


def four_formats(folder: Path, count: int = 30) -> list[Path]:
    """Write a stretch of the packed log as CARMEN and as bags of all kinds; return what is to be opened.

    Stamps, odometry and ranges have few decimals, as drivers write them.
    """
    source = open_log(worlds.LOG).readings[100 : 100 + count]
    first = source[0].odometry.odom_from_base
    rows = []
    for reading in source:
        pose = first.inverse() @ reading.odometry.odom_from_base
        ranges = np.where(np.isfinite(reading.scan.ranges), reading.scan.ranges, 30.0).round(3)
        numbers = [round(value, 6) for value in (pose.x, pose.y, pose.theta)]
        rows.append((round(reading.scan.stamp, 3), numbers, ranges))
    (folder / "run.log").write_text("".join(carmen_line(*row) for row in rows), encoding="ascii")
    paths = [folder / "run.log"]
    for kind in KINDS:
        maker, messages = Maker(kind), []
        for stamp, pose, ranges in rows:
            messages.append(("/odom", stamp, maker.odometry(stamp, pose, "laser")))
            scan = maker.scan(stamp, ranges, angle_min=-1.570796, increment=0.008727)
            messages.append(("/scan", stamp, scan))
        paths.append(write_bag(folder / (f"run{kind}" if kind == ".bag" else f"of{kind}"), messages, kind))
    return paths


def carmen_line(stamp: float, pose: list[float], ranges: Array) -> str:
    """Return a line of CARMEN's text."""
    numbers, where = " ".join(f"{r:.3f}" for r in ranges), " ".join(f"{v:.6f}" for v in pose)
    return (
        f"ROBOTLASER1 0 -1.570796 3.141593 0.008727 30.0 0.01 0 {len(ranges)} {numbers} 0 {where} {where} "
        f"0 0 0 0 0 {stamp} host {stamp}\n"
    )


def write_long_bag(path: Path, scans: int, beams: int) -> Path:
    """Write an MCAP bag of so many scans, forty a second, and as many readings of odometry."""
    maker, rng = Maker(".mcap"), np.random.default_rng(0)
    ranges = rng.uniform(1.0, 8.0, (50, beams)).round(3)

    def messages() -> Iterator[tuple[str, float, tuple[str, Any]]]:
        for k in range(scans):
            stamp = 1000.0 + 0.025 * k
            yield "/odom", stamp, maker.odometry(stamp, (0.01 * k, 0.0, 0.0), "laser")
            yield "/scan", stamp, maker.scan(stamp, ranges[k % len(ranges)])

    return write_bag(path, messages(), ".mcap")
