"""Make the demo: the true floor, a drawing of it from a poor memory, the log of a robot that drives there.

    python examples/make_demo.py [folder]

writes `world.svg`, `sketch.svg`, `run.log.gz` and `truth.jsonl`. All is made up, and the same every time.
"""

import json
import math
import sys
from pathlib import Path

import numpy as np
from shapely import LineString, MultiPolygon, union_all

import pilotage
from demo_building import NAMES, THINGS, WALLS, WAYPOINTS
from drawing import QUICK, smooth, trembling
from pilotage.geometry import Array
from pilotage.io import write_log
from pilotage.simulation import RunSettings, World, simulate

SEED = 2001
HOME = Path(pilotage.__file__).parent / "demo"
WALL_THICKNESS = 0.14  # [m]
UP = np.array([1.0, -1.0])

# The drawing's proportions: where some x and y [m] come to lie on the page of memory [m]. North and south of
# the corridor the pen went wrong in different ways.
X_TRUE = (-2.0, 0.0, 4.2, 6.2, 10.6, 13.2, 14.2, 19.2, 21.3, 30.0, 32.8, 35.5, 38.0)
X_NORTH = (-2.0, 0.0, 5.3, 7.4, 11.9, 14.6, 15.4, 19.9, 21.9, 29.0, 31.6, 34.0, 36.0)
X_SOUTH = (-2.0, 0.0, 4.0, 5.9, 11.2, 14.5, 15.9, 20.1, 21.8, 31.0, 34.2, 36.0, 38.0)
Y_TRUE = (-2.0, 0.0, 1.0, 3.0, 5.0, 8.5, 10.7, 12.2, 15.4, 16.2, 18.4, 20.0, 22.0)
Y_DRAWN = (-1.8, 0.0, 0.8, 2.4, 4.4, 7.4, 10.4, 11.7, 14.2, 15.1, 17.0, 18.9, 20.6)

SCALE = 22.0  # [drawing units / m]
TURN = math.radians(-3.5)
MARGIN = np.array([70.0, 110.0])  # [drawing units]


def remembered(points: Array, sway: Array) -> Array:
    """Carry points (n, 2) of the floor [m, y down] to the page [drawing units, y down]."""
    x, y = points[:, 0], points[:, 1]
    south = np.clip((y - 8.5) / (10.7 - 8.5), 0.0, 1.0)
    drawn_x = (1.0 - south) * np.interp(x, X_TRUE, X_NORTH) + south * np.interp(x, X_TRUE, X_SOUTH)
    drawn_y = np.interp(y, Y_TRUE, Y_DRAWN)
    waves = np.sin(0.35 * x[:, np.newaxis] + 0.5 * y[:, np.newaxis] * np.array([1, -1]) + sway)
    drawn = np.column_stack([drawn_x, drawn_y]) + QUICK.sway * waves
    c, s = math.cos(TURN), math.sin(TURN)
    return np.asarray(MARGIN + SCALE * drawn @ np.array([[c, s], [-s, c]]))


def ring(points: Array) -> str:
    """Write one ring of an area."""
    return "M" + " L".join(f"{x:.3f} {y:.3f}" for x, y in points[:-1]) + " Z"


def write_world(path: Path) -> None:
    """Write the true floor in metres: walls with their thickness, and all that stands between them."""
    walls = union_all(
        [LineString(wall).buffer(WALL_THICKNESS / 2, cap_style="flat", join_style="mitre") for wall in WALLS]
    )
    areas = walls.geoms if isinstance(walls, MultiPolygon) else [walls]
    rings = [edge for area in areas for edge in (area.exterior, *area.interiors)]
    things = "\n".join(f'  <path d="{ring(np.array(thing))}"/>' for thing in THINGS)
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-1 -2.2 38 23.2" width="1140" height="696">\n'
        "<title>The floor of the demo, a unit is a metre</title>\n"
        '<rect x="-1" y="-2.2" width="38" height="23.2" fill="white"/>\n'
        '<path id="walls" fill="#333" fill-rule="evenodd" d="'
        + "\n".join(ring(np.array(edge.coords)) for edge in rings)
        + f'"/>\n<g id="things" fill="#c9b79c">\n{things}\n</g>\n</svg>\n'
    )


def write_sketch(path: Path, rng: np.random.Generator, sway: Array) -> None:
    """Write the drawing from memory: walls and names, no furniture, no scale."""
    strokes = "\n".join(
        f'  <path d="{smooth(remembered(trembling(wall, QUICK, rng), sway))}"/>' for wall in WALLS
    )
    spots = remembered(np.array([(x, y) for _, x, y in NAMES]), sway)
    names = "\n".join(
        f'  <text x="{x:.0f}" y="{y:.0f}">{name}</text>'
        for (name, _, _), (x, y) in zip(NAMES, spots, strict=True)
    )
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 930 600" width="930" height="600">\n'
        "<title>The floor of the demo, from memory</title>\n"
        '<rect width="930" height="600" fill="#fbf8f1"/>\n'
        '<g id="walls" fill="none" stroke="#2f3136" stroke-width="3" stroke-linecap="round" '
        'stroke-linejoin="round">\n'
        f"{strokes}\n</g>\n"
        '<g id="labels" fill="#5b6577" font-family="Segoe Print, Bradley Hand, Comic Neue, cursive" '
        f'font-size="17" font-style="italic" text-anchor="middle">\n{names}\n</g>\n</svg>\n'
    )


def main(folder: Path) -> None:
    """Write the four files."""
    folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(SEED)
    sway = rng.uniform(0.0, math.tau, 2)
    write_world(folder / "world.svg")
    write_sketch(folder / "sketch.svg", rng, sway)
    run = simulate(World.of(pilotage.open_map(folder / "world.svg")), WAYPOINTS * UP, rng, RunSettings())
    write_log(folder / "run.log.gz", run.readings)
    true = remembered(np.array([moment.world_from_base.position for moment in run.truth]) * UP, sway)
    with (folder / "truth.jsonl").open("w") as file:
        for moment, (x, y) in zip(run.truth, true, strict=True):
            file.write(
                json.dumps({"stamp": round(moment.stamp, 3), "x": round(x, 1), "y": round(y, 1)}) + "\n"
            )
    print(f"{len(run.readings)} scans in {folder}")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else HOME)
