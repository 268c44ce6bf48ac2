"""Where the robot is on the drawing: the only layer that knows both scan and map (Wolter 2001, section 3)."""
