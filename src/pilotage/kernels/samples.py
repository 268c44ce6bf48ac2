"""What the kernels of registration take: points along shapes as plain arrays."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Samples(NamedTuple):
    """Points along the shapes of a scan, in the frame of the robot [m]."""

    points: NDArray[np.float64]  # (n, 2)
    directions: NDArray[np.float64]  # (n, 2) unit vectors along the shapes there
    weights: NDArray[np.float64]  # (n,)
