"""What `check` says about drawings that are wrong in one way each."""

import json
import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

import pilotage
from buildings import CORRIDOR_AND_FOUR_ROOMS
from pilotage import worlds
from pilotage.findings import MendKind, Severity, for_ends, report, worst
from pilotage.findings.doors import suggest_door
from pilotage.findings.page import join_open_ends
from pilotage.geometry import Polyline
from pilotage.io import open_map
from pilotage.maps import Label, SchematicMap, Zones

NAMES = (
    Label("Ann", (5.0, 2.0)),
    Label("Ben", (15.0, 2.0)),
    Label("Cid", (5.0, 10.0)),
    Label("Dora", (15.0, 10.0)),
    Label("Corridor", (10.0, 6.0)),
)


def drawing(*strokes, labels=NAMES, **changes):
    return SchematicMap(tuple(Polyline.through(stroke) for stroke in strokes), labels=labels, **changes)


def kinds(sketch):
    return {finding.kind: finding for finding in pilotage.check(sketch)}


GOOD = drawing(*CORRIDOR_AND_FOUR_ROOMS)
DOOR_OF_BEN = ([(14, 5), (15, 5)],)
DOOR_OF_DORA = ([(14, 7), (15, 7)],)
DOORS_OF_THREE = (*DOOR_OF_BEN, [(4, 5), (5, 5)], [(4, 7), (5, 7)])


def test_nothing_is_wrong_with_a_good_drawing():
    assert () == pilotage.check(GOOD)


@pytest.mark.parametrize("world", worlds.ALL, ids=lambda world: world.name)
def test_the_packed_drawings_have_no_worse_findings_than_notes(world):
    for path in (world.careful, world.quick):
        assert worst(pilotage.check(open_map(path))) is None


def test_rooms_that_are_closed_boxes_are_an_error_whether_they_have_names_or_not():
    boxes = ([(0, 0), (9, 0), (9, 6), (0, 6), (0, 0)], [(4, 0), (4, 6)])
    found = worst(pilotage.check(drawing(*boxes, labels=NAMES[:0])))
    with_names = pilotage.check(drawing(*boxes, labels=(Label("Hall", (2, 3)), Label("Bath", (7, 3)))))

    assert found is not None
    assert ("no-doors", Severity.ERROR) == (found.kind, found.severity)
    assert ("no-doors", Severity.ERROR) == (with_names[0].kind, with_names[0].severity)
    assert {"no-doors"} == {finding.kind for finding in with_names}
    assert MendKind.CUT is with_names[0].mend.kind


def test_openings_between_pieces_of_a_corridor_are_no_doors_of_the_named_rooms():
    halves = ([(10, 5), (10, 5.5)], [(10, 7), (10, 6.5)])
    closed = (*CORRIDOR_AND_FOUR_ROOMS, *DOOR_OF_DORA, *DOORS_OF_THREE, *halves)
    found = kinds(drawing(*closed, labels=NAMES[:4]))
    joined = kinds(drawing(*CORRIDOR_AND_FOUR_ROOMS, *DOORS_OF_THREE, *halves, labels=NAMES))

    assert {"no-doors"} == set(found)
    assert "none of the 4 rooms with a name has a door to another" == found["no-doors"].text
    assert MendKind.CUT is found["no-doors"].mend.kind
    assert "in-pieces" in joined


def test_a_room_whose_door_was_forgotten_is_found_and_a_door_suggested():
    found = worst(pilotage.check(drawing(*CORRIDOR_AND_FOUR_ROOMS, *DOOR_OF_BEN)))

    assert found is not None
    assert found.kind in {"room-without-door", "closed-area"}
    assert "'Ben'" in found.text
    assert found.mend is not None
    assert MendKind.CUT is found.mend.kind
    ends = np.array(found.mend.segment)
    assert np.hypot(*(ends[1] - ends[0])) == pytest.approx(1.0, rel=0.3)
    assert shapely.LineString(ends).distance(shapely.box(10, 0, 20, 5).exterior) < 0.1


def test_a_room_whose_only_door_leads_out_of_the_drawing_is_told_so():
    shell = [[(14, 0), (0, 0), (0, 12), (20, 12), (20, 0), (15, 0)]]
    found = kinds(drawing(*shell, *CORRIDOR_AND_FOUR_ROOMS[1:], *DOOR_OF_BEN))["room-without-door"]
    closed = kinds(drawing(*CORRIDOR_AND_FOUR_ROOMS, *DOOR_OF_BEN))["room-without-door"]

    assert "no door leads into 'Ben', except from outside of what is drawn" == found.text
    assert "no door leads into 'Ben'" == closed.text


