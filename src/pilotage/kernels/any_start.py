"""Compare two closed contours as wholes, from the best start of each (Arkin et al. 1991)."""

import numpy as np

from pilotage.kernels.compiling import njit
from pilotage.kernels.steps import Steps
from pilotage.kernels.tangent import length_factor, mean_and_variance


@njit(cache=True)
def any_start_dissimilarity(c: Steps, d: Steps) -> float:
    """Compute the least S(c, d), eq. (2), over all starts of two contours that turn equally far in all.

    Both are laid out twice around. Let D(t) be the integral of (T(c)(s + t) - T(d)(s))² once around. As t
    grows, the steps of c move along d. Between two moments at which a step meets a step, D is linear and the
    variance, D less the square of the mean, is concave: it is least at one of those moments. Where steps by u
    and by v meet, the slope of D changes by 2 u v. So the meetings are sorted and summed up: O(n m log n m),
    and O(n m (n + m)) start by start.
    """
    n, m = len(c.directions) // 2, len(d.directions) // 2
    at_c, at_d = c.stops[1 : n + 1] / c.stops[n], d.stops[1 : m + 1] / d.stops[m]  # in (0, 1]
    step_c = c.directions[1 : n + 1] - c.directions[:n]
    step_d = d.directions[1 : m + 1] - d.directions[:m]
    turn = c.directions[n] - c.directions[0]

    first = int(np.int64(0))  # a literal 0 has a type of its own
    mean, variance = mean_and_variance(c, first, n, d, first, m)
    integral, slope = variance + mean * mean, 0.0
    meetings, bends, count = np.empty(n * m), np.empty(n * m), 0
    for i in range(n):
        if step_c[i] == 0.0:
            continue
        before = d.directions[np.searchsorted(at_d, at_c[i])]  # T(d) just before the step
        slope += step_c[i] * (c.directions[i] + c.directions[i + 1] - 2.0 * before)
        for j in range(m):
            if step_d[j] != 0.0 and at_c[i] != at_d[j]:
                later = at_c[i] - at_d[j]
                meetings[count], bends[count] = (
                    later if later > 0.0 else later + 1.0,
                    2.0 * step_c[i] * step_d[j],
                )
                count += 1

    least, now = variance, 0.0
    for k in np.argsort(meetings[:count]):
        integral += slope * (meetings[k] - now)
        now = meetings[k]
        slope += bends[k]
        least = min(least, integral - (mean + turn * now) ** 2)
    return max(least, 0.0) * length_factor(c.stops[n], d.stops[m])
