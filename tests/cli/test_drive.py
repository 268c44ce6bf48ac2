"""What is said of a drive, and how it ends when a person has seen enough."""

from dataclasses import replace

import pytest

from made_up_drive import GRAPH, through_the_door
from pilotage.cli.drive import EVERY, draw, follow, story
from pilotage.cli.exits import Stopped
from pilotage.drives import Instant
from pilotage.localization import Status
from pilotage.navigation import Outcome

DRIVE = through_the_door()
INSTANTS = [Instant(step, scene, 1.0) for step, scene in zip(DRIVE.steps, DRIVE.scenes, strict=True)]


def ended(**changes):
    """Return the drive with another last step."""
    return replace(DRIVE, steps=(*DRIVE.steps[:-1], replace(DRIVE.steps[-1], **changes)))


def test_a_goal_that_is_reached_is_told_with_what_it_took():
    told = story(DRIVE)

    assert told.startswith("After 4 m and 0:07 minutes the robot says that it stands at the goal, in x")
    assert told.endswith("It first claimed a place after 0:01 and touched nothing.")


def test_a_drive_that_is_given_up_says_why():
    told = story(ended(outcome=Outcome.GAVE_UP, reason="all doors are closed", times_lost=2))

    assert "the robot gave up: all doors are closed. It believes to be in x" in told
    assert "lost it 2 times" in told


def test_a_drawing_that_does_not_fit_is_said_and_no_place_is_claimed():
    told = story(ended(outcome=Outcome.MISMATCH, reason="this drawing does not fit this building"))

    assert "the robot gave up: this drawing does not fit this building. It first claimed" in told
    assert "believes" not in told


def test_what_speaks_against_having_reached_the_goal_is_said():
    last = DRIVE.steps[-1]
    doubtful = replace(last, distance=2.34, estimate=replace(last.estimate, status=Status.MISMATCH))
    told = story(replace(DRIVE, steps=(*DRIVE.steps[:-1], doubtful)))

    assert "It found no way nearer to it than 2.3 m." in told
    assert "drawings of other buildings explain the way better" in told


def test_a_room_that_is_reached_is_not_called_a_point():
    told = story(replace(DRIVE, goal=replace(DRIVE.goal, name="kitchen")))

    assert "the robot says that it stands in x" in told


def test_a_robot_that_never_knew_and_touched_something_says_so():
    steps, scenes = DRIVE.steps[:5], (*DRIVE.scenes[:4], replace(DRIVE.scenes[4], collisions=1))
    told = story(replace(DRIVE, steps=steps, scenes=scenes))

    assert told.startswith("The drive was stopped after 0 m")
    assert told.endswith("It never claimed a place and touched something once.")


def test_each_step_is_written_and_a_line_is_said_now_and_then(capsys):
    written = []
    instants = follow(INSTANTS, GRAPH, lambda step, scene: written.append((step, scene)))

    assert INSTANTS == instants
    assert [(one.step, one.scene) for one in instants] == written
    assert 1 + DRIVE.times[-1] // EVERY == capsys.readouterr().err.count("\n")


def interrupted(count):
    """Yield so many instants before a person stops the drive."""
    yield from INSTANTS[:count]
    raise KeyboardInterrupt


def test_a_drive_that_is_interrupted_ends_where_it_is():
    assert 3 == len(follow(interrupted(3), GRAPH, lambda _step, _scene: None))


def test_a_drive_that_is_interrupted_before_it_began_is_none():
    with pytest.raises(KeyboardInterrupt):
        follow(interrupted(0), GRAPH, lambda _step, _scene: None)


def test_a_drive_that_is_stopped_by_a_signal_is_over_at_once():
    def stopped():
        yield from INSTANTS[:3]
        raise Stopped(15)

    with pytest.raises(Stopped):
        follow(stopped(), GRAPH, lambda _step, _scene: None)


def test_a_drawing_that_is_interrupted_says_that_the_journal_is_kept(tmp_path, monkeypatch):
    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("pilotage.figures.drive.drive_figure", interrupt)
    with pytest.raises(KeyboardInterrupt) as caught:
        draw(DRIVE, tmp_path, "", moving=False)

    assert [f"{tmp_path / 'journal.jsonl'} is complete and kept"] == caught.value.__notes__
