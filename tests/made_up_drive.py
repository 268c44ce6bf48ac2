"""A small made-up drive for the tests of what is written and drawn of one."""

import numpy as np

from knowing import estimate_of, hypothesis_at
from pilotage.drives import Drive
from pilotage.geometry import Polyline, Pose2, Twist
from pilotage.localization import Status
from pilotage.maps import DecompositionSettings, SchematicMap, decompose
from pilotage.navigation import Behavior, Goal, Outcome, Step
from pilotage.perception import LaserScan
from pilotage.simulation import Scene, World

STROKES = ([(0, 0), (10, 0), (10, 5), (0, 5), (0, 0)], [(5, 0), (5, 2)], [(5, 3), (5, 5)])
SKETCH = SchematicMap(tuple(Polyline.through(stroke) for stroke in STROKES))
"""Two rooms and a door between them, in half metres."""
WORLD = World(SKETCH.segments / 2.0)
GRAPH = decompose(SKETCH, DecompositionSettings())
GOAL = (9.0, 2.5)
(GATEWAY,) = GRAPH.gateways
FIRST, SECOND = GRAPH.cell_at((1.0, 2.5)), GRAPH.cell_at(GOAL)


def moment(k, *, x, lost=False, behavior=Behavior.CROSS, outcome=None):
    """Return the step and the scene at `0.1 k` seconds, the robot at x on its way [drawing units]."""
    pose = Pose2(x, 2.5, 0.0)
    cell_id = GRAPH.cell_at((x, 2.5))
    status = Status.LOST if lost else Status.LOCATED
    here = hypothesis_at(pose, scale=2.0, cell_id=cell_id, probability=0.1 if lost else 0.9)
    other = hypothesis_at(Pose2(2.0, 1.0, 3.0), scale=1.5, cell_id=FIRST, probability=0.05)
    estimate = estimate_of(here, other, stamp=0.1 * k, status=status)
    onwards = {"next_cell_id": SECOND, "gateway_id": GATEWAY.gateway_id} if cell_id == FIRST else {}
    step = Step(
        0.1 * k, Twist(0.5, 0.0), behavior, estimate, distance=(GOAL[0] - x) / 2.0, outcome=outcome, **onwards
    )
    scan = LaserScan(0.1 * k, -1.0, 0.5, np.array([2.0, 1.5, np.inf, 1.5, 2.0]))
    people = np.array([[3.0, 1.0 + 0.01 * k]])
    return step, Scene(Pose2(x / 2.0, 1.25, 0.0), scan, people, np.empty((0, 4)))


def through_the_door(count=60):
    """Look around while lost, then cross from room to room to the goal."""
    moments = [moment(k, x=1.0, lost=True, behavior=Behavior.LOOK_AROUND) for k in range(10)]
    moments += [moment(10 + k, x=1.0 + 8.0 * k / count) for k in range(count)]
    moments.append(moment(10 + count, x=9.0, behavior=Behavior.REST, outcome=Outcome.REACHED))
    steps, scenes = zip(*moments, strict=True)
    return Drive(SKETCH, WORLD, Goal(GOAL, SECOND), steps, scenes, graph=GRAPH)
