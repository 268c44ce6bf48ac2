"""Which neighboring returns of a scan belong to one contour (Wolter 2001, section 2.1; decision 0005)."""

import math

import numpy as np
from numpy.typing import NDArray

from pilotage.kernels.compiling import njit

BASE_STEPS = 3  # lines joining this many steps of returns, at most, are prolonged


@njit(cache=True)
def is_prolonged(
    xy: NDArray[np.float64],
    hit: NDArray[np.bool_],
    last: int,
    step: int,
    target: int,
    max_gap: float,
    tolerance: float,
    max_stretch: float,
) -> bool:
    """Tell whether the line through the returns up to `last`, in beam steps of -1 or 1, meets the `target`.

    The line joins `last` with the return up to three steps behind it, as long as no step is longer than
    `max_gap`. What it may miss grows with how far it is prolonged in proportion to its own length, and it may
    be prolonged `max_stretch` of that length.
    """
    n = len(xy)
    base = last
    for _ in range(BASE_STEPS):
        before = base - step
        if before < 0 or before >= n or not hit[before]:
            break
        if math.hypot(xy[base, 0] - xy[before, 0], xy[base, 1] - xy[before, 1]) > max_gap:
            break
        base = before
    length = math.hypot(xy[last, 0] - xy[base, 0], xy[last, 1] - xy[base, 1])
    if length == 0.0:
        return False
    ux, uy = (xy[last, 0] - xy[base, 0]) / length, (xy[last, 1] - xy[base, 1]) / length
    dx, dy = xy[target, 0] - xy[last, 0], xy[target, 1] - xy[last, 1]
    along, across = ux * dx + uy * dy, abs(ux * dy - uy * dx)
    return bool(0.0 < along <= max_stretch * length and across <= tolerance * (1.0 + along / length))


@njit(cache=True)
def link_returns(
    xy: NDArray[np.float64],
    hit: NDArray[np.bool_],
    wraps: bool,  # noqa: FBT001  # a kernel takes plain values
    max_shadow: float,
    max_grazing: float,
    tolerance: float,
    max_stretch: float,
) -> NDArray[np.bool_]:
    """Tell for each beam whether its return and that of the next beam belong to one contour.

    Parameters
    ----------
    xy
        The returns in the laser's frame in order of beams, (n, 2) [m]; anything where there is none.
    hit
        Which beams returned, (n,).
    wraps
        Whether the first beam follows the last.
    max_shadow
        Lines along the line of sight may be this long [m].
    max_grazing
        Lines at a smaller angle than this to the line of sight count as along it [rad].
    tolerance, max_stretch
        How exactly [m], and how far in its own length, a line prolongs its neighbors and is kept.

    Returns
    -------
    linked
        (n,); the last one is about beams n - 1 and 0.
    """
    n = len(xy)
    linked = np.zeros(n, dtype=np.bool_)
    for i in range(n if wraps else n - 1):
        j = (i + 1) % n
        if not (hit[i] and hit[j]):
            continue
        dx, dy = xy[j, 0] - xy[i, 0], xy[j, 1] - xy[i, 1]
        length = math.hypot(dx, dy)
        mx, my = xy[i, 0] + xy[j, 0], xy[i, 1] + xy[j, 1]  # the line of sight between both
        across = abs(mx * dy - my * dx)
        linked[i] = (
            length <= max_shadow
            or across >= math.sin(max_grazing) * length * math.hypot(mx, my)
            or is_prolonged(xy, hit, i, 1, j, length, tolerance, max_stretch)
            or is_prolonged(xy, hit, j, -1, i, math.inf, tolerance, max_stretch)
        )
    return linked
