"""Laws of the corrected drawing."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from buildings import WALLS, coarse, scan_at, walk
from pilotage.correction import NothingBelievedError, PassageState, Sighting, correct_drawing
from pilotage.correction.passages import state_of
from pilotage.correction.sighting import surface_normals
from pilotage.geometry import Affine2, Polyline, Pose2, fit_similarity
from pilotage.localization import Estimate, PoseHypothesis, Status
from pilotage.maps import SchematicMap, build_atlas

STRETCHES = st.floats(0.7, 1.4)


def drawn(sketch_from_world):
    """Draw the flat by any map of points."""
    strokes = []
    for wall in WALLS:
        ring = wall.ring
        shares = np.linspace(0.0, 1.0, 9)[:-1, None]
        points = [a + shares * (b - a) for a, b in itertools.pairwise(ring)]
        strokes.append(Polyline(sketch_from_world(np.vstack([*points, ring[-1:]]))))
    return build_atlas(SchematicMap(tuple(strokes)), coarse())


def around(sketch_from_world, pose):
    """Return the affine map from the robot's frame to the drawing that touches a map at a pose."""
    x, y, ahead, aside = sketch_from_world(pose @ np.array([[0, 0], [0, 0], [1e-4, 0], [0, 1e-4]]))
    return Affine2(np.column_stack([ahead - x, aside - x]) * 1e4, (x + y) / 2.0)


def sightings(sketch_from_world, probability=0.9, *, see=True):
    """Walk through the true flat and look around, each place estimated as it is."""
    found = []
    for number, pose in enumerate(walk()[::2]):
        hypothesis = PoseHypothesis("", around(sketch_from_world, pose), probability)
        estimate = Estimate(0.0, Status.LOCATED, (hypothesis,), probability, 1.0, "")
        scan = scan_at(pose, fov=1.5 * math.pi, beams=271)
        if not see:
            scan = type(scan)(0.0, scan.angle_min, scan.angle_increment, np.full(271, np.inf))
        found.append(Sighting.of(scan, pose, 0.5 * number, estimate))
    return found


def distances(corrected, sketch_from_world):
    """Measure how far the corrected walls are from the true ones, place by place [m]."""
    places = np.vstack(
        [wall.ring[:-1] + k * np.diff(wall.ring, axis=0) for wall in WALLS for k in (0.3, 0.7)]
    )
    found = corrected.metres_from_sketch @ sketch_from_world(places)
    return np.hypot(*(fit_similarity(found, places, rigid=True) @ found - places).T)


@settings(max_examples=3)
@given(st.floats(-3.0, 3.0), st.floats(0.5, 50.0))
def test_without_evidence_a_drawing_keeps_its_shape(angle, scale):
    pose = Pose2(20.0, -5.0, angle)

    def draw(points):
        return pose @ (scale * points)

    corrected = correct_drawing(drawn(draw), sightings(draw, see=False))

    assert distances(corrected, draw).max() < 0.02
    assert corrected.scale == pytest.approx(scale, rel=1e-3)
    assert corrected.seen == ()


@settings(max_examples=3)
@given(STRETCHES, STRETCHES)
def test_wrong_proportions_are_found(wide, high):
    def draw(points):
        return 10.0 * points * (wide, high)

    corrected = correct_drawing(drawn(draw), sightings(draw))

    assert distances(corrected, draw).mean() < 0.08
    assert corrected.seen_share > 0.6


@settings(max_examples=3)
@given(st.floats(-0.05, 0.05), st.floats(-0.05, 0.05))
def test_a_smooth_warp_is_found(bend_x, bend_y):
    def draw(points):
        x, y = points.T
        return 10.0 * np.column_stack([x + bend_x * x * y, y + bend_y * (x - 5.0) ** 2 / 2.0])

    corrected = correct_drawing(drawn(draw), sightings(draw))

    assert distances(corrected, draw).mean() < 0.12


def test_scans_correct_what_the_estimates_get_wrong():
    def draw(points):
        x, y = points.T
        return 10.0 * np.column_stack([np.where(x > 6.0, 6.0 + 1.4 * (x - 6.0), x), y])

    def believed(points):
        return 10.0 * points * (1.1, 1.0)

    corrected = correct_drawing(drawn(draw), sightings(believed))
    drawing_alone = correct_drawing(drawn(draw), sightings(believed, see=False))

    assert distances(corrected, draw).mean() < 0.5 * distances(drawing_alone, draw).mean()


