"""How the benchmark `plans` scores, on plans of two rooms made up here."""

from pathlib import Path

import numpy as np
import pytest
import shapely
from benchmarks.lib import plans
from benchmarks.lib.divide import Division, divide
from benchmarks.lib.plans import Plan, bears, discs, homography, projected, score

from pilotage.worlds import OFFICE

LEFT, RIGHT = shapely.box(0, 0, 10, 10), shapely.box(10, 0, 20, 10)
SCRAP = shapely.box(9.5, 4, 10.5, 6)


def plan_of_two(*, open_pairs=()):
    points = np.array([(5.0, 5.0), (15.0, 5.0)])
    bodies = (LEFT, RIGHT)
    both = frozenset({frozenset({0, 1})})
    return Plan(Path("two.svg"), "plans", ("Kitchen", "Store"), points, bodies, both, open_pairs)


def test_two_rooms_that_are_two_named_cells_with_a_door_score_all():
    found = score(plan_of_two(), Division((LEFT, RIGHT), ("kitchen", "STORE"), (False, False), ((0, 1),)))

    assert found.figures | {"seconds": 0, "mb": 0} == {
        "rooms": 1.0,
        "rooms_strict": 1.0,
        "names": 1.0,
        "connections_p": 1.0,
        "connections_r": 1.0,
        "connections_f1": 1.0,
        "seconds": 0,
        "mb": 0,
    }


def test_two_rooms_in_one_cell_are_not_found_unless_they_are_one_open_space():
    one = Division((shapely.union(LEFT, RIGHT),), ("Kitchen, Store",), (False,))

    assert score(plan_of_two(), one).figures["rooms"] == 0.0
    assert score(plan_of_two(), one).figures["connections_f1"] == 0.0
    tolerant = score(plan_of_two(open_pairs=((0, 1),)), one).figures
    assert (tolerant["rooms"], tolerant["rooms_strict"], tolerant["names"]) == (1.0, 0.0, 1.0)
    assert tolerant["connections_f1"] == 1.0


def test_a_cell_that_holds_less_than_half_of_a_room_is_not_the_room():
    narrow = Division((shapely.box(4, 4, 6, 6), RIGHT), ("", ""), (True, False), ((0, 1),))

    assert score(plan_of_two(), narrow).missed == ("0",)


@pytest.mark.parametrize(("small", "label", "hits"), [(True, "", 1), (False, "", 0), (True, "Lobby", 0)])
def test_rooms_are_joined_through_unnamed_scraps_only(small, label, hits):
    cells = (LEFT, RIGHT, SCRAP)
    division = Division(cells, ("", "", label), (False, False, small), ((0, 2), (1, 2)))

    assert score(plan_of_two(), division).hits == hits


def test_a_file_that_cannot_be_read_scores_nothing():
    figures = score(plan_of_two(), Division(error="no")).figures

    assert (figures["rooms"], figures["connections_p"], figures["connections_f1"]) == (0.0, 0.0, 0.0)
    assert figures["error"] == "no"


def test_names_are_compared_without_case_accents_and_areas():
    assert bears("DORMITÓRIO 1, 11.2 m2", "Dormitorio 1")
    assert bears("Bed Room 11' x 10'", "Bed Room")
    assert not bears("Bedroom 2", "Bedroom 1")


def test_discs_lie_a_quarter_of_the_way_to_the_next_room():
    first, _ = discs(np.array([(0.0, 0.0), (8.0, 0.0)]))

    assert first.bounds == pytest.approx((-2.0, -2.0, 2.0, 2.0))


def test_corners_of_the_flat_are_carried_to_those_of_a_photo():
    frame = np.array([(0, 0), (1200, 0), (1200, 800), (0, 800)], dtype=float)

    for corners in plans.PHOTO_CORNERS.values():
        assert projected(homography(frame, np.array(corners)), frame) == pytest.approx(np.array(corners))


def test_a_drawing_is_divided_in_a_process_of_its_own(tmp_path):
    found = divide(OFFICE.quick)
    broken = tmp_path / "broken.svg"
    broken.write_text("<svg")

    assert len(found.cells) == len(found.labels) > 5
    assert found.gateways
    assert found.mb > 10
    assert "well-formed" in divide(broken).error
