import numpy as np

from pilotage.navigation.stall import StallDetector

PATIENCE = 8.0


def driven(speed, seconds, turn_back_every=None):
    stall, x, direction = StallDetector(), 0.0, 1.0
    for step in range(int(seconds / 0.3)):
        if turn_back_every and step % turn_back_every == 0:
            direction = -direction
        x += direction * speed * 0.3
        stall = stall.updated(0.3 * step, np.array([x, 0.0]), PATIENCE)
    return stall


def test_a_robot_that_has_not_begun_is_not_stalled():
    assert not StallDetector().is_stalled(PATIENCE)


def test_a_robot_that_stands_is_stalled_once_patience_ends():
    assert not driven(0.0, PATIENCE - 1.0).is_stalled(PATIENCE)
    assert driven(0.0, PATIENCE + 1.0).is_stalled(PATIENCE)


def test_a_robot_that_drives_on_is_not_stalled():
    assert not driven(0.2, 100.0).is_stalled(PATIENCE)


def test_a_robot_that_goes_to_and_fro_is_stalled_after_longer():
    assert not driven(0.4, 2 * PATIENCE, turn_back_every=10).is_stalled(PATIENCE)
    assert driven(0.4, 6 * PATIENCE, turn_back_every=10).is_stalled(PATIENCE)


def test_old_positions_are_forgotten():
    assert len(driven(0.2, 1000.0).moments) < 200
