"""A building of four rooms, its drawing, and a simulator whose wheels do not slip."""

import numpy as np

from buildings import coarse
from pilotage.geometry import Polyline, Pose2
from pilotage.maps import SchematicMap, build_atlas
from pilotage.maps.schematic import Label
from pilotage.simulation import OdometrySettings, SimulatorSettings, World

ROOMS = (
    [(0, 0), (12, 0), (12, 9), (0, 9), (0, 0)],
    [(5, 0), (5, 2)],
    [(5, 3), (5, 6.5)],
    [(5, 7.5), (5, 9)],
    [(0, 5), (1, 5)],
    [(2, 5), (9, 5)],
    [(10, 5), (12, 5)],
    [(7.5, 5), (7.5, 6)],
)
"""Four rooms, each with a door to two others, none like another [m]."""
START = Pose2(2.5, 2.5, 0.0)
EXACT = OdometrySettings(slip=0.0, drift=0.0, turn_slip=0.0)
SEEING = SimulatorSettings(odometry=EXACT)


def drawn(scale=(1.0, 1.0), labels=()):
    """Draw the rooms, so many units a metre across and up the sheet."""
    return SchematicMap(tuple(Polyline.through(np.array(stroke) * scale) for stroke in ROOMS), labels=labels)


SKETCH = drawn(labels=(Label("kitchen", (8.0, 2.5)),))
WORLD = World.of(SKETCH)
ATLAS = build_atlas(SKETCH, coarse(80, 60))
GRAPH = ATLAS.cell_graph
KITCHEN = GRAPH.cell_at((8.0, 2.5))
