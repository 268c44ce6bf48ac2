"""Hypothesis strategies shared by all tests."""

import math

import numpy as np
from hypothesis import strategies as st

from pilotage.geometry import Polyline, Pose2

coordinates = st.floats(-10.0, 10.0).map(lambda value: round(value, 3))
angles = st.floats(-math.pi, math.pi)
poses = st.builds(Pose2, coordinates, coordinates, angles)
scales = st.floats(0.2, 5.0)


@st.composite
def polylines(draw, min_size=2, max_size=12, closed=None):
    """Any polyline without repeated neighbors, crossing itself or not."""
    points = draw(
        st.lists(st.tuples(coordinates, coordinates), min_size=min_size, max_size=max_size, unique=True)
    )
    return Polyline.through(points, closed=draw(st.booleans()) if closed is None else closed)


@st.composite
def graphs_of_functions(draw, min_size=2, max_size=40, above=0.0):
    """An open polyline that runs from left to right and so cannot cross itself."""
    steps = draw(st.lists(st.floats(0.01, 2.0), min_size=min_size, max_size=max_size))
    heights = draw(st.lists(st.floats(0.0, 3.0), min_size=len(steps), max_size=len(steps)))
    return Polyline.through(np.column_stack([np.cumsum(steps), above + np.array(heights)]))


@st.composite
def star_shaped_outlines(draw, min_size=3, max_size=40):
    """A closed polyline around the origin, counter-clockwise, that does not cross itself."""
    radii = draw(st.lists(st.floats(0.5, 5.0), min_size=min_size, max_size=max_size))
    directions = np.linspace(0.0, math.tau, len(radii), endpoint=False)
    return Polyline.through(
        np.array(radii)[:, None] * np.column_stack([np.cos(directions), np.sin(directions)]), closed=True
    )
