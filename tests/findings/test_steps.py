"""Rows of lines that look like stairs."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from flats import BLACK, box, stroke
from pilotage.findings import report
from pilotage.findings.steps import STEPS, rows_of_steps
from pilotage.interpretation import Role, Sheet, interpret

WALLS = [box(0, 0, 100, 4, fill=BLACK), box(0, 76, 100, 80, fill=BLACK), box(0, 4, 4, 76, fill=BLACK)]
WALLS += [box(96, 4, 100, 76, fill=BLACK), box(48, 4, 52, 30, fill=BLACK), box(48, 42, 52, 76, fill=BLACK)]


def flight(count, *, depth=2.0, width=10.0, turn=0.0):
    """Lines, one after the other along x, turned as a whole, (n, 2, 2)."""
    x = depth * np.arange(count)
    lines = np.stack([np.column_stack([x, 0.0 * x]), np.column_stack([x, 0.0 * x + width])], axis=1)
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    return lines @ rotation.T


@given(st.integers(STEPS, 20), st.floats(1.0, 5.0), st.floats(-4.0, 4.0), st.randoms())
def test_a_flight_is_one_row_however_it_is_turned_and_in_whatever_order(count, depth, turn, order):
    lines = flight(count, depth=depth, turn=turn)
    numbers = list(range(count))
    order.shuffle(numbers)
    (row,) = rows_of_steps(lines[numbers])

    assert set(range(count)) == set(row.tolist())


def test_steps_may_be_tilted_a_little_to_either_side():
    lines = flight(7, turn=np.pi / 2.0)
    lines[::2, 1, 1] += 0.05
    lines[1::2, 1, 1] -= 0.05
    (row,) = rows_of_steps(lines)

    assert set(range(7)) == set(row.tolist())


def test_spokes_all_around_are_followed_once():
    angles = np.linspace(0.0, 2.0 * np.pi, 240, endpoint=False)
    spokes = np.stack([np.cos(angles), np.sin(angles)], axis=1)[:, np.newaxis] * np.array([[20.0], [22.0]])
    (row,) = rows_of_steps(spokes)

    assert 240 == len(set(row.tolist())) == len(row)


@pytest.mark.parametrize(
    "lines",
    [
        flight(STEPS - 1),
        flight(9, depth=8.0),  # a row of posts
        flight(9, depth=0.2),  # a hatch
        flight(9) * np.linspace(0.3, 1.0, 9)[:, np.newaxis, np.newaxis],  # a fan
        np.zeros((9, 2, 2)),
        np.empty((0, 2, 2)),
    ],
)
def test_other_lines_are_no_stairs(lines):
    assert [] == rows_of_steps(lines)


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
