"""A trip is told the same however long it is, and keeps no more than was said."""

from hypothesis import given
from hypothesis import strategies as st

from pilotage import Estimate, Pose2, PoseHypothesis, Status
from pilotage.cli.trip import Trip
from pilotage.geometry import Affine2

HERE = PoseHypothesis("a", Affine2.from_state(0.0, 0.0, 0.0, 0.0, 0.0, 0.0) @ Pose2.identity(), 0.9)


def estimate(k, located):
    status = Status.LOCATED if located else Status.LOST
    return Estimate(float(k), status, (HERE,), 0.9, 0.5, "a")


@given(st.lists(st.booleans(), min_size=1, max_size=80))
def test_counts_are_exact_and_few_estimates_are_kept(located):
    trip = Trip(most_kept=10)
    for k, is_located in enumerate(located):
        trip.add(estimate(k, is_located))
    steps = {b.stamp - a.stamp for a, b in zip(trip.estimates, trip.estimates[1:], strict=False)}

    assert (len(located), sum(located)) == (trip.count, trip.located)
    assert trip.first_located == (located.index(True) if any(located) else None)
    assert len(trip.estimates) <= 10
    assert 1 >= len(steps)  # evenly
    assert trip.summary.startswith(f"{len(located)} scan")
