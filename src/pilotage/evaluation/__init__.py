"""Scores with units and intervals, runs with seeds."""
