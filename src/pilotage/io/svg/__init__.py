"""Drawings and worlds in SVG."""

from pilotage.io.svg.reader import read_svg
from pilotage.io.svg.world import read_svg_world

__all__ = ["read_svg", "read_svg_world"]
