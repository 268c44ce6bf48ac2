"""Where a robot is put down when nobody says where."""

import numpy as np
import pytest

from pilotage.simulation import StartError, World, find_start

RADIUS = 0.2


def box(left, bottom, right, top):
    """Return the four walls of a box."""
    return [
        (left, bottom, right, bottom),
        (right, bottom, right, top),
        (right, top, left, top),
        (left, top, left, bottom),
    ]


def test_a_robot_is_put_down_where_it_fits_in_the_largest_room():
    world = World(np.array([*box(0, 0, 2, 2), *box(5, 0, 9, 3), *box(6, 1, 7, 2)], dtype=np.float64))
    poses = [find_start(world, RADIUS, np.random.default_rng(seed)) for seed in range(20)]
    positions = np.array([pose.position for pose in poses])

    assert world.is_free(positions, RADIUS).all()
    assert (positions > (5.0, 0.0)).all()
    assert (positions < (9.0, 3.0)).all()
    assert np.ptp(positions, axis=0).min() > 1.0


def test_the_same_seed_finds_the_same_place():
    world = World(np.array(box(0, 0, 4, 4), dtype=np.float64))

    assert find_start(world, RADIUS, np.random.default_rng(7)) == find_start(
        world, RADIUS, np.random.default_rng(7)
    )


@pytest.mark.parametrize(
    "walls", [box(0, 0, 0.5, 4), box(0, 0, 4, 4)[:3], [(0, 0, 9, 0)]], ids=["narrow", "open", "a wall"]
)
def test_a_world_that_encloses_no_free_space_is_refused(walls):
    with pytest.raises(StartError, match="free space that walls enclose"):
        find_start(World(np.array(walls, dtype=np.float64)), RADIUS, np.random.default_rng(0))
