"""Drawings in SVG."""

from pilotage.io.svg.reader import read_svg

__all__ = ["read_svg"]
