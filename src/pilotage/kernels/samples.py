"""What the kernels of registration take: points along shapes as plain arrays, and how to search."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Samples(NamedTuple):
    """Points along the shapes of a scan, in the frame of the robot [m]."""

    points: NDArray[np.float64]  # (n, 2)
    directions: NDArray[np.float64]  # (n, 2) unit vectors along the shapes there
    weights: NDArray[np.float64]  # (n,)


class Trials(NamedTuple):
    """Which poses a search tries, and what tells the best.

    A pose scores the share of points near their segments, less prior_weight * log(1 + m^2 / robust_scale)
    at m standard deviations from the prior.
    """

    turn_step: float  # [rad] between headings
    stride: int  # cells of the field between places
    scale: float  # [m] distance from its segment at which a point counts half
    min_cosine: float  # of the angle between the directions of a point and of its segment
    prior_weight: float
    robust_scale: float
    kept: int  # poses that are kept, the best
