"""How often a reading shows the drawn wall, by how long the straight surface is on which it lies.

    python -m benchmarks surfaces [--hands A,B] [--buildings A,B] [--every N]

Scans of real logs are set against drawings from their true places, through the local affine map of control
points. A reading shows the drawn wall if it is within 35 % of the predicted range; else it is nearer than the
wall or beyond it. The sensor model weighs readings by these shares (decision 0032).
"""

import argparse
import math

import numpy as np

from benchmarks.lib.arguments import add_names, positive
from benchmarks.lib.data import BUILDINGS, LOGS, drawing_of
from benchmarks.lib.results import Figures
from benchmarks.lib.rungs import is_rung, rung_of
from pilotage.evaluation.deformation import Plan, read_plan
from pilotage.evaluation.trajectory import associate
from pilotage.geometry import Array, Pose2
from pilotage.io import open_log
from pilotage.io.tum import read_trajectory
from pilotage.kernels import visibility
from pilotage.localization import observe
from pilotage.localization.explanation import first_met, walls_of
from pilotage.localization.sensor_model import SURFACE_LENGTHS, SURFACES, SparseScan
from pilotage.perception import PerceptionSettings, perceive

HANDS = ("draftsman", "quick", "schematic", "ladder-0.5-0", "ladder-1-0")
EVERY = 20
SHOWN = 0.3
"""|log(predicted / measured)| within which a reading shows the drawn wall."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose drawings and scans."""
    parser.add_argument("--hands", type=lambda text: text.split(","), default=list(HANDS))
    add_names(parser, "--buildings", BUILDINGS)
    parser.add_argument("--every", type=positive, default=EVERY, help="scans (default: %(default)s)")


def measure(arguments: argparse.Namespace) -> Figures:
    """Print a line for each hand and length of surface, and return the figures."""
    print(f"{'drawings':14s}{'surface':>12s}{'readings':>10s}{'shown':>8s}{'nearer':>8s}{'beyond':>8s}")
    figures: Figures = {}
    for hand in arguments.hands:
        found = [errors_of(building, hand, arguments.every) for building in arguments.buildings]
        errors, surfaces = (np.concatenate(column) for column in zip(*found, strict=True))
        figures[hand] = {}
        for number in range(SURFACES):
            of_kind = errors[surfaces == number]
            row = {
                "readings": len(of_kind) / len(errors),
                "shown": float(np.mean(np.abs(of_kind) < SHOWN)),
                "nearer": float(np.mean(of_kind >= SHOWN)),
                "beyond": float(np.mean(of_kind <= -SHOWN)),
            }
            figures[hand][title_of(number)] = row
            print(
                f"{hand:14s}{title_of(number):>12s}"
                + "".join(f"{v:{w}.2f}" for v, w in zip(row.values(), (10, 8, 8, 8), strict=True)),
                flush=True,
            )
    return figures


def title_of(number: int) -> str:
    """Name a class of surfaces by its lengths."""
    low = 0.0 if number == 0 else SURFACE_LENGTHS[number - 1]
    return f"< {SURFACE_LENGTHS[number]:g} m" if number < SURFACES - 1 else f">= {low:g} m"


def errors_of(building: str, hand: str, every: int) -> tuple[Array, Array]:
    """Return log(predicted / measured) of all readings that face a wall, and the class of their surface."""
    plan = rung_of(building, hand) if is_rung(hand) else read_plan(drawing_of(building, hand))
    walls = walls_of(plan.sketch.strokes)
    readings = open_log(LOGS / f"{building}.log.gz").readings[::every]
    truth = read_trajectory(LOGS / f"{building}.truth.tum")
    poses = truth.poses[associate(np.array([reading.scan.stamp for reading in readings]), truth)]
    errors, surfaces = [], []
    for reading, pose in zip(readings, poses, strict=True):
        shapes = perceive(reading.scan, PerceptionSettings())
        scan = observe(reading.scan, shapes, Pose2.identity()).scan
        error, faces = errors_at(plan, Pose2(*pose), scan, walls)
        errors.append(error[faces])
        surfaces.append(scan.surfaces[faces])
    return np.concatenate(errors), np.concatenate(surfaces)


def errors_at(plan: Plan, world_from_base: Pose2, scan: SparseScan, walls: Array) -> tuple[Array, Array]:
    """Return log(predicted / measured) of each beam, and which of them returned and face a wall."""
    here = np.array([world_from_base.position])
    patches = plan.warp.there
    linear = patches.maps[patches.nearest(here)[0], :2]
    angles = scan.beams / visibility.HEADINGS * math.tau + world_from_base.theta
    rays = np.column_stack([np.cos(angles), np.sin(angles)]) @ linear
    ways, _ = first_met(plan.warp.sketch_from_world(here)[0], rays, walls)
    with np.errstate(divide="ignore"):
        errors = np.log(ways) - scan.levels * visibility.LOG_STEP
    return errors, np.isfinite(errors) & (scan.levels != visibility.NO_RETURN)
