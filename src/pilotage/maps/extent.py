"""How large a drawing is, however it is turned."""

import numpy as np
import shapely

from pilotage.geometry import Array


def diameter_of(points: Array) -> float:
    """Measure between the two points (n, 2) that are farthest apart.

    That of a rectangle is its diagonal; unlike the bounds' it does not change when the drawing is turned.

    >>> diameter_of(np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 4.0], [0.0, 4.0]]))
    5.0
    """
    corners = shapely.get_coordinates(shapely.convex_hull(shapely.multipoints(points)))
    gaps = corners[:, None] - corners[None]
    return float(np.hypot(gaps[..., 0], gaps[..., 1]).max())
