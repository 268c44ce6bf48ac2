"""Scores against the truth, with units and intervals; all randomness comes from seeds."""
