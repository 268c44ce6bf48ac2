"""Score motion: associate by stamp, thin, spoil, and compare with the truth."""

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array, Trajectory


def associate(stamps: Array, truth: Trajectory, tolerance: float = 1e-3) -> NDArray[np.intp]:
    """Find for each stamp the index of the true pose taken then.

    Stamps that occur several times are taken in turn. Trajectories of equal length whose stamps do not agree
    are taken index by index; a stamp without a true pose is an error.
    """
    order = np.argsort(truth.stamps, kind="stable")
    found = np.searchsorted(truth.stamps[order], stamps - tolerance)
    _, first, repeat = np.unique(stamps, return_index=True, return_inverse=True)
    del first
    turn = np.zeros(len(stamps), dtype=np.intp)
    seen: dict[int, int] = {}
    for index, key in enumerate(repeat.tolist()):
        turn[index] = seen.get(key, 0)
        seen[key] = turn[index] + 1
    found = found + turn
    ok = (found < len(truth)) & (
        np.abs(truth.stamps[order][np.minimum(found, len(truth) - 1)] - stamps) <= tolerance
    )
    if ok.all():
        return order[found]
    if len(stamps) == len(truth):
        return np.arange(len(stamps))
    raise ValueError(f"{np.count_nonzero(~ok)} of {len(stamps)} stamps have no true pose")
