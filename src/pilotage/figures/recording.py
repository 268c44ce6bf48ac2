"""A drive as it is drawn: on what, where to, and step by step."""

import bisect
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pilotage.geometry import Array
from pilotage.maps import CellGraph, SchematicMap
from pilotage.navigation import Step
from pilotage.simulation import Scene, World


@dataclass(frozen=True, eq=False)
class Recording:
    """What the robot believed and did, and beside it what was true."""

    sketch: SchematicMap
    world: World
    goal: tuple[float, float]  # in the sketch [drawing units]
    steps: Sequence[Step]
    scenes: Sequence[Scene]  # one for each step
    graph: CellGraph | None = None
    true_goal: tuple[float, float] | None = None  # where the goal is in the world [m], if that is known

    def __post_init__(self) -> None:
        """Refuse a drive without a step, and steps and scenes that do not belong together."""
        if not self.steps:
            raise ValueError("a drive needs at least one step, got none")
        if len(self.steps) != len(self.scenes):
            raise ValueError(f"each step needs its scene, got {len(self.steps)} and {len(self.scenes)}")

    @property
    def times(self) -> Array:
        """When each step was taken, counted from the first, (n,) [s]."""
        return np.array([step.stamp for step in self.steps]) - self.steps[0].stamp

    def step_at(self, stamp: float) -> int:
        """Find the last step taken until then [s]; the first if there is none."""
        return max(bisect.bisect_right(self.steps, stamp, key=lambda step: step.stamp) - 1, 0)

    @property
    def way(self) -> float:
        """How far the robot truly drove [m]."""
        positions = np.array([scene.world_from_base.position for scene in self.scenes])
        return float(np.hypot(*np.diff(positions, axis=0).T).sum())

    @property
    def boxes(self) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """Lower left and upper right corner of the drawing [drawing units], and of the world [m]."""
        (left, bottom, right, top), (west, south, east, north) = self.sketch.bounds, self.world.bounds
        return (
            (np.array([left, bottom]), np.array([right, top])),
            (np.array([west, south]), np.array([east, north])),
        )
