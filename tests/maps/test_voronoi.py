import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from pilotage.maps.cells.narrowings import find_chords
from pilotage.maps.cells.voronoi import are_planar, find_voronoi, snap

FRAME = [(-20, -20, 20, -20), (20, -20, 20, 20), (20, 20, -20, 20), (-20, 20, -20, -20)]
numbers = st.floats(-10.0, 10.0).map(lambda value: round(value, 2))
segment_lists = st.lists(
    st.tuples(numbers, numbers, numbers, numbers).filter(lambda s: s[:2] != s[2:]), min_size=1, max_size=12
)


def framed(segments):
    return np.array([*segments, *FRAME], dtype=np.float64)


@settings(max_examples=40)
@given(segment_lists)
def test_segments_that_were_snapped_meet_at_their_ends_only(segments):
    assert are_planar(snap(np.array(segments), 1e-3))


@settings(max_examples=40)
@given(segment_lists)
def test_clearance_is_the_distance_to_the_nearest_wall(segments):
    """Oracle: measure to every wall."""
    walls = framed(segments)
    diagram = find_voronoi(walls)
    used = np.unique(diagram.edges)
    lines = shapely.multilinestrings(list(walls.reshape(-1, 2, 2)))
    expected = shapely.distance(shapely.points(diagram.vertices[used]), lines)

    assert expected == pytest.approx(diagram.clearances[used], abs=1e-4)


@settings(max_examples=40)
@given(segment_lists)
def test_no_wall_comes_near_the_middle_of_a_chord(segments):
    """Oracle: measure from the middle of each chord to every wall; niches may be shallow."""
    walls = framed(segments)
    chords = find_chords(find_voronoi(walls))
    lines = shapely.multilinestrings(list(walls.reshape(-1, 2, 2)))
    room = shapely.distance(shapely.points(chords.segments.mean(axis=1)), lines)

    assert (shapely.distance(shapely.points(chords.segments.reshape(-1, 2)), lines) < 1e-4).all()
    assert (room > 0.2 * chords.widths - 1e-4).all()


@settings(max_examples=40)
@given(segment_lists)
def test_chords_do_not_cross(segments):
    chords = find_chords(find_voronoi(framed(segments))).segments
    shrunk = chords + 0.02 * (chords[:, ::-1] - chords)
    lines = shapely.linestrings(shrunk)
    first, second = shapely.STRtree(lines).query(lines, predicate="crosses")

    assert 0 == (first < second).sum()


def test_a_door_has_one_chord_and_it_joins_the_posts():
    walls = framed([(-20, 0, -1, 0), (1, 0, 20, 0)])
    chords = find_chords(find_voronoi(walls))
    doors = chords.segments[chords.widths < 3.0]

    assert [[-1.0, 0.0], [1.0, 0.0]] == pytest.approx(doors[0], abs=1e-4)
    assert 1 == len(doors)


def test_crossing_segments_are_cut_before_the_diagram_is_built():
    diagram = find_voronoi(framed([(-5, -5, 5, 5), (-5, 5, 5, -5)]))

    assert len(FRAME) + 4 == len(diagram.segments)


@pytest.mark.parametrize(
    ("segments", "rule"),
    [(np.empty((0, 4)), "at least one segment"), (np.ones((1, 4)), "more than one point")],
)
def test_nothing_to_build_from_is_refused(segments, rule):
    with pytest.raises(ValueError, match=rule):
        find_voronoi(segments)