def test_a_small_area_without_a_name_may_be_furniture():
    small = kinds(drawing(*CORRIDOR_AND_FOUR_ROOMS, [(0, 4), (0.8, 4), (0.8, 5)]))["room-without-door"]
    large = kinds(drawing(*CORRIDOR_AND_FOUR_ROOMS, *DOOR_OF_BEN))["room-without-door"]

    assert (Severity.NOTE, Severity.WARNING) == (small.severity, large.severity)
    assert small.advice.startswith("if it is furniture or a void, nothing is to be done")


def test_a_door_is_suggested_where_one_is_drawn():
    room = shapely.box(10, 0, 20, 5)
    neighbors = [shapely.box(0, 0, 10, 5), shapely.box(10, 5, 20, 7)]
    graph = report(GOOD).graph

    anywhere = suggest_door(room, neighbors, graph)
    drawn = suggest_door(room, neighbors, graph, np.array([(9.0, 1.5), (30.0, 30.0)]))
    far = suggest_door(room, neighbors, graph, np.array([(15.0, 2.5)]))

    assert np.mean(anywhere.segment, axis=0) == pytest.approx((15.0, 5.0))
    assert np.mean(drawn.segment, axis=0) == pytest.approx((10.0, 1.5))
    assert far == anywhere


def test_labels_outside_of_rooms_are_told_in_one_finding():
    found = kinds(replace(GOOD, labels=(*NAMES, Label("Plan of 1998", (10.0, 15.0)), Label("N", (25, 1)))))

    assert "'Plan of 1998' and 'N' stand outside of all rooms" == found["label-outside"].text


def test_rooms_of_one_name_and_names_in_one_room_are_told():
    doubled = (*NAMES[:1], Label("ann", (15.0, 2.0)), Label("Lab", (15.0, 10.0)), Label("Store", (16.0, 9.0)))
    found = kinds(replace(GOOD, labels=doubled))

    assert {"ann", "ann-2"} == set(found["same-name"].cell_ids)
    assert "'Lab' and 'Store'" in found["several-names"].text


def test_the_number_of_a_room_beside_its_name_is_no_second_name():
    numbered = (*NAMES[:1], Label("Lab", (15.0, 10.0)), Label("108", (16.0, 9.0)))

    assert "several-names" not in kinds(replace(GOOD, labels=numbered))


def test_a_name_with_a_comma_is_one_name():
    assert "several-names" not in kinds(replace(GOOD, labels=(*NAMES[:1], Label("Lab, Store", (15.0, 10.0)))))


def test_a_name_that_is_written_twice_in_a_room_is_one_name():
    twice = (*NAMES, Label("Corridor", (17.0, 6.0)))

    assert "several-names" not in kinds(replace(GOOD, labels=twice))


def test_a_drawing_without_words_says_how_to_name_rooms():
    assert "--label" in kinds(replace(GOOD, labels=()))["no-names"].advice


def test_words_outside_of_all_rooms_name_none():
    found = kinds(replace(GOOD, labels=(Label("Plan of 1998", (40.0, 40.0)),)))

    assert {"no-names", "label-outside"} == set(found)


def test_two_buildings_on_one_sheet_are_told():
    moved = [[(x + 40, y) for x, y in stroke] for stroke in CORRIDOR_AND_FOUR_ROOMS]
    found = kinds(drawing(*CORRIDOR_AND_FOUR_ROOMS, *moved))

    assert Severity.WARNING is found["two-buildings"].severity
    assert 5 == len(found["two-buildings"].cell_ids)


def test_parts_that_only_a_wall_divides_are_one_building():
    moved = [[(x + 20.3, y) for x, y in stroke] for stroke in CORRIDOR_AND_FOUR_ROOMS]
    found = kinds(drawing(*CORRIDOR_AND_FOUR_ROOMS, *moved))

    assert "two-buildings" not in found
    assert 5 == len(found["unreachable"].cell_ids)


def test_a_part_behind_another_part_is_of_the_same_building():
    moved = [[(x + 20.3 * k, y) for x, y in stroke] for k in (1, 2) for stroke in CORRIDOR_AND_FOUR_ROOMS]

    assert "two-buildings" not in kinds(drawing(*CORRIDOR_AND_FOUR_ROOMS, *moved))


