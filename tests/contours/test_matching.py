import math

import numpy as np
import pytest
from hypothesis import assume, given

import strategies
from pilotage.contours import Matching, match_partial, match_partial_near
from pilotage.contours.tangent import turns
from pilotage.geometry import Polyline, Pose2, Span
from pilotage.shape import EndCause, PartialShape

SETTINGS = Matching()
NICHE = [(0, 6), (0, 0), (2, 0), (2, -1), (3, -1), (3, 0), (8, 0), (8, 6)]


@strategies.st.composite
def shapes(draw):
    """An open polyline of at least two segments that do not fold."""
    polyline = draw(strategies.polylines(min_size=3, max_size=6, closed=False))
    assume(polyline.segment_lengths.min() > 0.1)
    assume((np.abs(turns(polyline)) < math.pi - 1e-3).all())
    return PartialShape(polyline)


def assert_poses_equal(actual, expected):
    difference = expected.inverse() @ actual

    assert (difference.x, difference.y, difference.theta) == pytest.approx((0.0, 0.0, 0.0), abs=1e-6)


@given(shapes(), strategies.poses)
def test_a_shape_is_found_whole_in_itself_at_the_pose_it_was_moved_to(shape, known_from_seen):
    best = match_partial(shape, shape.moved(known_from_seen), SETTINGS)[0]

    assert (best.seen, best.known) == (Span(0, len(shape.polyline) - 1),) * 2
    assert best.cost == pytest.approx(-SETTINGS.reward * shape.polyline.length)
    assert_poses_equal(best.known_from_seen, known_from_seen)


@given(shapes(), shapes(), strategies.poses)
def test_a_rigid_motion_of_either_moves_the_pose_and_changes_no_cost(seen, known, pose):
    before, after = match_partial(seen, known, SETTINGS), match_partial(seen.moved(pose), known, SETTINGS)

    assert len(before) == len(after)
    assert [match.cost for match in after] == pytest.approx([match.cost for match in before], abs=1e-6)


@given(shapes(), shapes())
def test_either_may_be_the_one_seen(seen, known):
    there, back = match_partial(seen, known, SETTINGS)[:1], match_partial(known, seen, SETTINGS)[:1]

    assert [match.cost for match in back] == pytest.approx([match.cost for match in there], abs=1e-6)


@given(shapes(), shapes())
def test_running_both_the_other_way_changes_no_cost(seen, known):
    there = match_partial(seen, known, SETTINGS)[:1]
    back = match_partial(seen.reversed(), known.reversed(), SETTINGS)[:1]

    assert [match.cost for match in back] == pytest.approx([match.cost for match in there], abs=1e-6)


def test_a_wall_seen_in_part_is_matched_in_part_where_its_end_goes_on():
    """From the room's left wall only 2.5 m are seen, and 3 m of the long wall behind the niche."""
    known = PartialShape(Polyline.through(NICHE))
    part = Polyline.through([(0, 2.5), *NICHE[1:6], (6, 0)])

    (best, *_) = match_partial(PartialShape(part, EndCause.OCCLUDED, EndCause.FIELD_LIMIT), known, SETTINGS)

    assert (best.seen, best.known.first, best.known.last) == (Span(0, 6), 0, 6)
    assert (best.known.trim_first, best.known.trim_last) == pytest.approx((3.5 / 6, 2 / 5))
    assert best.length == pytest.approx(part.length)
    assert_poses_equal(best.known_from_seen, Pose2.identity())


def test_a_wall_that_truly_ends_is_not_taken_for_a_part_of_a_longer_one():
    known = PartialShape(Polyline.through(NICHE))
    part = Polyline.through([(0, 2.5), *NICHE[1:6]])

    edge = match_partial(PartialShape(part, EndCause.OCCLUDING), known, SETTINGS)[0]
    hidden = match_partial(PartialShape(part, EndCause.OCCLUDED), known, SETTINGS)[0]

    assert hidden.cost < edge.cost
    assert edge.known.trim_first == 0.0


