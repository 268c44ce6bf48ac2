"""Walls that have a thickness."""

import numpy as np
import shapely

from pilotage.interpretation.paint import NOTHING
from pilotage.interpretation.solids import filled_between


def test_hatching_as_a_picture_shows_it_leaves_the_faces_of_a_wall_straight():
    faces = [[(0.0, 0.0), (60.0, 0.0)], [(0.0, 6.5), (60.0, 6.5)]]
    hatching = [[(x + 4.0, 0.0), (x + 3.5, 1.8), (x, 5.3), (x, 6.5)] for x in np.arange(3.0, 54.0, 5.5)]

    filled = filled_between(shapely.MultiLineString(faces + hatching), NOTHING, 20.0)

    assert np.isclose(shapely.intersection(filled, shapely.box(0, 0, 60, 6.5)).area, 390.0, rtol=0.01)
