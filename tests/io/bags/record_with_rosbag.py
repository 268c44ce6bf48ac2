"""Record a drive along a wall with the rosbag of ROS 1: `python3 record_with_rosbag.py FILE COMPRESSION`.

It runs on Debian's own Python, which has rosbag and the messages, and knows nothing of ours.
"""

import math
import sys

import rosbag
import rospy
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

SCANS = 40


def mount():
    """Return the transform from the base to a laser that looks left."""
    moved = TransformStamped()
    moved.header.frame_id, moved.child_frame_id = "base_link", "laser"
    moved.transform.translation.x = 0.2
    moved.transform.rotation.z = moved.transform.rotation.w = math.sqrt(0.5)
    return TFMessage([moved])


def odometry(k):
    """Return where the robot is at scan k."""
    message = Odometry()
    message.header.stamp, message.header.frame_id = rospy.Time(100, k * 25_000_000), "odom"
    message.child_frame_id = "base_link"
    message.pose.pose.position.x = 0.05 * k
    message.pose.pose.orientation.w = 1.0
    return message


def scan(k):
    """Return scan k: a hole, a miss, and rising ranges."""
    message = LaserScan()
    message.header.stamp, message.header.frame_id = rospy.Time(100, k * 25_000_000), "laser"
    message.angle_min, message.angle_max = -math.pi / 2, math.pi / 2
    message.angle_increment = math.pi / 180
    message.range_min, message.range_max = 0.1, 30.0
    message.ranges = [1.0 + 0.01 * i + 0.001 * k for i in range(181)]
    message.ranges[0], message.ranges[180] = math.inf, math.nan
    return message


with rosbag.Bag(sys.argv[1], "w", compression=sys.argv[2], chunk_threshold=4096) as bag:
    bag.write("/tf_static", mount(), rospy.Time(99))
    for k in range(SCANS):
        for topic, message in (("/odom", odometry(k)), ("/scan", scan(k))):
            bag.write(topic, message, message.header.stamp)
