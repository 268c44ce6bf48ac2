"""Relations checked by hand score a trajectory."""

import numpy as np
import pytest

from pilotage.errors import FileError
from pilotage.evaluation.relations import Relation, read_relations, relation_errors
from pilotage.geometry import Pose2, Trajectory
from pilotage.io.tum import read_trajectory
from shared_data import LOGS, needs_logs

STRAIGHT = Trajectory(np.array([0.0, 1.0, 3.0]), np.array([[0.0, 0, 0], [1.0, 0, 0], [3.0, 0, 0]]))


def test_poses_between_stamps_count_too():
    errors = relation_errors(STRAIGHT, (Relation(0.5, 2.0, Pose2(1.5, 0.0, 0.0)),))

    assert [0.0] == pytest.approx(errors.place)


def test_errors_are_those_of_the_relative_pose():
    errors = relation_errors(STRAIGHT, (Relation(0.0, 3.0, Pose2(3.0, 0.4, 0.1)),))

    assert errors.place[0] == pytest.approx(0.4)
    assert errors.turn[0] == pytest.approx(0.1)


@pytest.mark.parametrize("content", ["1 2 3\n", "a b c d e\n", ""])
@pytest.mark.filterwarnings("ignore:loadtxt")
def test_what_is_no_relation_is_refused(tmp_path, content):
    path = tmp_path / "log.relations"
    path.write_text(content, encoding="ascii")

    with pytest.raises(FileError):
        read_relations(path)


@needs_logs
def test_the_corrected_trajectory_scores_as_published():
    relations = read_relations(LOGS / "freiburg-079.relations")
    place = relation_errors(read_trajectory(LOGS / "freiburg-079.truth.tum"), relations).place

    assert len(relations) == 1685
    assert place.mean() == pytest.approx(0.060, abs=0.001)
    assert place.std() == pytest.approx(0.042, abs=0.001)