def test_a_drawing_whose_doors_are_closed_is_said_to_be_in_pieces_first():
    found = pilotage.check(drawing(*CORRIDOR_AND_FOUR_ROOMS, *DOORS_OF_THREE))

    assert "in-pieces" == found[0].kind
    assert "doors join only 2 of 5 rooms" == found[0].text
    assert {Severity.NOTE} == {finding.severity for finding in found[1:]}
    assert "in-pieces" not in kinds(drawing(*CORRIDOR_AND_FOUR_ROOMS, *DOOR_OF_BEN))


def test_named_rooms_among_many_without_a_name_are_said_to_be_cut():
    halves = [[(x + 20, y) for x, y in stroke] for stroke in CORRIDOR_AND_FOUR_ROOMS]
    both = drawing(*CORRIDOR_AND_FOUR_ROOMS, *halves, [(20, 0), (20, 12)], labels=NAMES[:3])

    assert "7 of 10 rooms have no name" in kinds(both)["cut-rooms"].text
    assert "cut-rooms" not in kinds(replace(GOOD, labels=NAMES[:3]))


def test_rooms_called_stairs_that_a_robot_may_drive_into_are_told():
    named = replace(GOOD, labels=(*NAMES[1:], Label("Lift 2", (5.0, 2.0))))
    found = kinds(named)["stairs-room"]

    assert ("lift-2",) == found.cell_ids
    closed = kinds(replace(drawing(*CORRIDOR_AND_FOUR_ROOMS, *DOOR_OF_BEN), labels=named.labels))
    assert "'Lift 2'" in closed["stairs-room"].text
    assert "stairs-room" not in kinds(GOOD)


@pytest.mark.parametrize(("right", "is_told"), [(10.2, False), (9.5, False), (4.0, True)])
def test_rooms_called_stairs_that_are_a_keep_out_zone_are_not_told(right, is_told):
    labels = (*NAMES[1:], Label("Lift 2", (5.0, 2.0)))
    ring = Polyline(np.array([(-0.2, -0.2), (right, -0.2), (right, 5.2), (-0.2, 5.2)]), closed=True)
    found = kinds(replace(GOOD, labels=labels, zones=Zones(keep_out=(ring,))))

    assert ("stairs-room" in found) is is_told


def test_a_wing_without_a_way_to_it_is_told_with_a_door():
    wing = ([(20, 0), (30, 0), (30, 12), (20, 12)], [(20, 6), (24, 6)], [(25, 6), (30, 6)])
    found = kinds(drawing(*CORRIDOR_AND_FOUR_ROOMS, *wing))

    assert 2 == len(found["unreachable"].cell_ids)
    assert found["unreachable"].mend is not None


def test_strokes_far_outside_are_told_where_they_are():
    found = kinds(drawing(*CORRIDOR_AND_FOUR_ROOMS, [(60, 0), (61, 3)]))

    assert Severity.WARNING is found["far-strokes"].severity
    assert (60.0, 0.0) == found["far-strokes"].where


def test_a_door_that_is_too_narrow_is_told():
    narrow = [stroke for stroke in CORRIDOR_AND_FOUR_ROOMS if stroke != [(15, 5), (20, 5)]]
    found = kinds(drawing(*narrow, [(14.2, 5), (20, 5)]))

    assert (14.1, 5.0) == pytest.approx(found["closed-gap"].where, abs=1e-3)
    assert {"ben", "corridor"} == set(found["closed-gap"].cell_ids)


def test_a_gap_that_counts_as_a_door_but_is_narrow_is_told():
    narrow = [stroke for stroke in CORRIDOR_AND_FOUR_ROOMS if stroke != [(15, 5), (20, 5)]]
    found = kinds(drawing(*narrow, [(14.3, 5), (20, 5)]))

    assert MendKind.CLOSE is found["narrow-gateway"].mend.kind


@pytest.mark.parametrize(("metres", "is_told"), [(0.001, True), (1.0, False), (1000.0, True)])
def test_a_scale_that_no_building_has_is_told(metres, is_told):
    assert is_told == ("absurd-scale" in kinds(replace(GOOD, metres_per_unit=metres)))


def test_a_drawing_that_encloses_nothing_is_an_error_with_the_gap_to_close():
    found = worst(pilotage.check(drawing([(0, 0), (10, 0), (10, 10)], [(0, 9), (0, 0.5)], labels=())))

    assert found is not None
    assert ("nothing-enclosed", Severity.ERROR) == (found.kind, found.severity)
    assert found.mend is not None
    assert MendKind.CLOSE is found.mend.kind


