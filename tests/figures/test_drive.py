"""A drive as a figure and as a moving picture."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from PIL import Image, ImageSequence

from made_up_drive import GATEWAY, GRAPH, SECOND, SKETCH, moment, through_the_door
from pilotage.figures.animation import LEAST_STEP, MOST_FRAMES, animate, caption_of, chosen_frames
from pilotage.figures.drive import drive_figure, passed_gateways
from pilotage.figures.style import save
from pilotage.figures.trail import find_stretches
from pilotage.figures.words import describe
from pilotage.geometry import Polyline
from pilotage.localization import Status
from pilotage.maps import Label
from pilotage.navigation import Behavior

DRIVE = through_the_door()


def durations_in(path):
    """List how long each frame of a moving picture is shown [ms]."""
    with Image.open(path) as picture:
        return [frame.info["duration"] for frame in ImageSequence.Iterator(picture)]


def test_stretches_are_of_one_kind_and_hang_together():
    positions = np.array([scene.world_from_base.position for scene in DRIVE.scenes])
    stretches = find_stretches(DRIVE.steps, positions)

    assert [Behavior.LOOK_AROUND, Behavior.CROSS, Behavior.REST] == [one.behavior for one in stretches]
    assert [False, True, True] == [one.located for one in stretches]
    assert [0, 10, 70] == [one.first for one in stretches]
    assert (stretches[0].points[-1] == stretches[1].points[0]).all()


def test_a_jump_is_left_open():
    moments = [moment(k, x=x) for k, x in enumerate([1.0, 1.1, 6.0, 6.1])]
    positions = np.array([step.estimate.sketch_from_base.pose.position for step, _ in moments])
    stretches = find_stretches([step for step, _ in moments], positions, jump=2.0)

    assert [[1.0, 1.1], [6.0, 6.1]] == [one.points[:, 0].tolist() for one in stretches]


def test_the_gateway_to_the_next_cell_was_passed_once_that_cell_is_claimed():
    assert (GATEWAY.gateway_id,) == passed_gateways(DRIVE.steps)
    assert () == passed_gateways(DRIVE.steps[:20])


def test_the_figure_shows_both_sides_and_explains_what_occurs(tmp_path):
    figure = drive_figure(DRIVE, "The robot reached its goal")
    words = [text.get_text() for legend in figure.legends for text in legend.get_texts()]
    save(figure, tmp_path / "drive.png")

    assert 2 == len(figure.axes)
    assert {"look around", "cross", "rest", "goal"} <= set(words)
    assert "explore" not in words
    assert (tmp_path / "drive.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("lost", [True, False])
def test_a_drive_of_one_step_without_cells_can_be_drawn(lost, tmp_path):
    step, scene = moment(0, x=1.0, lost=lost)
    drive = replace(DRIVE, steps=(step,), scenes=(scene,), graph=None)
    drive_figure(drive)
    animate(drive, tmp_path / "drive.gif")

    assert 1 == len(durations_in(tmp_path / "drive.gif"))


def test_a_gateway_found_closed_is_crossed_out():
    last = replace(DRIVE.steps[-1], closed_gateway_ids=(GATEWAY.gateway_id,))
    plain, crossed = (
        len(drive_figure(replace(DRIVE, steps=(*DRIVE.steps[:-1], end))).axes[0].collections)
        for end in (DRIVE.steps[-1], last)
    )

    assert crossed == plain + 1


def test_steps_and_scenes_belong_together():
    with pytest.raises(ValueError, match="at least one step"):
        replace(DRIVE, steps=(), scenes=())
    with pytest.raises(ValueError, match="each step needs its scene"):
        replace(DRIVE, steps=DRIVE.steps[1:])


def test_an_animation_has_its_frames_and_rests_on_the_last(tmp_path):
    animate(DRIVE, tmp_path / "drive.gif")
    durations = durations_in(tmp_path / "drive.gif")

    assert round(DRIVE.times[-1] / LEAST_STEP) + 1 == len(durations)
    assert durations[0] < durations[-1]


def test_an_animation_shows_names_in_scripts_that_no_font_has(tmp_path):
    hieroglyph = "\U00013000"
    sketch = replace(SKETCH, labels=(Label(hieroglyph, (1.0, 2.5)),))
    end = replace(DRIVE.steps[-1], reason=f"'{hieroglyph}' is reached")
    drive = replace(DRIVE, sketch=sketch, steps=(*DRIVE.steps[:-1], end))
    animate(drive, tmp_path / "drive.gif")  # a warning would fail

    assert hieroglyph in caption_of(drive, len(drive.steps) - 1)


@pytest.mark.parametrize("seconds", [0.0, 0.1, 3.0, 99.9, 1800.0])
def test_frames_are_few_and_hold_the_first_and_last_step(seconds):
    times = np.arange(0.0, seconds + 0.05, 0.1)
    chosen = chosen_frames(times)

    assert 0 == chosen[0]
    assert len(times) - 1 == chosen[-1]
    assert len(chosen) <= MOST_FRAMES
    assert all(a < b for a, b in pairwise(chosen))


def test_a_line_says_what_goes_on():
    step, _ = moment(10, x=1.0)
    words = describe(step, 65.0, GRAPH)

    assert words.startswith("1:05   cross   in ")
    assert f"next {SECOND}" in words
    assert words.endswith("4 m to go")
    assert "lost, perhaps in" in describe(moment(0, x=1.0, lost=True)[0], 0.0, None)


def test_a_drawing_that_does_not_fit_is_said_and_no_place_is_named():
    step, _ = moment(10, x=1.0)
    wrong = replace(step, estimate=replace(step.estimate, status=Status.MISMATCH))

    assert "the drawing does not fit" in describe(wrong, 0.0, GRAPH)
    assert step.estimate.cell_id not in describe(replace(wrong, next_cell_id=""), 0.0, GRAPH)


def test_the_last_caption_says_how_it_ended():
    last = replace(DRIVE.steps[-1], reason="there")

    assert "0:07   reached: there" == caption_of(replace(DRIVE, steps=(*DRIVE.steps[:-1], last)), 70)


def test_the_drawing_may_be_flat():
    flat = replace(SKETCH, strokes=(Polyline.through([(0, 0), (100, 0), (100, 1)]),))

    assert 2 == len(drive_figure(replace(DRIVE, sketch=flat, graph=None)).axes)
