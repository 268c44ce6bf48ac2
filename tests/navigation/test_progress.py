import numpy as np

from pilotage.navigation.progress import Progress

PATIENCE = 8.0


def driven(speed, seconds, turn_back_every=None):
    progress, x, direction = Progress(), 0.0, 1.0
    for step in range(int(seconds / 0.3)):
        if turn_back_every and step % turn_back_every == 0:
            direction = -direction
        x += direction * speed * 0.3
        progress = progress.at(0.3 * step, np.array([x, 0.0]), PATIENCE)
    return progress


def test_nobody_is_stuck_who_has_not_begun():
    assert not Progress().is_stuck(PATIENCE)


def test_who_stands_is_stuck_once_patience_ends():
    assert not driven(0.0, PATIENCE - 1.0).is_stuck(PATIENCE)
    assert driven(0.0, PATIENCE + 1.0).is_stuck(PATIENCE)


def test_who_drives_on_is_not():
    assert not driven(0.2, 100.0).is_stuck(PATIENCE)


def test_who_goes_to_and_fro_is_stuck_after_longer():
    assert not driven(0.4, 2 * PATIENCE, turn_back_every=10).is_stuck(PATIENCE)
    assert driven(0.4, 6 * PATIENCE, turn_back_every=10).is_stuck(PATIENCE)


def test_only_what_matters_is_remembered():
    assert len(driven(0.2, 1000.0).moments) < 200