def test_a_start_in_a_wall_and_a_goal_without_a_way_are_errors():
    outside = replace(GOOD, start=(50.0, 50.0), goal=(5.0, 2.0))

    assert ["bad-start"] == [finding.kind for finding in pilotage.check(outside)]
    other = for_ends(report(outside), (5.0, 2.0), (50.0, 50.0))
    assert ["bad-goal"] == [finding.kind for finding in other.findings]


def test_a_goal_that_no_drawn_door_leads_to_is_a_warning():
    shut = drawing(
        [(0, 0), (15, 0), (15, 5), (0, 5), (0, 0)], [(5, 0), (5, 5)], [(10, 0), (10, 2)], [(10, 3), (10, 5)]
    )
    found = {one.kind: one for one in pilotage.check(replace(shut, goal=(2.0, 2.0)))}

    assert Severity.WARNING is found["closed-goal"].severity
    assert "no gateways lead from the largest part" in found["closed-goal"].text
    assert "closed-goal" not in kinds(replace(shut, goal=(12.0, 2.0)))


def test_findings_are_in_the_axes_of_the_file():
    sketch = drawing(*CORRIDOR_AND_FOUR_ROOMS, [(60, 3), (61, 4)], y_down=True)

    assert (60.0, -3.0) == kinds(sketch)["far-strokes"].where


def test_a_finding_is_one_line_and_fits_into_json():
    for finding in pilotage.check(drawing(*CORRIDOR_AND_FOUR_ROOMS, *DOOR_OF_BEN)):
        assert 1 == len(str(finding).splitlines())
        assert json.loads(json.dumps(finding.as_json))["kind"] == finding.kind


@given(st.lists(st.tuples(st.integers(0, 9), st.integers(0, 9)), min_size=2, max_size=12))
def test_any_scribble_has_an_answer_and_the_worst_comes_first(points):
    findings = pilotage.check(drawing(points, labels=(Label("x", (3.0, 3.0)),)))
    order = [list(Severity).index(finding.severity) for finding in findings]

    assert order == sorted(order)


def test_a_one_way_arrow_beside_the_door_and_a_goal_where_none_may_drive_are_told(tmp_path):
    body = """<rect x="0" y="0" width="100" height="60"/><polyline points="50,0 50,20"/>
    <polyline points="50,30 50,60"/><line class="one-way" x1="40" y1="50" x2="48" y2="50"/>
    <line class="one-way" x1="40" y1="25" x2="60" y2="25"/><circle id="goal" cx="80" cy="20" r="1"/>
    <rect class="keep-out" x="70" y="10" width="20" height="20"/>"""
    path = tmp_path / "two.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" fill="none" stroke="black">{body}</svg>')
    found = {one.kind: one for one in pilotage.check(open_map(path))}

    assert (40.0, 50.0) == pytest.approx(found["idle-arrow"].where)
    assert "the goal lies in a keep-out zone" in found["bad-goal"].text


def test_thousands_of_open_ends_are_joined_without_a_table_of_all_pairs():
    spots = np.stack(np.meshgrid(np.arange(70.0), np.arange(70.0)), axis=-1).reshape(-1, 2).tolist()
    ticks = [[(4 * x, 4 * y), (4 * x + 1, 4 * y)] for x, y in spots]
    sketch = drawing(*ticks, [(2, 2), (2, 3.5)])
    tracemalloc.start()
    mend = join_open_ends(sketch)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()

    assert mend is not None
    assert {(2.0, 3.5)} < set(mend.segment)
    assert peak < 100e6  # [bytes]; a table of all pairs has more than a gigabyte


def test_the_gap_of_a_stroke_around_a_room_is_closed_and_no_straight_stroke_along_itself():
    around = [(0, 0), (9, 0), (9, 6), (0, 6), (0, 1)]
    mend = join_open_ends(drawing(around, [(4, 3), (4.5, 3)]))

    assert mend is not None
    assert {(0.0, 0.0), (0.0, 1.0)} == set(mend.segment)


def test_an_end_on_the_middle_of_a_wall_is_not_open():
    mend = join_open_ends(drawing([(0, 0), (9, 0)], [(4, 0), (4, 2)], [(4, 5), (8, 5)], [(4.5, 0), (4.5, 2)]))

    assert mend is not None
    assert {(4.0, 2.0), (4.5, 2.0)} == set(mend.segment)
