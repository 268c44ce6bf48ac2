"""A world with true walls, a noisy laser and drifting odometry."""
