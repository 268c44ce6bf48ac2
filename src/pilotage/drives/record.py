"""The record of a drive: what the robot believed and did, and beside it what was true."""

import bisect
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Self

import numpy as np

from pilotage.drives.loop import Instant
from pilotage.geometry import Array
from pilotage.localization import Status
from pilotage.maps import Atlas, CellGraph, SchematicMap, find_labeled
from pilotage.navigation import Goal, Outcome, Step
from pilotage.navigation.tour import HOME
from pilotage.simulation import Scene, World


@dataclass(frozen=True, eq=False)
class Drive:
    """A drive from its first scan on; `steps` and `scenes` belong together one by one."""

    sketch: SchematicMap
    world: World
    goal: Goal
    steps: Sequence[Step]
    scenes: Sequence[Scene]
    step_ms: Sequence[float] = ()  # [ms] of the processor for each step; empty if not measured
    graph: CellGraph | None = None
    true_goal: tuple[float, float] | None = None  # where the goal is in the world [m], if that is known

    def __post_init__(self) -> None:
        """Reject a drive without a step, and steps and scenes that do not belong together."""
        if not self.steps:
            raise ValueError("a drive needs at least one step, got none")
        if len(self.steps) != len(self.scenes):
            raise ValueError(f"each step needs its scene, got {len(self.steps)} and {len(self.scenes)}")

    @classmethod
    def of(cls, atlas: Atlas, world: World, goal: Goal, instants: Sequence[Instant]) -> Self:
        """Gather the instants of a drive."""
        return cls(
            atlas.sketch,
            world,
            goal,
            [instant.step for instant in instants],
            [instant.scene for instant in instants],
            [instant.step_ms for instant in instants],
            None if atlas.joined is None else atlas.joined.graph,
        )

    @property
    def outcome(self) -> Outcome | None:
        """How the robot says that the drive ended; None if it goes on."""
        return self.steps[-1].outcome

    @property
    def reason(self) -> str:
        """Why it ended, in plain words."""
        return self.steps[-1].reason

    @cached_property
    def goal_points(self) -> Array:
        """Where the goals are that were tried, (n, 2) [drawing units, y up], the last one last."""
        passed = [
            find_labeled(self.graph, visit.goal)
            if isinstance(visit.goal, str)
            else tuple(self.sketch.sketch_from_file(np.array([visit.goal]))[0])
            for visit in self.steps[-1].visits
            if self.graph is not None and visit.goal != HOME
        ]
        return np.array([*passed, self.goal.point])

    def goal_point_at(self, step: Step) -> tuple[float, float]:
        """Return where the goal is to which the robot drives at a step [drawing units, y up]."""
        x, y = self.goal_points[min(len(step.visits), len(self.goal_points) - 1)].tolist()
        return x, y

    @property
    def collisions(self) -> int:
        """Contacts, each counted once."""
        return self.scenes[-1].collisions

    @cached_property
    def times(self) -> Array:
        """When each step was taken, from the first one on, (n,) [s]."""
        return np.array([step.stamp for step in self.steps]) - self.steps[0].stamp

    @property
    def minutes(self) -> float:
        """How long the drive took by the robot's clock."""
        return float(self.times[-1]) / 60.0

    @cached_property
    def positions(self) -> Array:
        """Where the robot truly was at each step, (n, 2) [m]."""
        return np.array([scene.world_from_base.position for scene in self.scenes])

    @cached_property
    def length(self) -> float:
        """How far the robot truly drove [m]."""
        return float(np.hypot(*np.diff(self.positions, axis=0).T).sum())

    @property
    def times_lost(self) -> int:
        """How often the place was lost after it had been found."""
        return self.steps[-1].times_lost

    @cached_property
    def times_recovered(self) -> int:
        """How often a lost place was found again."""
        recovered, waiting = 0, False
        for before, now in pairwise(self.steps):
            waiting |= now.times_lost > before.times_lost
            if waiting and now.estimate.status is Status.LOCATED:
                recovered, waiting = recovered + 1, False
        return recovered

    def step_at(self, stamp: float) -> int:
        """Find the last step taken until then [s]; the first if there is none."""
        return max(bisect.bisect_right(self.steps, stamp, key=lambda step: step.stamp) - 1, 0)

    @property
    def boxes(self) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """Lower left and upper right corner of the drawing [drawing units], and of the world [m]."""
        (left, bottom, right, top), (west, south, east, north) = self.sketch.bounds, self.world.bounds
        return (
            (np.array([left, bottom]), np.array([right, top])),
            (np.array([west, south]), np.array([east, north])),
        )
