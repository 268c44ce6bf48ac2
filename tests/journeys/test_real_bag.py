"""A real robot's recording is localized on a sketch of its place, from the start and through to the end."""

from pathlib import Path

import numpy as np
import pytest

from pilotage import Localizer, Status, open_log, open_map
from shared_data import DATA, needs_bags

EXAMPLES = Path(__file__).parents[2] / "examples"
START = 272.0, 92.0, 0.0
END = 152.0, 112.0
"""Where scan matching puts the robot at the end, drawn by the marked start and 20 units a metre."""


@needs_bags
@pytest.mark.slow
def test_a_turtlebot_is_followed_through_a_hall_on_a_sketch():
    localizer = Localizer(open_map(EXAMPLES / "hall.svg"), start=START)
    estimates = [localizer.update(r.scan, r.odometry) for r in open_log(DATA / "bags" / "mac_take_2_bag")]
    last = estimates[-1]

    assert 0.9 <= np.mean([one.status is Status.LOCATED for one in estimates])
    assert 2.0 >= np.hypot(last.x - END[0], last.y - END[1]) / last.scale
