"""Figures show what they were given; how they look is for eyes to judge."""

import math

import numpy as np
import pytest

from knowing import estimate_of, hypothesis_at
from pilotage import open_map, worlds
from pilotage.errors import FileError
from pilotage.figures.drawing import drawing_figure
from pilotage.figures.path import path_figure
from pilotage.figures.scan import scan_figure
from pilotage.figures.style import new_figure, save
from pilotage.geometry import Polyline, Pose2
from pilotage.localization import Explanation, Status, WallEvidence
from pilotage.maps import Label, SchematicMap
from pilotage.perception import LaserScan, PerceptionSettings, perceive
from pilotage.shape import Simplification, simplify_all


def scan_of(ranges):
    return LaserScan(0.0, -math.pi / 2, math.pi / 180, np.array(ranges), range_max=30.0)


def estimate(k, *, status=Status.LOCATED, x=0.0, rivals=()):
    here = Pose2(100.0 + x + 3.0 * k, -200.0, 0.0)
    poses = [here, *(Pose2(rival, -300.0, 0.0) for rival in rivals)]
    shares = [0.5, *(0.2 for _ in rivals)]
    hypotheses = [
        hypothesis_at(pose, scale=20.0, cell_id="c1", probability=share)
        for pose, share in zip(poses, shares, strict=True)
    ]
    return estimate_of(*hypotheses, stamp=float(k), status=status)


@pytest.mark.parametrize(
    "ranges",
    [
        np.full(181, np.inf),
        np.full(181, np.nan),
        np.full(181, 2.0),
        [3.0],
        [np.inf, 2.0, 2.1, np.inf],
        np.concatenate([np.full(90, 2.0), np.full(91, 4.0)]),
    ],
)
def test_any_scan_can_be_drawn(tmp_path, ranges):
    scan = scan_of(ranges)
    save(scan_figure(scan, perceive(scan, PerceptionSettings())), tmp_path / "scan.png")

    assert (tmp_path / "scan.png").exists()


@pytest.mark.parametrize(
    "stroke", [[(0, 0), (1, 0)], [(0, 0), (0, 5)], [(0, 0), (100, 1)], [(0, 0), (1, 90), (2, 0)]]
)
def test_a_drawing_of_any_proportions_can_be_drawn(tmp_path, stroke):
    sketch = SchematicMap((Polyline.through(stroke),))
    save(drawing_figure(sketch, sketch.strokes), tmp_path / "drawing.png")
    save(path_figure(sketch, [estimate(0)]), tmp_path / "path.png")

    assert (tmp_path / "drawing.png").exists()
    assert (tmp_path / "path.png").exists()


def test_the_titles_count_vertices():
    sketch = open_map(worlds.OFFICE.quick)
    evolved = simplify_all(sketch.strokes, Simplification(0.0025 * sketch.diagonal))
    before, after = drawing_figure(sketch, evolved).axes

    assert f"{sum(map(len, sketch.strokes))} vertices" in before.get_title(loc="left")
    assert f"{sum(map(len, evolved))} vertices" in after.get_title(loc="left")


def test_words_are_drawn_as_they_are_written(tmp_path):
    words = ("$5 room$", "a_b^{", "厨房", "%s\\n")
    labels = tuple(Label(word, (10.0 * k, 5.0)) for k, word in enumerate(words))
    sketch = SchematicMap((Polyline.through([(0, 0), (40, 0), (40, 9)]),), labels=labels)
    save(drawing_figure(sketch, sketch.strokes), tmp_path / "drawing.png")
    save(path_figure(sketch, [estimate(0)], title="$x_1$ in {y}"), tmp_path / "path.png")

    assert (tmp_path / "path.png").exists()


def legend_of(figure):
    return [text.get_text() for text in figure.legends[0].get_texts()]


def test_a_path_shows_lost_parts_and_rivals_apart():
    sketch = open_map(worlds.OFFICE.quick)
    run = [estimate(0, status=Status.LOST), *(estimate(k) for k in range(1, 9)), estimate(9, rivals=(500.0,))]
    words = legend_of(path_figure(sketch, run, truth=np.array([[1.0, 2.0], [3.0, 4.0]])))

    assert "best guess, while lost" in words
    assert "other places held possible" in words
    assert "true path" in words


def test_a_path_without_doubt_shows_none():
    words = legend_of(path_figure(open_map(worlds.OFFICE.quick), [estimate(k) for k in range(9)]))

    assert "best guess, while lost" not in words
    assert "other places held possible" not in words
    assert "true path" not in words


def test_a_jump_is_not_drawn_as_a_motion():
    run = [estimate(0), estimate(1), estimate(2, x=400.0), estimate(3, x=400.0)]
    figure = path_figure(open_map(worlds.OFFICE.quick), run)
    (lines,) = figure.axes[0].collections[:1]

    assert 2 == len(lines.get_segments())


def test_what_was_seen_last_has_a_view_of_its_own():
    sketch = open_map(worlds.OFFICE.quick)
    without = path_figure(sketch, [estimate(0)])
    seen = path_figure(sketch, [estimate(0)], local_map=[Polyline.through([(1, 1), (2, 1)])])

    assert 1 + len(without.axes) == len(seen.axes)


def test_walls_in_view_are_colored_by_what_they_say():
    walls = tuple(
        WallEvidence(np.array([[0.0, y], [9.0, y]]), 5, 0.1, shown, through)
        for y, shown, through in ((0.0, 0.7, 0.1), (5.0, 0.6, 0.1), (9.0, 0.1, 0.8))
    )
    figure = path_figure(open_map(worlds.OFFICE.quick), [estimate(0)], explanation=Explanation("hall", walls))

    words = legend_of(figure)
    assert "wall: seen where drawn" in words
    assert "wall: looked through" in words
    assert "wall: hidden by something nearer" not in words


def test_a_path_of_nothing_is_refused():
    with pytest.raises(ValueError, match="at least one estimate"):
        path_figure(open_map(worlds.OFFICE.quick), [])


def test_a_figure_of_unknown_kind_is_refused(tmp_path):
    with pytest.raises(FileError, match="must end in"):
        save(new_figure(1.0, 1.0), tmp_path / "figure")
