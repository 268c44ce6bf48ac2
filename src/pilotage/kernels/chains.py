"""What the kernels that match parts of polylines take."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Chain(NamedTuple):
    """An open polyline; an end that goes on lies somewhere inside a longer segment."""

    vertices: NDArray[np.float64]  # (n + 1, 2)
    lengths: NDArray[np.float64]  # (n,) positive
    directions: NDArray[np.float64]  # (n,) [rad]
    first_goes_on: bool
    last_goes_on: bool


class Prices(NamedTuple):
    """What a match costs and earns, beside eq. (2)."""

    displacement: float  # alpha [rad²/m²] a metre of match and squared metre of displacement
    reward: float  # lambda [rad²] a metre of match
    largest_run: int  # segments that may answer to a single one
