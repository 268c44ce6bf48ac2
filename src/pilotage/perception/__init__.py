"""From the laser to shapes, and the local map of what was seen (Wolter 2001, sections 2.1 and 3.3)."""

from pilotage.perception.scan import LaserScan, Odometry, Reading

__all__ = ["LaserScan", "Odometry", "Reading"]
