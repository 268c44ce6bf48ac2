"""Lines that end before a wall, with but a slit between the paint of both."""

import pytest

from flats import OUTSIDE, graph_of, stroke
from pilotage.interpretation import Sheet, interpret


@pytest.mark.parametrize(("end", "width", "is_open"), [(2.5, 2.0, False), (8.0, 2.0, True), (2.5, 0.5, True)])
def test_no_way_leads_through_a_slit_between_two_thick_lines(end, width, is_open):
    outer = stroke((0, 0), (100, 0), (100, 80), (0, 80), (0, 0), width=width)
    wall = stroke((50, 0), (50, 80 - end), width=width)

    assert is_open == bool(graph_of((outer, wall)).gateways)


def test_a_line_that_meets_a_wall_stays_as_drawn():
    wall = stroke((50, 0), (50, 80), width=2.0)

    strokes = interpret(Sheet((OUTSIDE, wall))).sketch.strokes

    assert wall.outlines[0] in strokes
