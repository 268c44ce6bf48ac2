"""Read indoor maps: GeoJSON, IMDF and OpenStreetMap's indoor tags."""

from pilotage.io.indoor.geojson import read_geojson, read_imdf
from pilotage.io.indoor.osm import read_osm

__all__ = ["read_geojson", "read_imdf", "read_osm"]
