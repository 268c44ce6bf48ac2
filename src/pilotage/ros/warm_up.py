"""Compile what a step needs before a robot waits for it: the first call of a kernel takes seconds."""

import gc
import math
from dataclasses import replace

import numpy as np

from pilotage.config import Settings
from pilotage.geometry import Pose2
from pilotage.maps import Atlas
from pilotage.perception import LaserScan, Odometry, Reading
from pilotage.ros.session import Session

BEAMS = 360


def warm_up(atlas: Atlas, settings: Settings) -> None:
    """Let a robot that does not exist stand in a box and move a little, with a goal if there can be one.

    What exists then stays, and the garbage collector passes over it from then on: a full collection of a
    loaded compiler and a drawing stops everything for a tenth of a second.
    """
    session = Session(atlas, (settings.localizer, settings.navigator), seed=0)
    if atlas.cell_graph is not None:
        x, y = atlas.sketch.file_from_sketch(np.array([atlas.cell_graph.cells[0].center]))[0].tolist()
        session.set_goal((x, y))
    angles = np.linspace(-math.pi, math.pi, BEAMS, endpoint=False)
    ranges = 2.0 / np.maximum(np.abs(np.cos(angles)), np.abs(np.sin(angles)))
    for k in range(4):
        stamp = 0.4 * k
        scan = LaserScan(stamp, -math.pi, 2.0 * math.pi / BEAMS, ranges, range_max=30.0)
        session.update(Reading(replace(scan, stamp=stamp), Odometry(stamp, Pose2(0.55 * k, 0.0, 0.0))))
    gc.collect()
    gc.freeze()
