"""Make a true world of each real building from its log: all scans laid at the true poses, then cleaned.

    python benchmarks/worlds_from_logs.py [--output DIR] [--buildings A,B]

A world is a map_server map in the frame of the true trajectory: `<building>.yaml` and `<building>.png`, free
254, occupied 0, unknown 205 (solid for a simulator), 0.05 m a pixel. The scans are others' data, so worlds go
into a cache folder and never into the repository. The robot's own path is free, 0.3 m to each side.

As a check the scans are taken again in the world from the same poses. Printed is the share of beams that come
out within 0.2 m of the log, among those that returned within 25 m.
"""

import argparse
import os
import time
from pathlib import Path

import numpy as np
import platformdirs
from PIL import Image

from occupancy import PIXEL, REACH, Plan, path_pixels, plan_of
from pilotage.evaluation.trajectory import associate, thin
from pilotage.geometry import Pose2
from pilotage.io import open_log
from pilotage.io.files import replacing, write_text
from pilotage.io.tum import read_trajectory
from pilotage.perception import LaserScan

LOGS = Path(__file__).resolve().parents[1] / ".." / "shared" / "data" / "logs"
BUILDINGS = ("aces", "belgioioso", "csail", "fhw", "freiburg-079", "freiburg-101")
CACHE = platformdirs.user_cache_path("pilotage") / "worlds"
FREE, UNKNOWN, OCCUPIED = 254, 205, 0
MIN_DISTANCE, MIN_TURN = 0.1, np.radians(5.0)  # [m, rad] between scans, so that standing still counts once
NEAR = 0.2  # [m] a beam that errs by no more is reproduced
CHECKED = 200  # scans of a log at most are taken again

Scans = tuple[list[LaserScan], list[Pose2]]


def main() -> None:
    """Make the worlds and print a line for each."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "--output", type=Path, default=CACHE, help="folder of the worlds (default: %(default)s)"
    )
    parser.add_argument("--buildings", default=",".join(BUILDINGS), help="(default: %(default)s)")
    arguments = parser.parse_args()
    if not LOGS.is_dir():
        parser.error("the logs are not there: ../shared/data/logs beside the repository")
    print(
        f"{'building':13s}{'scans':>6s}{'pixels':>12s}{'free m2':>9s}{'path free':>10s}{'beams':>7s}{'s':>6s}"
    )
    for building in arguments.buildings.split(","):
        began = time.perf_counter()
        scans, poses = read_scans(building)
        plan = plan_of(scans, poses)
        write_world(plan, arguments.output / f"{building}.yaml")
        elapsed = time.perf_counter() - began
        size = "{1} x {0}".format(*plan.free.shape)
        free = plan.free.sum() * PIXEL**2
        path, beams = share_of_path_free(plan, poses), share_reproduced(plan, scans, poses)
        print(
            f"{building:13s}{len(scans):6d}{size:>12s}{free:9.0f}{path:10.3f}{beams:7.2f}{elapsed:6.1f}",
            flush=True,
        )


def world_of(building: str, folder: Path = CACHE) -> Path:
    """Return the YAML file of a building's world; make it if it is not there yet."""
    path = folder / f"{building}.yaml"
    if not path.exists():
        write_world(plan_of(*read_scans(building)), path)
    return path


def read_scans(building: str) -> Scans:
    """Read the scans of a building and their true poses, thinned to those that tell something new."""
    log = open_log(LOGS / f"{building}.log.gz")
    truth = read_trajectory(LOGS / f"{building}.truth.tum")
    indices = associate(np.array([reading.scan.stamp for reading in log]), truth)
    poses = [truth.pose(index) for index in indices]
    kept = thin(poses, MIN_DISTANCE, MIN_TURN)
    return [log.readings[index].scan for index in kept], [poses[index] for index in kept]


def write_world(plan: Plan, path: Path) -> None:
    """Write the picture and, last, the YAML file that names it."""
    shades = np.full(plan.free.shape, UNKNOWN, dtype=np.uint8)
    shades[plan.free] = FREE
    shades[plan.occupied] = OCCUPIED
    picture = path.with_suffix(".png")
    with replacing(picture) as beside:
        Image.fromarray(shades[::-1]).save(beside)
    write_text(
        path,
        f"image: {picture.name}\nmode: trinary\nresolution: {PIXEL}\n"
        f"origin: [{plan.left}, {plan.bottom}, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
    )


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


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    main()
