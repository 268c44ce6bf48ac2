"""Three made-up buildings, furnished and lived in, and how two people remember each of them."""

from floors.home import HOME
from floors.museum import MUSEUM
from floors.office import OFFICE
from floors.plan import Building, Memory

BUILDINGS = (OFFICE, HOME, MUSEUM)

__all__ = ["BUILDINGS", "HOME", "MUSEUM", "OFFICE", "Building", "Memory"]
