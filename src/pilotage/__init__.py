"""Find a robot's place in a hand-drawn map from its laser scans, and drive it from there."""
