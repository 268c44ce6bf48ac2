"""A robot stands when it does not hear, or cannot trust, what it drives by."""

from hypothesis import given
from hypothesis import strategies as st

from pilotage.ros.watchdog import CLOCK_JUMP, NO_SCAN, Watchdog


def test_before_the_first_scan_the_robot_stands():
    assert "no scan has come" == Watchdog().reason(5.0)


@given(silence=st.floats(0.0, 10.0))
def test_silence_is_a_reason_after_a_while(silence):
    dog = Watchdog()
    dog.hear(1.0, 100.0)

    assert (1.0 + silence - 1.0 > NO_SCAN) == bool(dog.reason(1.0 + silence))


@given(jump=st.floats(-100.0, 100.0))
def test_a_clock_that_jumps_is_a_reason_until_the_next_scan(jump):
    dog = Watchdog()
    dog.hear(1.0, 100.0)
    dog.hear(1.1, 100.1 + jump)
    told = "the clock jumped" in dog.reason(1.1)
    dog.hear(1.2, 100.2 + jump)

    if abs(jump) > CLOCK_JUMP + 0.2:
        assert told
    if abs(jump) < CLOCK_JUMP - 0.2:
        assert not told
    assert "" == dog.reason(1.2)


def test_trouble_with_a_scan_is_told_until_a_good_one_comes():
    dog = Watchdog()
    dog.hear(1.0, 5.0, "odometry is stale by 0.40 s")
    assert "odometry is stale by 0.40 s" == dog.reason(1.0)

    dog.hear(1.1, 5.1)
    assert "" == dog.reason(1.1)
