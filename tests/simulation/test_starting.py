"""Where a robot is put down when nobody says where."""

import numpy as np
import pytest

from pilotage.simulation import StartError, World, find_start
from pilotage.simulation.starting import is_in_building

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


@pytest.mark.parametrize("gap", [0.0, 1.0])
def test_the_notch_of_a_building_is_outside_unless_a_door_leads_there(gap):
    walls = [
        *((0, 0, 8, 0), (8, 0, 8, 4), (8, 4, 4 + gap, 4), (4, 4, 4, 8), (4, 8, 0, 8), (0, 8, 0, 0)),
        *((0, 3, 2, 3), (2, 3, 2, 0)),  # a room without a door
    ]
    world = World(np.array(walls, dtype=np.float64))
    robot = (6.0, 2.0)

    assert is_in_building(world, (2.0, 6.0), robot, RADIUS)
    assert is_in_building(world, (1.0, 1.0), robot, RADIUS)
    assert (gap > 0.0) == is_in_building(world, (6.0, 6.0), robot, RADIUS)
