"""Places and directions between a sketch and the photo that it was straightened from."""

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from pilotage.geometry import Homography, Pose2
from pilotage.maps import FileAxes

SHEET = np.array([(100.0, -50.0), (900.0, -50.0), (900.0, -600.0), (100.0, -600.0)])
IN_PHOTO = np.array([(150.0, -80.0), (860.0, -110.0), (950.0, -620.0), (60.0, -590.0)])
PHOTO = FileAxes(y_down=True, photo_from_sketch=Homography.between(SHEET, IN_PHOTO))

inside = st.builds(Pose2, st.floats(100.0, 900.0), st.floats(-600.0, -50.0), st.floats(-3.0, 3.0))


def test_the_corners_of_the_sheet_lie_on_those_in_the_photo():
    np.testing.assert_allclose(PHOTO.from_sketch(SHEET), IN_PHOTO * (1.0, -1.0), atol=1e-6)


@given(inside, st.sampled_from([PHOTO, FileAxes(), FileAxes(y_down=True)]))
def test_a_pose_comes_back_from_the_file(pose, axes):
    back = axes.pose_to_sketch(axes.pose_from_sketch(pose))

    np.testing.assert_allclose(back.position, pose.position, atol=1e-6)
    assert abs(math.remainder(back.theta - pose.theta, math.tau)) < 1e-9


@given(inside)
def test_a_heading_is_that_of_a_short_step(pose):
    step = 1e-3 * np.array([math.cos(pose.theta), math.sin(pose.theta)])
    before, after = PHOTO.from_sketch(np.array([pose.position - step, pose.position + step]))
    dx, dy = after - before

    in_photo = PHOTO.pose_from_sketch(pose)
    assert abs(math.remainder(math.atan2(-dy, dx) - in_photo.theta, math.tau)) < 1e-5
