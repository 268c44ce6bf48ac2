"""What moves in the pictures of an animated drive: one view of what is believed, one of what is true."""

from collections.abc import Sequence

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgba
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch, Polygon
from matplotlib.path import Path

from pilotage.drives import Drive
from pilotage.figures import style
from pilotage.figures.cells import outline_of
from pilotage.figures.trail import JUMP, Stretch, find_stretches
from pilotage.geometry import Array
from pilotage.localization import Status
from pilotage.maps import Roadmap, RouteError, RouteSettings
from pilotage.navigation import Step

ROBOT = 0.032
"""Length of the robot's arrow, as a share of the picture's diagonal: large enough to be seen."""
BEAM = "#bfe3f2"
FAINTEST = 0.2  # opacity of a place that is hardly possible


class BelievedView:
    """On the drawing: the places held possible, the scan laid over it, cell, gateway, route, and way."""

    def __init__(self, axes: Axes, drive: Drive) -> None:
        self.drive, self.size = drive, drive.sketch.diagonal
        zones = drive.sketch.zones
        self.roads = Roadmap(drive.graph, RouteSettings(), zones) if drive.graph is not None else None
        positions = np.array([step.estimate.sketch_from_base.pose.position for step in drive.steps])
        found = find_stretches(drive.steps, positions, JUMP * self.size)
        self.stretches = [one for one in found if one.located]
        self.cell = PathPatch(Path(np.zeros((1, 2))), facecolor=style.GATEWAY, alpha=0.22, linewidth=0.0)
        self.route = Line2D([], [], color=style.GOAL, linewidth=1.6, linestyle=(0, (1, 1.2)))
        self.way = LineCollection([], linewidths=2.4, capstyle="round")
        self.returns = new_returns()
        self.gateway = Line2D([], [], color=style.GATEWAY, linewidth=3.0)
        self.robots = PolyCollection([], edgecolors="white", linewidths=0.7)
        self.artists = (self.cell, self.route, self.way, self.returns, self.gateway, self.robots)
        animated(axes, self.artists)

    def show(self, k: int) -> None:
        """Set everything as it is at a step."""
        step = self.drive.steps[k]
        scan = self.drive.scenes[self.drive.step_at(step.estimate.stamp)].scan  # the one it was made of
        located = step.estimate.status is Status.LOCATED
        show_way(self.way, self.stretches, k)
        self.show_places(step)
        self.returns.set_data(*(step.estimate.sketch_from_base @ scan.points_in_base).T)
        self.returns.set_alpha(0.8 if located else 0.25)
        self.cell.set_visible(located)
        self.route.set_visible(located and step.outcome is None)
        self.gateway.set_visible(located and step.outcome is None)
        if located and self.roads is not None:
            self.show_plan(step, self.roads)

    def show_places(self, step: Step) -> None:
        """Draw an arrow for each place held possible, the fainter the less probable, the claimed one last."""
        rivals = step.estimate.hypotheses[1:]
        poses = [*(rival.sketch_from_base.pose for rival in rivals), step.estimate.sketch_from_base.pose]
        shares = [*(rival.probability for rival in rivals), max(step.estimate.probability, 0.3)]
        self.robots.set_verts([style.arrow(pose, ROBOT * self.size) for pose in poses])
        opacities = [FAINTEST + (1.0 - FAINTEST) * share for share in shares]
        self.robots.set_facecolor([to_rgba(style.ACCENT, opacity) for opacity in opacities])

    def show_plan(self, step: Step, roads: Roadmap) -> None:
        """Draw the cell, the gateway that is next, and the route."""
        graph = roads.graph
        self.cell.set_path(outline_of(graph.cell(step.estimate.cell_id)))
        self.route.set_data(*route_ahead(step, roads, self.drive.goal_point_at(step)).T)
        gateway = graph.gateway(step.gateway_id).segment if step.gateway_id else np.empty((0, 2))
        self.gateway.set_data(*gateway.T)


class TrueView:
    """In the world: the robot, what its laser meets, people, closed doors, the way so far."""

    def __init__(self, axes: Axes, drive: Drive) -> None:
        self.drive = drive
        low, high = drive.boxes[1]
        self.size = float(np.hypot(*(high - low)))
        positions = np.array([scene.world_from_base.position for scene in drive.scenes])
        self.stretches = find_stretches(drive.steps, positions)
        self.beams = Polygon(np.zeros((1, 2)), facecolor=BEAM, alpha=0.6, linewidth=0.0)
        self.way = LineCollection([], linewidths=2.4, capstyle="round")
        self.returns = new_returns()
        self.doors = LineCollection([], colors=style.DOOR, linewidths=2.4)
        self.people = axes.scatter([], [], s=26.0, color=style.PERSON)
        self.people.set(edgecolor="white", linewidth=0.7)
        self.robot = PolyCollection([], facecolors=style.ACCENT, edgecolors="white", linewidths=0.7)
        self.artists = (self.beams, self.way, self.returns, self.doors, self.people, self.robot)
        animated(axes, self.artists)

    def show(self, k: int) -> None:
        """Set everything as it is at a step."""
        scene = self.drive.scenes[k]
        points = scene.world_from_base @ scene.scan.points_in_base
        laser = (scene.world_from_base @ scene.scan.base_from_laser).position[np.newaxis]
        self.beams.set_xy(np.vstack([laser, points, laser]))
        self.returns.set_data(*points.T)
        show_way(self.way, self.stretches, k)
        self.doors.set_segments(list(scene.closed_doors.reshape(-1, 2, 2)))
        self.people.set_offsets(scene.people)
        self.robot.set_verts([style.arrow(scene.world_from_base, ROBOT * self.size)])


def new_returns() -> Line2D:
    """Return small dots for where beams came back."""
    return Line2D([], [], color=style.ACCENT, marker=".", markersize=2.2, linestyle="none")


def animated(axes: Axes, artists: Sequence[Artist]) -> None:
    """Add artists that are drawn only when asked to."""
    for artist in artists:
        artist.set_animated(True)
        if artist.axes is None:
            axes.add_artist(artist)


def show_way(lines: LineCollection, stretches: Sequence[Stretch], k: int) -> None:
    """Draw the way up to a step."""
    gone = [one for one in stretches if one.first <= k]
    lines.set_segments([one.points[: k - one.first + 1] for one in gone])
    lines.set_color([one.color for one in gone])


def route_ahead(step: Step, roads: Roadmap, goal: tuple[float, float]) -> Array:
    """Return the way from where the robot believes to be to its goal, (n, 2); empty if there is none."""
    pose = step.estimate.sketch_from_base.pose
    try:
        return roads.find((pose.x, pose.y), goal, step.closed_gateway_ids).way
    except RouteError:
        return np.empty((0, 2))
