"""Draw a drive of a benchmark: on the drawing and in the world, with the truth that the robot never saw."""

from pathlib import Path

import numpy as np
from matplotlib.patches import Circle, Polygon

from benchmarks.lib.errands import Errand
from benchmarks.lib.sites import Drawing, Site
from pilotage.drives import Drive
from pilotage.evaluation.drive import Destination
from pilotage.figures import style
from pilotage.figures.drive import drive_figure


def write_picture(
    path: Path, driven: Drive, *, drawing: Drawing, site: Site, errand: Errand, title: str
) -> None:
    """Write the picture of a drive."""
    figure = drive_figure(driven, title)
    believed, true = figure.axes[:2]
    carried = drawing.warp.sketch_from_world(driven.positions)
    believed.plot(*carried.T, color=style.INK, linewidth=1.0, linestyle=(0, (2, 2)), zorder=9)
    believed.scatter(*carried[-1], marker="o", s=20.0, color=style.INK, zorder=12)
    room = site.rooms.polygons[site.rooms.names.index(errand.goal_room)]
    goal = Destination(errand.goal, room)
    true.add_patch(Polygon(room.exterior.coords, facecolor="#dcebdc", edgecolor="none", zorder=0))
    true.add_patch(Circle(errand.goal, goal.tolerance, fill=False, color=style.ACCENT, zorder=9))
    true.scatter(*errand.goal, marker="*", s=120.0, color=style.ACCENT, zorder=10)
    hits = np.flatnonzero(np.diff([scene.collisions for scene in driven.scenes], prepend=0))
    true.scatter(*driven.positions[hits].T, marker="X", s=70.0, color="red", zorder=12)
    style.save(figure, path)
