"""From the drawing to places (Wolter 2001, sections 2.2 and 4.1)."""

from pilotage.maps.schematic import Label, SchematicMap

__all__ = ["Label", "SchematicMap"]
