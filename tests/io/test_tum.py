"""Trajectories survive writing and reading."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pilotage.errors import FileError
from pilotage.geometry import Trajectory, wrap_angle
from pilotage.io.tum import read_trajectory, write_trajectory
from strategies import poses


@settings(deadline=None)
@given(st.lists(poses, min_size=1, max_size=5))
def test_what_is_written_is_read_again(tmp_path_factory, written):
    path = tmp_path_factory.mktemp("tum") / "path.tum"
    trajectory = Trajectory(
        np.arange(len(written)), np.array([(pose.x, pose.y, pose.theta) for pose in written])
    )
    write_trajectory(path, trajectory)
    read = read_trajectory(path)

    np.testing.assert_allclose(read.stamps, trajectory.stamps)
    np.testing.assert_allclose(read.poses[:, :2], trajectory.poses[:, :2], atol=1e-6)
    for expected, got in zip(trajectory.poses[:, 2], read.poses[:, 2], strict=True):
        assert 0.0 == pytest.approx(wrap_angle(expected - got), abs=1e-6)


def test_comments_are_passed_over(tmp_path):
    path = tmp_path / "path.tum"
    path.write_text("# stamp x y\n1 2 3 0 0 0 0 1  # here\n\n", encoding="ascii")

    assert [[2.0, 3.0, 0.0]] == read_trajectory(path).poses.tolist()


@pytest.mark.parametrize(
    "content", ["", "# nothing\n", "1 2 3\n", "a b c d e f g h\n", "nan 0 0 0 0 0 0 1\n"]
)
def test_what_is_no_trajectory_is_refused(tmp_path, content):
    path = tmp_path / "path.tum"
    path.write_text(content, encoding="ascii")

    with pytest.raises(FileError):
        read_trajectory(path)


def test_a_trajectory_refuses_arrays_that_do_not_belong_together():
    with pytest.raises(ValueError, match="stamps"):
        Trajectory(np.zeros(2), np.zeros((3, 3)))
    with pytest.raises(ValueError, match="finite"):
        Trajectory(np.zeros(1), np.full((1, 3), np.nan))