def test_the_end_of_what_is_known_may_go_on_as_well():
    known = PartialShape(Polyline.through(NICHE[:3]), last_end=EndCause.RANGE_LIMIT)
    seen = PartialShape(Polyline.through([(0, 6), (0, 0), (5, 0)]))

    best = match_partial(seen, known, SETTINGS)[0]

    assert best.seen.trim_last == pytest.approx(3 / 5)
    assert best.known == Span(0, 2)


def test_vertices_that_fit_nothing_are_dropped_at_the_ends():
    seen = PartialShape(Polyline.through([(-3, 4), (-2, 1), *NICHE[1:6], (4, 3)]))

    best = match_partial(seen, PartialShape(Polyline.through(NICHE)), SETTINGS)[0]

    assert (best.seen, best.known) == (Span(2, 6), Span(1, 5))


def test_a_gap_newly_seen_between_two_cupboards_is_bridged():
    before = PartialShape(Polyline.through([(0, 4), (0, 0), (6, 0), (6, 4)]))
    after = PartialShape(
        Polyline.through([(0, 4), (0, 0), (3, 0), (3, -0.2), (3.1, -0.2), (3.1, 0), (6, 0), (6, 4)])
    )

    best = match_partial(after, before, Matching(reward=0.25))[0]

    assert (best.seen, best.known) == (Span(0, 7), Span(0, 3))


def test_trimming_does_not_end_at_a_lone_pair_of_segments():
    """What the reward for length mends: as printed, the best match of all is any one pair of segments."""
    wavy = np.array(NICHE) + np.random.default_rng(3).normal(0.0, 0.02, (len(NICHE), 2))

    best = match_partial(PartialShape(Polyline(wavy)), PartialShape(Polyline.through(NICHE)), SETTINGS)[0]

    assert (best.seen, best.known) == (Span(0, 7), Span(0, 7))


def test_of_two_places_alike_the_one_near_the_estimate_comes_first():
    niches = Polyline.through(
        [(0, 0), (2, 0), (2, -1), (3, -1), (3, 0), (9, 0), (9, -1), (10, -1), (10, 0), (12, 0)]
    )
    seen = PartialShape(Polyline.through([(1, 0), (1, -1), (2, -1), (2, 0)]))

    for offset, expected in ((1.3, Span(1, 4)), (7.6, Span(5, 8))):
        best = match_partial_near(seen, PartialShape(niches), Pose2(offset, 0.2, 0.3), SETTINGS)[0]
        assert best.known == expected


def test_a_closed_contour_is_matched_across_its_first_vertex():
    pillar = PartialShape(Polyline.through([(0, 0), (0, 1), (2, 1), (3, 0)], closed=True))
    seen = PartialShape(Polyline.through([(2, 1), (3, 0), (0, 0), (0, 1)]))

    best = match_partial(seen, pillar, SETTINGS)[0]

    assert best.known == Span(2, 5)
    assert_poses_equal(best.known_from_seen, Pose2.identity())


def test_repeated_vertices_do_not_disturb():
    niche = PartialShape(Polyline.through(NICHE))
    twice = PartialShape(Polyline(np.repeat(niche.polyline.vertices, 2, axis=0)))

    best = match_partial(twice, niche, SETTINGS)[0]

    assert (best.seen, best.known) == (Span(1, 14), Span(0, 7))


def test_shapes_with_nothing_in_common_do_not_match():
    hair_pin = PartialShape(Polyline.through([(0, 0), (1, 0), (0, 0.1)]))
    corner = PartialShape(Polyline.through([(0, 0.3), (0, 0), (0.3, 0)]))

    assert match_partial(hair_pin, corner, SETTINGS) == ()


@pytest.mark.parametrize(
    "settings_", [{"reward": 0.0}, {"displacement_weight": -1.0}, {"min_length": math.nan}, {"count": 0}]
)
def test_settings_that_cannot_be_meant_are_refused(settings_):
    with pytest.raises(ValueError, match=f"{next(iter(settings_))} must be"):
        Matching(**settings_)
