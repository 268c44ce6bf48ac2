"""Live robots of ROS 2 over DDS (extra `ros2`) or Zenoh (`zenoh`); no ROS is installed here."""
