import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pilotage.geometry import wrap_angle

turns = st.floats(-50.0, 50.0)


@given(st.lists(turns, min_size=1, max_size=5))
def test_arrays_are_wrapped_as_numbers_are(angles):
    wrapped = wrap_angle(np.array(angles))

    assert (wrapped > -math.pi - 1e-12).all()
    assert (wrapped <= math.pi + 1e-12).all()
    for angle, one in zip(angles, wrapped.tolist(), strict=True):
        assert math.cos(one - wrap_angle(angle)) == pytest.approx(1.0)


@pytest.mark.parametrize("angle", [math.pi, -math.pi])
def test_half_a_turn_is_to_the_left(angle):
    assert math.pi == wrap_angle(angle)
    assert math.pi == wrap_angle(np.array([angle]))[0]
