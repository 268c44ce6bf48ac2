"""Recordings of ROS 1 and ROS 2: bags, sqlite3 and MCAP files, and folders of them."""

from pilotage.io.bags.reader import is_bag, read_bag

__all__ = ["is_bag", "read_bag"]
