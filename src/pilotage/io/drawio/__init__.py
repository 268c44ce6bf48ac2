"""Read drawings of draw.io (diagrams.net)."""

from pilotage.io.drawio.reader import read_drawio

__all__ = ["read_drawio"]