@settings(max_examples=3)
@given(st.floats(-3.0, 3.0))
def test_turning_the_sheet_turns_the_result(angle):
    pose = Pose2(3.0, 4.0, angle)

    def upright(points):
        return 10.0 * points * (1.2, 0.9)

    def turned(points):
        return pose @ upright(points)

    one = correct_drawing(drawn(upright), sightings(upright))
    other = correct_drawing(drawn(turned), sightings(turned))

    points = np.vstack([stroke.vertices for stroke in drawn(upright).sketch.strokes])
    found = one.metres_from_sketch @ points, other.metres_from_sketch @ (pose @ points)
    turned_back = found[1] @ Pose2(0.0, 0.0, angle).rotation
    assert found[0] - found[0].mean(axis=0) == pytest.approx(turned_back - turned_back.mean(axis=0), abs=0.01)


def test_seen_and_unseen_stretches_are_all_of_the_strokes():
    def draw(points):
        return 10.0 * points

    corrected = correct_drawing(drawn(draw), sightings(draw))

    lengths = [sum(line.length for line in lines) for lines in (corrected.seen, corrected.unseen)]
    assert sum(lengths) == pytest.approx(sum(stroke.length for stroke in corrected.sketch.strokes), rel=0.01)
    assert min(lengths) > 0.0


@pytest.mark.parametrize("probability", [0.0, 0.49])
def test_what_is_not_believed_is_not_used(probability):
    with pytest.raises(NothingBelievedError, match=r"at least probability 0\.5, got 0"):
        correct_drawing(drawn(lambda points: points), sightings(lambda points: points, probability))


def test_normals_point_to_the_laser():
    scan = scan_at(Pose2(2.0, 2.0, 0.5), fov=1.5 * math.pi, beams=271)

    normals, counts = surface_normals(scan.points_in_base, np.zeros(2))

    assert counts.mean() > 0.7
    assert np.hypot(*normals[counts].T) == pytest.approx(1.0)
    assert ((normals * scan.points_in_base).sum(axis=1)[counts] < 0.0).all()


def test_a_gateway_is_open_if_beams_go_through_and_closed_if_they_end_there():
    segment = np.array([[0.0, -0.5], [0.0, 0.5]])
    across = np.linspace(-0.45, 0.45, 20)
    lasers, still = np.column_stack([np.full(20, -2.0), across]), np.array([[-2.0, 0.0]])

    assert state_of(segment, lasers, lasers + np.array([5.0, 0.0]), still) is PassageState.OPEN
    assert state_of(segment, lasers, lasers + np.array([2.05, 0.0]), still) is PassageState.CLOSED
    assert state_of(segment, lasers, lasers + np.array([1.0, 0.0]), still) is PassageState.UNSEEN


def test_a_gateway_is_open_if_the_robot_went_through_it():
    segment = np.array([[0.0, -0.5], [0.0, 0.5]])
    lasers = np.column_stack([np.full(20, -2.0), np.linspace(-0.45, 0.45, 20)])
    through, past = np.array([[-1.0, 0.7], [1.0, 0.7]]), np.array([[-1.0, 3.0], [1.0, 3.0]])

    assert state_of(segment, lasers, lasers + np.array([2.05, 0.0]), through) is PassageState.OPEN
    assert state_of(segment, lasers, lasers + np.array([2.05, 0.0]), past) is PassageState.CLOSED


def test_places_that_contradict_each_other_are_not_used():
    def draw(points):
        return 10.0 * points

    def elsewhere(points):
        return draw(points) + 200.0

    seen, wrong = sightings(draw), sightings(elsewhere)
    mixed = [wrong[k] if k % 2 else seen[k] for k in range(len(seen))]

    with pytest.raises(NothingBelievedError, match="must agree"):
        correct_drawing(drawn(draw), mixed)


def test_a_fault_of_the_fit_is_not_told_as_a_want_of_belief(monkeypatch):
    e = np.empty((0, 2))
    at = Affine2.from_state(1.0, 2.0, 0.0, 0.0, 0.0, 0.0)
    standing = [Sighting(Pose2.identity(), 0.0, e, e, e, e, (0.0, 0.0), at, 0.9)] * 12
    atlas = build_atlas(SchematicMap(WALLS), coarse())
    with pytest.raises(NothingBelievedError, match="must not be one and the same"):
        correct_drawing(atlas, standing)

    def failing(*_):
        raise ValueError("the fit is at fault")

    monkeypatch.setattr("pilotage.correction.correct.fit", failing)
    with pytest.raises(ValueError, match="the fit is at fault"):
        correct_drawing(atlas, standing)
