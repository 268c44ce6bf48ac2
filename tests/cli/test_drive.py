"""What is said of a drive, and how it ends when a person has seen enough."""

from dataclasses import replace

import pytest

from drives import GRAPH, through_the_door
from pilotage.cli.drive import EVERY, follow, story
from pilotage.evaluation.drive import Instant
from pilotage.navigation import Outcome

DRIVE = through_the_door()
INSTANTS = [Instant(step, scene, 1.0) for step, scene in zip(DRIVE.steps, DRIVE.scenes, strict=True)]


def ended(**changes):
    """Return the drive with another last step."""
    return replace(DRIVE, steps=(*DRIVE.steps[:-1], replace(DRIVE.steps[-1], **changes)))


def test_a_goal_that_is_reached_is_told_with_what_it_took():
    told = story(DRIVE)

    assert told.startswith("After 4 m and 0:07 minutes the robot says that it stands at the goal, in c")
    assert told.endswith("It knew its place after 0:01 and touched nothing.")


def test_a_drive_that_is_given_up_says_why():
    told = story(ended(outcome=Outcome.GAVE_UP, reason="all doors are closed", times_lost=2))

    assert "the robot gave up: all doors are closed. It believes to be in c" in told
    assert "lost it 2 times" in told


def test_a_robot_that_never_knew_and_touched_something_says_so():
    steps, scenes = DRIVE.steps[:5], (*DRIVE.scenes[:4], replace(DRIVE.scenes[4], collisions=1))
    told = story(replace(DRIVE, steps=steps, scenes=scenes))

    assert told.startswith("The drive was stopped after 0 m")
    assert told.endswith("It never knew its place and touched something once.")


def test_each_step_is_written_and_a_line_is_said_now_and_then(capsys):
    written = []
    steps, scenes = follow(INSTANTS, GRAPH, lambda step, scene: written.append((step, scene)))

    assert list(DRIVE.steps) == steps
    assert list(zip(steps, scenes, strict=True)) == written
    assert 1 + DRIVE.times[-1] // EVERY == capsys.readouterr().err.count("\n")


def interrupted(count):
    """Yield so many instants before a person stops the drive."""
    yield from INSTANTS[:count]
    raise KeyboardInterrupt


def test_a_drive_that_is_interrupted_ends_where_it_is():
    steps, scenes = follow(interrupted(3), GRAPH, lambda _step, _scene: None)

    assert 3 == len(steps) == len(scenes)


def test_a_drive_that_is_interrupted_before_it_began_is_none():
    with pytest.raises(KeyboardInterrupt):
        follow(interrupted(0), GRAPH, lambda _step, _scene: None)
