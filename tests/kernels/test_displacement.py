import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from pilotage.geometry import Affine2
from pilotage.kernels.displacement import displace

stretches = st.one_of(st.just(0.0), st.floats(-1.5, 1.5), st.floats(-1e-9, 1e-9))


@given(st.floats(-7.0, 7.0), st.floats(-3.0, 3.0), stretches, stretches)
def test_displacements_are_carried_by_the_affine_map_of_the_state(heading, log_scale, p, q):
    state = np.array([[1.0], [2.0], [heading], [log_scale], [p], [q]])

    carried = displace(np.hstack([state, state]), np.array([5.0, 0.0]), np.array([-1.0, 3.0])).T

    linear = Affine2.from_state(0.0, 0.0, heading, log_scale, p, q).linear
    expected = np.array([[5.0, -1.0], [0.0, 3.0]]) @ linear.T
    np.testing.assert_allclose(carried, expected, atol=1e-12 * math.exp(log_scale))
