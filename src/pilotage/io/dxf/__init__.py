"""Read drawings of CAD programs in the DXF format."""

from pilotage.io.dxf.reader import read_dxf

__all__ = ["read_dxf"]
