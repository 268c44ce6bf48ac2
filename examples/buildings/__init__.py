"""Three made-up buildings, furnished and lived in, and how two people remember each of them."""

from buildings.home import HOME
from buildings.museum import MUSEUM
from buildings.office import OFFICE
from buildings.plan import Building, Memory

BUILDINGS = (OFFICE, HOME, MUSEUM)

__all__ = ["BUILDINGS", "HOME", "MUSEUM", "OFFICE", "Building", "Memory"]
