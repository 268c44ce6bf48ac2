"""Read a drive back from its journal, or a trip from a file of estimates: what was believed, step by step."""

import math
from dataclasses import dataclass
from pathlib import Path

from pilotage.errors import FileError, shown
from pilotage.geometry import Affine2, Pose2, Twist
from pilotage.io.json_files import items, number, objects, words
from pilotage.io.records import Record, read_records
from pilotage.localization import Estimate, PoseHypothesis, Status
from pilotage.maps import SchematicMap
from pilotage.navigation import Behavior, Outcome, Step, Visit

LARGEST = 1e9
"""Larger coordinates, times and scales are taken for damage."""


@dataclass(frozen=True, slots=True)
class Recorded:
    """One line of a journal: the step, and what was true then, if it is known."""

    step: Step
    world_from_base: Pose2 | None = None
    collisions: int = 0


def read_journal(path: Path, sketch: SchematicMap) -> list[Recorded]:
    """Read all lines of a journal or a file of estimates that was written about this drawing.

    Raises FileError if it is empty, damaged, or runs backwards in time.
    """
    moments: list[Recorded] = []
    for count, record in enumerate(read_records(path), start=1):
        try:
            moment = recorded(record, sketch)
        except (KeyError, TypeError, ValueError, OverflowError) as error:
            raise FileError(f"line {count} must be an estimate of this program, got {error}", path) from error
        if moments and moment.step.stamp < moments[-1].step.stamp:
            raise FileError(f"line {count} must not be earlier than the line before it", path)
        moments.append(moment)
    if not moments:
        raise FileError("a journal must hold at least one line", path)
    return moments


def recorded(record: Record, sketch: SchematicMap) -> Recorded:
    """Take one line; raises KeyError, TypeError or ValueError."""
    hypotheses = tuple(hypothesis(one, sketch) for one in objects(record["hypotheses"]))
    estimate = Estimate(
        limited(record["stamp"]),
        Status(record["status"]),
        hypotheses,
        number(record.get("cell_probability")),
        share(record["fit"]),
        words(record["place"]),
        limited(record.get("evidence", 0.0)),
        sketch.file_axes,
    )
    command = record.get("command") or {"linear": 0.0, "angular": 0.0}
    distance, outcome, truth = record.get("distance"), record.get("outcome"), record.get("truth")
    step = Step(
        estimate.stamp,
        Twist(number(command["linear"]), number(command["angular"])),
        Behavior(record.get("behavior", Behavior.REST.value)),
        estimate,
        next_cell_id=words(record.get("next_cell")),
        gateway_id=words(record.get("gateway")),
        distance=math.inf if distance is None else limited(distance),
        closed_gateway_ids=tuple(map(str, record.get("closed_gateways") or ())),
        times_lost=int(number(record.get("times_lost"))),
        outcome=None if outcome is None else Outcome(outcome),
        reason=words(record.get("reason")),
        visits=tuple(map(visit, objects(record.get("goals")))),
    )
    if truth is None:
        return Recorded(step)
    pose = Pose2(*(limited(truth[name]) for name in ("x", "y", "heading")))
    return Recorded(step, pose, int(number(truth.get("collisions"))))


def visit(record: Record) -> Visit:
    """Take how the drive to one goal of a tour ended."""
    goal = record["goal"]
    if not isinstance(goal, str):
        x, y = map(limited, items(goal))
        goal = x, y
    return Visit(goal, Outcome(record["outcome"]), limited(record["stamp"]), words(record.get("reason")))


def hypothesis(record: Record, sketch: SchematicMap) -> PoseHypothesis:
    """Take one hypothesis of a line."""
    x, y, heading, scale = (limited(record[name]) for name in ("x", "y", "heading", "scale"))
    pose = sketch.file_axes.pose_to_sketch(Pose2(x, y, heading))
    state = (pose.x, pose.y, pose.theta, math.log(scale), 0.0, 0.0)
    return PoseHypothesis(words(record["cell"]), Affine2.from_state(*state), share(record["probability"]))


def limited(value: object) -> float:
    """Return a number of a size that may be meant; ValueError if it is none."""
    found = number(value, math.nan)
    if not abs(found) <= LARGEST:
        raise ValueError(shown(value))
    return found


def share(value: object) -> float:
    """Return a number from 0 to 1; ValueError if it is none."""
    found = number(value, math.nan)
    if not 0.0 <= found <= 1.0:
        raise ValueError(shown(value))
    return found
