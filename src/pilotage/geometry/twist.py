"""How a body moves at this moment."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Twist:
    """A velocity in the frame of the robot, as ROS geometry_msgs/Twist has it for a differential drive."""

    linear: float  # [m/s] forward
    angular: float  # [rad/s] counter-clockwise
