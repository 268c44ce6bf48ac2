"""What DDS is told of a type is what rosbags packs: cyclonedds packs the same bytes by it."""

import dataclasses

import numpy as np
import pytest
from benchmarks.lib.bag_making import Maker

from pilotage import Pose2
from pilotage.io.bags import outgoing
from pilotage.io.bags.belief import Belief, Place
from pilotage.ros.idl import idl_type, structure

BELIEF = Belief(1.5, (Place(Pose2(1.0, 2.0, 0.5), 0.9),), np.eye(2), {"status": "located", "place": "hall"})
MESSAGES = {
    "sensor_msgs/msg/LaserScan": Maker("").scan(2.5, [1.0, np.inf, 3.0])[1],
    "nav_msgs/msg/Odometry": Maker("").odometry(1.0, (1.0, 2.0, 3.0))[1],
    "tf2_msgs/msg/TFMessage": outgoing.transform(1.0, "map", "odom", Pose2(1.0, 2.0, 3.0)),
    "geometry_msgs/msg/PoseWithCovarianceStamped": outgoing.pose_estimate(BELIEF),
    "visualization_msgs/msg/MarkerArray": outgoing.hypotheses(BELIEF),
    "diagnostic_msgs/msg/DiagnosticArray": outgoing.diagnostics(BELIEF),
}


@pytest.mark.parametrize("name", MESSAGES)
def test_cyclonedds_packs_as_rosbags_does(name):
    packed = bytes(outgoing.typestore().serialize_cdr(MESSAGES[name], name))
    theirs = structure(name).deserialize(packed)

    assert theirs.serialize(use_version_2=False).ljust(len(packed), b"\0") == packed
    assert set(dataclasses.asdict(theirs)) <= {field.name for field in dataclasses.fields(MESSAGES[name])}


def test_names_are_those_of_rmw_implementations():
    assert (
        "sensor_msgs::msg::dds_::LaserScan_"
        == idl_type("sensor_msgs/msg/LaserScan").__idl__.idl_transformed_typename
    )
