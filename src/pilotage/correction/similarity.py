"""A similarity that most of many pairs of points agree on: the first guess of where the drawing lies."""

import contextlib
from itertools import combinations

import numpy as np

from pilotage.geometry import Array, Similarity2, fit_similarity

TRIED = 40
"""Number of pairs of points that are tried; any two of them make a first guess of the similarity."""
GATES = (10.0, 10.0, 6.0, 4.0, 4.0, 4.0)
"""[m] of the robust kernel while the similarity is found."""


class CoincidingError(ValueError):
    """All points or all images of a similarity that is sought are one and the same."""


def robust(off: Array, gate: float) -> Array:
    """Weigh residuals (n,) as the kernel of Geman and McClure does: those beyond the gate hardly count."""
    return np.asarray((gate**2 / (gate**2 + off**2)) ** 2)


def robust_similarity(points: Array, images: Array, weights: Array) -> Similarity2:
    """Fit a similarity to pairs (n, 2), most of which agree; `weights` (n,) are reciprocal deviations.

    It begins with the best of those through two of the pairs, evenly spaced: a localizer that was wrong for a
    while is outvoted. Raises CoincidingError if no two pairs differ.
    """
    tried = np.unique(np.linspace(0, len(points) - 1, TRIED).astype(np.intp))
    best, most = None, -1.0
    for pair in combinations(tried.tolist(), 2):
        with contextlib.suppress(ValueError):  # they coincide
            guess = fit_similarity(points[list(pair)], images[list(pair)])
            agreeing = float(weights**2 @ agreement(guess, points, images, GATES[0]))
            if agreeing > most:
                best, most = guess, agreeing
    if best is None:
        raise CoincidingError("a similarity needs two pairs of points that differ")
    for gate in GATES:
        best = fit_similarity(points, images, agreement(best, points, images, gate) * weights**2)
    return best


def agreement(similarity: Similarity2, points: Array, images: Array, gate: float) -> Array:
    """Weigh pairs (n, 2) by how well a similarity carries one to the other, (n,)."""
    return robust(np.hypot(*(similarity @ points - images).T), gate)
