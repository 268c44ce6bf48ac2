"""Make a true world of each real building from its log, and keep it in a cache folder.

The scans are others' data, so their worlds never go into the repository.
"""

from pathlib import Path

import numpy as np
import platformdirs
from PIL import Image

from benchmarks.lib.data import LOGS
from benchmarks.lib.occupancy import PIXEL, Plan, plan_of
from pilotage.evaluation.trajectory import associate, thin
from pilotage.geometry import Pose2
from pilotage.io import open_log
from pilotage.io.files import replacing, write_text
from pilotage.io.tum import read_trajectory
from pilotage.perception import LaserScan

CACHE = platformdirs.user_cache_path("pilotage") / "worlds"
FREE, UNKNOWN, OCCUPIED = 254, 205, 0
MIN_DISTANCE, MIN_TURN = 0.1, np.radians(5.0)  # [m, rad] between scans, so that standing still counts once

Scans = tuple[list[LaserScan], list[Pose2]]


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
