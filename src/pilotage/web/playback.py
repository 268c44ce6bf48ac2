"""The stage of a journal: all of it is known beforehand, so that any moment can be shown at once."""

import bisect
from dataclasses import dataclass, replace

import numpy as np

from pilotage.config import Settings
from pilotage.errors import FileError
from pilotage.io import open_world
from pilotage.io.journal_reader import Recorded, read_journal
from pilotage.localization import Status
from pilotage.maps import Atlas, CellGraph, decompose
from pilotage.navigation import Step
from pilotage.simulation import World
from pilotage.web.drawings import Json, Page, describe_drawing
from pilotage.web.frames import describe_world, told_frame, true_place, true_pose, values
from pilotage.web.order import RecordingOrder
from pilotage.web.replay import LONGEST_PAUSE, graph_of

WAY_POINTS = 1000
"""Points of the way that are told, about."""
LEAST_ON_IT = 0.5
"""Share of the places of a journal that are on its drawing, even if that was changed a little since."""
MOST_CHECKED = 200
"""Places of a journal that are looked up."""


@dataclass(slots=True)
class Playback:
    """Shows the lines of a journal one after the other, or from any of them on."""

    moments: list[Recorded]
    page: Page
    graph: CellGraph
    world: World | None  # in which the robot drove, if a person says so
    next: int = 0

    @property
    def steps(self) -> list[Step]:
        """All steps."""
        return [moment.step for moment in self.moments]

    @property
    def stamp(self) -> float:
        """The time since the journal began [s]."""
        return self.time_of(max(self.next - 1, 0))

    @property
    def end(self) -> float:
        """The time of its last line [s]."""
        return self.time_of(len(self.moments) - 1)

    @property
    def time_step(self) -> float:
        """The time until the next line [s]; 0 before the first and after the last."""
        ahead = self.time_of(min(self.next, len(self.moments) - 1)) - self.stamp
        return min(ahead, LONGEST_PAUSE)

    @property
    def is_over(self) -> bool:
        """Whether all lines were shown."""
        return self.next == len(self.moments)

    def time_of(self, index: int) -> float:
        """Return the time of a line since the first one [s]."""
        return self.moments[index].step.stamp - self.moments[0].step.stamp

    def step(self) -> Step:
        """Go on to the next line."""
        self.next += 1
        return self.moments[self.next - 1].step

    def seek(self, t: float) -> None:
        """Let the last line until this time [s] be the next one."""
        first = self.moments[0].step.stamp
        found = bisect.bisect_right(self.moments, t + first, key=lambda moment: moment.step.stamp)
        self.next = max(found - 1, 0)

    def frame(self) -> Json:
        """Describe the line that is shown."""
        moment = self.moments[self.next - 1]
        step = moment.step
        told = told_frame(step, step.estimate, self.stamp, page=self.page, graph=self.graph, goal="the goal")
        if moment.world_from_base is None:
            return told
        return {**told, "world": true_pose(moment.world_from_base, moment.collisions)}

    def describe(self, title: str) -> Json:
        """Describe the drawing, and the way that was driven."""
        drawn = describe_drawing(self.page.sketch)
        return {"kind": "journal", "title": title, "drawing": drawn, "goal": "", "way": self.way()}

    def way(self) -> list[Json]:
        """List where the robot believed to be, and truly was, thinned."""
        first = self.moments[0].step.stamp
        return [
            {
                "t": round(moment.step.stamp - first, 2),
                "believed": self.page.pose(*values(moment.step.estimate.sketch_from_base.pose))[:2],
                "true": None if moment.world_from_base is None else true_place(moment.world_from_base),
                "sure": moment.step.estimate.status is Status.LOCATED,
            }
            for moment in self.moments[:: max(1, len(self.moments) // WAY_POINTS)]
        ]

    def describe_world(self) -> Json | None:
        """Describe the world, if it is known."""
        if self.world is None:
            return None
        return describe_world(self.world, np.empty((0, 4)), None, self.stamp)


def playback(atlas: Atlas, page: Page, order: RecordingOrder) -> Playback:
    """Open a journal; FileError if it cannot be read, or was written about another drawing.

    A plan from CAD is on the page as an SVG file, whose y axis points down: its journal tells y upwards, and
    names cells by it.
    """
    graph = graph_of(atlas)
    moments = read_journal(order.path, atlas.sketch)
    share = share_on(moments, graph)
    if share < LEAST_ON_IT and atlas.sketch.y_down:
        upright = replace(atlas.sketch, y_down=False)
        graph = decompose(upright, Settings().localizer.atlas.decomposition)
        moments = read_journal(order.path, upright)
        share = share_on(moments, graph)
    if share < LEAST_ON_IT:
        rule = f"a journal must be of this drawing, but only {share:.0%} of its places are on it"
        raise FileError(rule, order.path)
    world = None if order.world is None else open_world(order.world)
    return Playback(moments, page, graph, world)


def share_on(moments: list[Recorded], graph: CellGraph) -> float:
    """Return the share of the places of a journal that are in the cell of a drawing that it names."""
    estimates = [moment.step.estimate for moment in moments[:: max(1, len(moments) // MOST_CHECKED)]]
    are_there = [
        graph.cell_at((one.sketch_from_base.pose.x, one.sketch_from_base.pose.y)) == one.cell_id
        for one in estimates
    ]
    return sum(are_there) / len(are_there)
