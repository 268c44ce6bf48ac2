"""The motion model: how particles move, and how the errors of a drawing change along the way."""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage import kernels
from pilotage.geometry import Array, Pose2
from pilotage.localization.particles import (
    HEADING,
    LOG_SCALE,
    STRETCH_P,
    STRETCH_Q,
    Particles,
    X,
    Y,
    displacements,
)
from pilotage.localization.prior import Prior
from pilotage.maps import Atlas

# Drift of a drawing's errors, as standard deviations per sqrt(m): decision 0018 tells how they were chosen.
# Proportions change by 25 % over 10 m; corridors are drawn too short or too long; angles are off.
SCALE_DRIFT = 0.08
STRETCH_DRIFT = 0.12
LENGTH_DRIFT = 0.08
POSITION_DRIFT = 0.1  # [m/sqrt(m)]
HEADING_DRIFT = 0.04  # [rad/sqrt(m)]

# Errors of registered motion, far smaller than those of odometry (3.3).
MOTION_NOISE = 0.05  # [m/m]
MOTION_NOISE_STILL = 0.01  # [m]
TURN_NOISE = 0.02  # [rad/rad]
TURN_NOISE_STILL = 0.005  # [rad]

WALL_PENALTY = 3.0
"""Log-odds against a step through a drawn wall: a door may be forgotten, or a wall drawn elsewhere."""
WALL_TOLERANCE = 0.2
"""A step is through a wall if it is longer than the distance to the wall by this factor (logarithm)."""


def propagate(
    particles: Particles, motion: Pose2, atlas: Atlas, prior: Prior, rng: np.random.Generator
) -> Particles:
    """Move all particles by a motion in the robot's frame, with noise; let scale and stretch drift."""
    count = len(particles)
    distance = math.hypot(motion.x, motion.y)
    root = math.sqrt(distance)
    noise = rng.standard_normal((9, count), dtype=np.float32).astype(np.float64)
    factor = np.exp(LENGTH_DRIFT * root * noise[0])
    motion_std = MOTION_NOISE_STILL + MOTION_NOISE * distance
    steps = displacements(
        particles.states,
        factor * (motion.x + motion_std * noise[1]),
        factor * (motion.y + motion_std * noise[2]),
    )
    crossing = cross_walls(particles.states, steps, atlas)
    states = particles.states.copy()
    position_std = POSITION_DRIFT * root * np.exp(states[LOG_SCALE])
    states[X] += steps[0] + position_std * noise[3]
    states[Y] += steps[1] + position_std * noise[4]
    turn_std = HEADING_DRIFT * root + TURN_NOISE * abs(motion.theta) + TURN_NOISE_STILL
    states[HEADING] += motion.theta + turn_std * noise[5]
    for row, mean, drift, std, normal in (
        (LOG_SCALE, atlas.log_scale, SCALE_DRIFT * root, prior.log_scale, noise[6]),
        (STRETCH_P, 0.0, STRETCH_DRIFT * root, prior.stretch, noise[7]),
        (STRETCH_Q, 0.0, STRETCH_DRIFT * root, prior.stretch, noise[8]),
    ):  # an Ornstein-Uhlenbeck process whose stationary distribution is the prior
        states[row] += drift * normal - (states[row] - mean) * min(drift**2 / (2.0 * std**2), 1.0)
    return Particles(states, particles.log_weights - WALL_PENALTY * crossing)


def cross_walls(states: Array, steps: Array, atlas: Atlas) -> NDArray[np.bool_]:
    """Tell which steps (2, n) [drawing units] run through a drawn wall, (n,)."""
    table = atlas.range_table
    tolerance = round(WALL_TOLERANCE / kernels.visibility.LOG_STEP)
    starts = np.ascontiguousarray(states[:2])
    crossing: NDArray[np.bool_] = kernels.visibility.cross_walls(
        starts, steps, table.log_ranges, table.grid, tolerance
    )
    return crossing
