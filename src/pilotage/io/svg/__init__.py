"""Drawings and worlds in SVG."""

from pilotage.io.svg.sheet import read_svg_sheet
from pilotage.io.svg.world import read_svg_world

__all__ = ["read_svg_sheet", "read_svg_world"]
