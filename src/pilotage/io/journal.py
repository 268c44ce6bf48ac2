"""Write a drive as JSON Lines, one object a step: what was believed and done, and the truth apart from it."""

import json
import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from pilotage.geometry import Pose2
from pilotage.io.estimates import estimate_record, rounded
from pilotage.io.files import replacing
from pilotage.maps import SchematicMap
from pilotage.navigation import Step, Visit
from pilotage.simulation import Scene

Record = dict[str, object]


def step_record(step: Step, scene: Scene, sketch: SchematicMap) -> Record:
    """Return a step as a line of the journal holds it.

    The estimate is written as in a file of estimates, in the drawing's own units and axes.
    `cell_probability` is the probability that the robot is in this cell, `position_std` [m] the standard
    deviation of its position. `target` is in the robot's own frame, ahead and to its left [m]. `truth` is in
    the frame of the world [m], y up. `goals` are those of a tour that are over. What is unknown or infinite
    is null.
    """
    return {
        **estimate_record(step.estimate, sketch),
        "stamp": round(step.stamp, 6),
        "behavior": step.behavior.value,
        "cell_probability": rounded(step.estimate.cell_probability),
        "position_std": finite(step.estimate.position_std),
        "next_cell": step.next_cell_id,
        "gateway": step.gateway_id,
        "target": None if step.target is None else [rounded(value) for value in step.target],
        "distance": finite(step.distance),
        "command": {"linear": rounded(step.command.linear), "angular": rounded(step.command.angular)},
        "closed_gateways": list(step.closed_gateway_ids),
        "times_lost": step.times_lost,
        "outcome": None if step.outcome is None else step.outcome.value,
        "reason": step.reason,
        "goals": [visit_record(visit) for visit in step.visits],
        "truth": {**pose_record(scene.world_from_base), "collisions": scene.collisions},
    }


def visit_record(visit: Visit) -> Record:
    """Return how the drive to one goal ended."""
    goal = visit.goal if isinstance(visit.goal, str) else list(visit.goal)
    return {
        "goal": goal,
        "outcome": visit.outcome.value,
        "stamp": round(visit.stamp, 6),
        "reason": visit.reason,
    }


def pose_record(pose: Pose2) -> dict[str, float]:
    """Return a true pose."""
    return {"x": rounded(pose.x), "y": rounded(pose.y), "heading": rounded(pose.theta)}


def finite(value: float) -> float | None:
    """Round a number; None if it is infinite or not a number, which JSON cannot hold.

    >>> finite(1.5), finite(math.inf)
    (1.5, None)
    """
    return rounded(value) if math.isfinite(value) else None


@contextmanager
def journal_file(path: Path | str, sketch: SchematicMap) -> Iterator[Callable[[Step, Scene], None]]:
    """Open a journal; it is complete when the block ends, and absent if the block fails.

    If the block is interrupted, the steps so far are kept as `name.partial.suffix`.
    """
    with replacing(path, keeps_partial=True) as beside, beside.open("w", encoding="utf-8") as file:

        def write(step: Step, scene: Scene) -> None:
            file.write(json.dumps(step_record(step, scene, sketch), allow_nan=False) + "\n")

        yield write
