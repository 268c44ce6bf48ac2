"""Examples of the help work as written on the packed office, whose drawing a newcomer copies first."""

import re

import numpy as np
import pytest

from pilotage import open_map, open_world
from pilotage.cli.cells import cells
from pilotage.cli.localize import localize
from pilotage.cli.navigate import navigate
from pilotage.maps import DecompositionSettings, check_place, decompose
from pilotage.worlds import OFFICE

POINT = re.compile(r"--(?:start|goal) (-?[\d.]+),(-?[\d.]+)")
PLACE = re.compile(r"--from (-?[\d.]+),(-?[\d.]+),")


@pytest.mark.parametrize("command", [cells, localize, navigate])
def test_points_of_the_examples_lie_in_rooms(command):
    found = POINT.findall(command.__doc__)
    assert found

    for drawing in (OFFICE.quick, OFFICE.careful):
        sketch = open_map(drawing)
        graph = decompose(sketch, DecompositionSettings())
        for x, y in sketch.sketch_from_file(np.array(found, dtype=float)).tolist():
            check_place(graph, (x, y), "start")


def test_the_true_start_of_the_example_is_free():
    places = np.array(PLACE.findall(navigate.__doc__), dtype=float)

    assert len(places) == 1
    assert open_world(OFFICE.world).is_free(places, 0.3).all()
