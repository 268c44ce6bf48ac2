"""Confidence intervals of means, medians and other statistics."""

from collections.abc import Callable
from typing import SupportsFloat

import numpy as np
from numpy.typing import ArrayLike

RESAMPLES = 2000
CONFIDENCE = 0.95


def bootstrap_interval(
    values: ArrayLike, rng: np.random.Generator, statistic: Callable[..., SupportsFloat] = np.mean
) -> tuple[float, float]:
    """Return the 95 % interval of the mean, or another statistic, by the percentile bootstrap (Efron 1979).

    >>> low, high = bootstrap_interval([0.0, 1.0] * 50, np.random.default_rng(0))
    >>> 0.38 < low < 0.42 and 0.58 < high < 0.62
    True
    """
    sample = np.asarray(values, dtype=np.float64)
    if sample.ndim != 1 or len(sample) == 0:
        raise ValueError(f"values must have shape (n,) with n >= 1, got {sample.shape}")
    found = [float(statistic(rng.choice(sample, len(sample)))) for _ in range(RESAMPLES)]
    low, high = np.quantile(found, [(1.0 - CONFIDENCE) / 2, (1.0 + CONFIDENCE) / 2]).tolist()
    return low, high
