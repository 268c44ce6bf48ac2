"""What the kernels that compare shapes take: tangent functions as plain arrays."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Steps(NamedTuple):
    """A piecewise constant tangent function: piece p runs from stops[p] to stops[p + 1] along the contour."""

    stops: NDArray[np.float64]  # (n + 1,) [unit of length], increasing
    directions: NDArray[np.float64]  # (n,) [rad], unwrapped


class ArcSteps(NamedTuple):
    """A tangent function and where its k arcs start; a closed contour is laid out twice around."""

    steps: Steps
    arc_starts: NDArray[np.int64]  # first piece of each arc, and the end: (k + 1,), or (2 k + 1,) if closed
    bends: NDArray[np.int64]  # (k,) +1 convex, -1 concave, 0 straight
