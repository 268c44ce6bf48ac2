"""Rows of lines that look like stairs."""

import numpy as np
import pytest

from flats import BLACK, box, flight, stroke
from pilotage.findings import report
from pilotage.interpretation import Role, Sheet, interpret

WALLS = [box(0, 0, 100, 4, fill=BLACK), box(0, 76, 100, 80, fill=BLACK), box(0, 4, 4, 76, fill=BLACK)]
WALLS += [box(96, 4, 100, 76, fill=BLACK), box(48, 4, 52, 30, fill=BLACK), box(48, 42, 52, 76, fill=BLACK)]


def test_steps_in_a_room_are_told_until_they_are_called_stairs():
    lines = flight(7) + np.array((70.0, 20.0))
    steps = [stroke(*line, names=("X7",)) for line in lines.tolist()]
    sheet = Sheet((*WALLS, *steps))

    def kinds(**layers):
        found = interpret(sheet, layers)
        return {finding.kind: finding for finding in report(found.sketch, found).findings}

    assert "7 lines" in kinds()["drivable-stairs"].text
    assert (76.0, 25.0) == pytest.approx(kinds()["drivable-stairs"].where)
    assert "drivable-stairs" not in kinds(X7=Role.STAIRS)


def test_a_rack_narrower_than_stairs_is_not_told():
    lines = 0.4 * flight(7) + np.array((70.0, 20.0))
    found = interpret(Sheet((*WALLS, *(stroke(*line) for line in lines.tolist()))))

    assert "drivable-stairs" not in {finding.kind for finding in report(found.sketch, found).findings}
