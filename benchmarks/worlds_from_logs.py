"""Make a true world of each real building from its log: all scans laid at the true poses, then cleaned.

    python -m benchmarks worlds_from_logs

A world is a map_server map in the frame of the true trajectory: `<building>.yaml` and `<building>.png`, free
254, occupied 0, unknown 205 (solid for a simulator), 0.05 m a pixel. The scans are others' data, so worlds go
into a cache folder and never into the repository. The robot's own path is free, 0.3 m to each side.

As a check the scans are taken again in the world from the same poses. Printed is the share of beams that come
out within 0.2 m of the log, among those that returned within 25 m.
"""

import argparse
import time
from pathlib import Path

import numpy as np

from benchmarks.lib.arguments import add_names
from benchmarks.lib.data import BUILDINGS
from benchmarks.lib.occupancy import PIXEL, REACH, Plan, path_pixels, plan_of
from benchmarks.lib.results import Figures
from benchmarks.lib.worlds import CACHE, read_scans, write_world
from pilotage.geometry import Pose2
from pilotage.perception import LaserScan

NEAR = 0.2  # [m] a beam that errs by no more is reproduced
CHECKED = 200  # scans of a log at most are taken again


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose buildings, and where the worlds go."""
    add_names(parser, "--buildings", BUILDINGS)
    parser.add_argument(
        "--output", type=Path, default=CACHE, help="folder of the worlds (default: %(default)s)"
    )


def measure(arguments: argparse.Namespace) -> Figures:
    """Make the worlds, print a line for each, and return the figures."""
    figures: Figures = {}
    print(
        f"{'building':13s}{'scans':>6s}{'pixels':>12s}{'free m2':>9s}{'path free':>10s}{'beams':>7s}{'s':>6s}"
    )
    for building in arguments.buildings:
        began = time.perf_counter()
        scans, poses = read_scans(building)
        plan = plan_of(scans, poses)
        write_world(plan, arguments.output / f"{building}.yaml")
        elapsed = time.perf_counter() - began
        size = "{1} x {0}".format(*plan.free.shape)
        free = plan.free.sum() * PIXEL**2
        path, beams = share_of_path_free(plan, poses), share_reproduced(plan, scans, poses)
        figures[building] = {"path_free": path, "beams_reproduced": beams}
        print(
            f"{building:13s}{len(scans):6d}{size:>12s}{free:9.0f}{path:10.3f}{beams:7.2f}{elapsed:6.1f}",
            flush=True,
        )
    return figures


def share_of_path_free(plan: Plan, poses: list[Pose2]) -> float:
    """Return the share of the path's pixels that are free."""
    path = path_pixels(plan, np.array([pose.position for pose in poses]))
    return float(plan.free[path].mean())


def share_reproduced(plan: Plan, scans: list[LaserScan], poses: list[Pose2]) -> float:
    """Take scans of the log again in the world; return the share of returned beams that come out the same."""
    near = []
    for index in np.unique(np.linspace(0, len(scans) - 1, CHECKED).astype(int)):
        scan = scans[index]
        returned = scan.returned & (scan.ranges < REACH)
        measured = plan.ranges(poses[index] @ scan.base_from_laser, scan.directions[returned])
        near.append(np.abs(measured - scan.ranges[returned]) <= NEAR)
    return float(np.concatenate(near).mean())
