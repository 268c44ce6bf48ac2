import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pilotage.geometry import Polyline
from pilotage.interpretation.arcs import find_arcs
from strategies import angles, coordinates


def circle(center, radius, start, sweep, chords):
    """Vertices of a part of a circle; angles in radians."""
    along = start + sweep * np.linspace(0.0, 1.0, chords + 1)
    return np.array(center) + radius * np.column_stack([np.cos(along), np.sin(along)])


@given(
    center=st.tuples(coordinates, coordinates),
    radius=st.floats(0.5, 20.0),
    start=angles,
    degrees=st.floats(55.0, 125.0) | st.floats(-125.0, -55.0),
    chords=st.integers(4, 40),
)
def test_an_arc_is_found_with_its_center_radius_and_sweep(center, radius, start, degrees, chords):
    points = circle(center, radius, start, np.radians(degrees), chords)

    ((arc, _),) = find_arcs([Polyline(points)])

    assert arc.center == pytest.approx(center, abs=1e-6 * radius)
    assert arc.radius == pytest.approx(radius, rel=1e-6)
    assert arc.sweep == pytest.approx(np.radians(abs(degrees)), rel=1e-6)
    assert arc.ends == pytest.approx(points[[0, -1]])


@given(radius=st.floats(1.0, 20.0), start=angles, seed=st.integers(0, 2**31))
def test_a_wavering_hand_moves_the_circle_no_farther_than_its_own_strays(radius, start, seed):
    points = circle((0.0, 0.0), radius, start, np.radians(90.0), 8)
    strays = np.random.default_rng(seed).uniform(-0.005, 0.005, points.shape) * radius

    ((arc, _),) = find_arcs([Polyline(points + strays)])

    assert np.hypot(*arc.center) < 0.06 * radius
    assert arc.radius == pytest.approx(radius, rel=0.06)


def test_an_arc_is_found_at_the_end_of_its_leaf():
    leaf = np.array([[0.0, 0.0], [10.0, 0.0]])

    ((arc, _),) = find_arcs([Polyline(np.vstack([leaf, circle((0, 0), 10.0, 0.0, np.pi / 2.0, 9)[1:]]))])

    assert arc.center == pytest.approx([0.0, 0.0], abs=0.5)
    assert arc.radius == pytest.approx(10.0, rel=0.05)


@given(
    hinge=st.tuples(coordinates, coordinates),
    radius=st.floats(0.5, 20.0),
    start=angles,
    turn=st.sampled_from([-1.0, 1.0]),
    chords=st.integers(4, 40),
)
def test_a_quadratic_curve_around_a_corner_is_the_quarter_circle_about_the_hinge(
    hinge, radius, start, turn, chords
):
    first, last = radius * circle((0.0, 0.0), 1.0, start, turn * np.pi / 2.0, 1)
    t = np.linspace(0.0, 1.0, chords + 1)[:, None]
    curve = hinge + (1 - t) ** 2 * first + 2 * t * (1 - t) * (first + last) + t**2 * last

    ((arc, _),) = find_arcs([Polyline(curve)])

    assert arc.center == pytest.approx(hinge, abs=1e-6 * (1.0 + radius))
    assert arc.radius == pytest.approx(radius, rel=1e-6)
    assert arc.sweep == pytest.approx(np.pi / 2.0)


def test_vertices_drawn_twice_do_not_matter():
    points = circle((1, 2), 3.0, 0.5, np.pi / 2.0, 8)

    ((arc, _),) = find_arcs([Polyline(np.repeat(points, 2, axis=0))])

    assert arc.center == pytest.approx([1.0, 2.0])


@pytest.mark.parametrize(
    "points",
    [
        circle((0, 0), 5.0, 0.0, 2.0 * np.pi, 24),  # a round table
        circle((0, 0), 5.0, 0.0, np.pi / 2.0, 2),  # a corner, cut off
        np.array([(0, 0), (10, 0), (10, 10), (0, 10)]),
        np.array([(0, 0), (5, 0), (10, 0), (20, 0)]),
        np.array([(0, 0), (1, 0)]),
    ],
    ids=["circle", "chamfer", "corners", "straight", "segment"],
)
def test_what_is_no_part_of_a_circle_is_no_arc(points):
    assert not list(find_arcs([Polyline(points.astype(float))]))


def test_arcs_of_many_lines_are_found_as_in_each_alone():
    arc = circle((0.0, 0.0), 10.0, 0.0, np.pi / 2.0, 8)
    lines = [Polyline(arc), Polyline(arc[::-1]), Polyline(arc[:2]), Polyline(arc[:1] * [[1.0], [2.0]])]

    found = list(find_arcs(lines))

    assert [number for _, number in found] == [0, 1]
    for arc, number in found:
        ((alone, _),) = find_arcs([lines[number]])
        assert arc.center.tolist() == alone.center.tolist()
        assert arc.vertices.tolist() == alone.vertices.tolist()
