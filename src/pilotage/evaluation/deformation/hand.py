"""The hand: tremor, ends that run over or fall short, angles that are off."""

import math

import numpy as np
import shapely
from scipy.ndimage import gaussian_filter1d

from pilotage.geometry import Array

STEP = 0.5
"""Distance [m] between the points of a stroke that trembles."""
TREMOR = 0.08
"""Standard deviation [m] of a stroke's points at severity 1."""
TREMOR_LENGTH = 1.5
"""Length [m] of a stroke over which that deviation is alike."""
END = 0.2
"""Standard deviation [m] of the ends along the stroke at severity 1: overshoot or gap."""
TURN, MOST_SHIFT = math.radians(4.0), 0.35
"""Standard deviation [rad] of a stroke's angle at severity 1, and how far [m] it may shift the ends."""
FLAT = 0.02
"""Distance [m] from the line between others below which points are dropped."""


def shaky(line: shapely.LineString, severity: float, rng: np.random.Generator) -> shapely.LineString:
    """Draw a stroke [m] by hand."""
    points = shapely.get_coordinates(shapely.segmentize(line, STEP))
    noise = rng.standard_normal((len(points), 2))
    start, end, turn = rng.standard_normal(3).tolist()
    width = TREMOR_LENGTH / STEP
    tremor = gaussian_filter1d(noise, width, axis=0, mode="nearest") * math.sqrt(
        2.0 * width * math.sqrt(math.pi)
    )
    points = points + severity * TREMOR * tremor
    points[0] += severity * END * start * unit(points[0] - points[1])
    points[-1] += severity * END * end * unit(points[-1] - points[-2])
    angle = severity * turn * min(TURN, MOST_SHIFT / max(line.length / 2.0, 1e-6))
    middle = points.mean(axis=0)
    rotation = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    return shapely.simplify(shapely.LineString((points - middle) @ rotation.T + middle), FLAT)


def unit(vector: Array) -> Array:
    """Return a direction; of nothing, nothing."""
    return np.asarray(vector / max(float(np.hypot(*vector)), 1e-9))
