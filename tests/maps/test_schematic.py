"""Drawings as in a mirror."""

from dataclasses import replace

import numpy as np
import pytest
import shapely

from pilotage.geometry import Polyline
from pilotage.io import open_map
from pilotage.maps import DecompositionSettings, Label, SchematicMap, decompose
from pilotage.maps.zones import Zones
from pilotage.worlds import OFFICE


@pytest.fixture(scope="module")
def office():
    return open_map(OFFICE.quick)


def test_a_mirror_image_of_a_mirror_image_is_the_drawing(office):
    twice = office.mirrored().mirrored()

    assert twice.segments == pytest.approx(office.segments)
    assert office.bounds == pytest.approx(office.mirrored().bounds)
    assert [label.text for label in office.labels] == [label.text for label in twice.labels]
    assert twice.file_from_sketch(office.segments[:, :2]) == pytest.approx(
        office.file_from_sketch(office.segments[:, :2])
    )


def test_zones_are_mirrored_and_arrows_point_as_before(office):
    ring, arrow = (Polyline.through(points) for points in ([(0, 0), (4, 0), (4, 2)], [(1, 1), (1, 9)]))
    zones = replace(office, zones=Zones(keep_out=(ring,), one_way=(arrow,))).mirrored().zones
    left, _, right, _ = office.bounds

    assert zones.keep_out[0].vertices[:, 0] == pytest.approx(left + right - ring.vertices[:, 0])
    assert zones.one_way[0].vertices.tolist() == [[left + right - 1, 1], [left + right - 1, 9]]


def test_rooms_keep_their_names_and_places_in_the_file(office):
    graph, other = (decompose(sketch, DecompositionSettings()) for sketch in (office, office.mirrored()))
    ana, mirrored = (next(cell for cell in found.cells if cell.label == "Ana") for found in (graph, other))

    assert len(graph.cells) == len(other.cells)
    assert ana.polygon.area == pytest.approx(mirrored.polygon.area, rel=0.02)
    there = office.mirrored().file_from_sketch(np.array([mirrored.center]))
    assert ana.polygon.covers(shapely.Point(office.sketch_from_file(there)[0]))


def test_all_that_is_drawn_and_marked_is_carried():
    line = Polyline.through([(1.0, 2.0), (3.0, 4.0)])
    zones = Zones(*((line,) for _ in Zones().lines))
    sketch = SchematicMap(
        (line,), (1.0, 1.0), (2.0, 2.0), (Label("hall", (3.0, 3.0), told=True),), solids=(line,), zones=zones,
        doors=(line,), openings=(line,), unread=((4.0, 4.0),),
    )  # fmt: skip
    far = 1000.0
    carried = sketch.carried(
        lambda one: Polyline(one.vertices + far, one.closed), lambda one: (one[0] + far, one[1] + far)
    )

    lines = [*carried.strokes, *carried.solids, *carried.doors, *carried.openings]
    lines += [one for some in carried.zones.lines for one in some]
    places = [carried.start, carried.goal, carried.labels[0].position, *carried.unread]
    assert 4 + len(Zones().lines) == len(lines)
    assert carried.labels[0].told
    assert np.vstack([one.vertices for one in lines]).min() > far
    assert np.array(places).min() > far
