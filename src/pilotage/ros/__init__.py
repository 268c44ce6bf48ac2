"""Live robots of ROS 2 over DDS; no ROS is installed here (extra `ros2`)."""
