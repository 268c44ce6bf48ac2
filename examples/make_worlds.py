"""Make the packed worlds: the true buildings, two drawings of each from memory, and the truth for scoring.

    python examples/make_worlds.py [folder]

writes for each building `world.svg` (metres; walls, furniture, glass, doors with their times, people, a
start), `careful.svg` and `quick.svg` (walls and names, no furniture, no scale), and, known to nobody who
drives, `rooms.geojson`, `careful.json` and `quick.json`: the rooms in the world and on each drawing, and
points that are the same in both. All is made up, and the same every time.
"""

import json
import math
import sys
from pathlib import Path

import numpy as np
from shapely import Geometry, LineString, MultiPolygon, Point, union_all

import pilotage
from drawing import CAREFUL, QUICK, Hand, Sheet, smooth, trembling
from floors import BUILDINGS, Building
from floors.plan import Points
from pilotage.geometry import Array

SEED = 2001
FOLDER = Path(pilotage.__file__).parent / "worlds"
WALL_THICKNESS = 0.14  # [m]
MARGIN = 36.0  # [drawing units] around a building
PAGES = {  # [drawing units / m] and by how much the sheet is turned [deg]
    ("office", "careful"): (24.0, 0.0),
    ("office", "quick"): (22.0, -3.5),
    ("home", "careful"): (42.0, 90.0),
    ("home", "quick"): (38.0, 6.0),
    ("museum", "careful"): (23.0, 0.0),
    ("museum", "quick"): (21.0, 4.0),
}
FONTS = {
    "careful": 'font-family="Segoe UI, Noto Sans, DejaVu Sans, sans-serif" font-size="15"',
    "quick": 'font-family="Segoe Print, Bradley Hand, Comic Neue, cursive" font-size="17" '
    'font-style="italic"',
}


def main(folder: Path) -> None:
    """Write six files for each building."""
    for building in BUILDINGS:
        home = folder / building.name
        home.mkdir(parents=True, exist_ok=True)
        write_world(home / "world.svg", building)
        write_rooms(home / "rooms.geojson", building)
        for hand, style in (("careful", CAREFUL), ("quick", QUICK)):
            write_drawing(home, building, hand, style)
        print(f"{building.name}: {len(building.rooms)} rooms, in {home}")


def write_world(path: Path, building: Building) -> None:
    """Write the true building in metres: walls with their thickness, and all that stands or walks there."""
    panes = union_all([LineString(pane).buffer(WALL_THICKNESS, cap_style="flat") for pane in building.glass])
    walls = union_all([solid(wall, building.walls) for wall in building.walls]).difference(panes)
    areas = walls.geoms if isinstance(walls, MultiPolygon) else [walls]
    rings = [edge for area in areas for edge in (area.exterior, *area.interiors)]
    left, top, right, bottom = walls.bounds
    box = f"{left - 1:.2f} {top - 1:.2f} {right - left + 2:.2f} {bottom - top + 2:.2f}"
    x, y, heading_deg = building.start
    parts = [
        '<path id="walls" fill="#333" fill-rule="evenodd" d="'
        + "\n".join(ring(np.array(edge.coords)) for edge in rings)
        + '"/>',
        group(
            "things", 'fill="#c9b79c"', [f'<path d="{ring(np.array(thing))}"/>' for thing in building.things]
        ),
        group(
            "panes",
            'stroke="#7fb4d9" stroke-width="0.08"',
            [f'<line class="glass" {ends(pane[0], pane[1])}/>' for pane in building.glass],
        ),
        group(
            "leaves",
            'stroke="#b5651d" stroke-width="0.06"',
            [f'<line class="door" data-closed="{times}" {ends(a, b)}/>' for a, b, times in building.doors],
        ),
        group(
            "people",
            'fill="none" stroke="#b04a5a" stroke-width="0.05" stroke-dasharray="0.15 0.15"',
            [
                f'<polyline class="person" data-speed="{speed}" points="{listed(path)}"/>'
                for speed, path in building.people
            ],
        ),
        f'<circle class="start" data-heading="{heading_deg:g}" cx="{x}" cy="{y}" r="0.2" fill="#2a7f62"/>',
    ]
    path.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" width="{30 * (right - left + 2):.0f}" '
        f'height="{30 * (bottom - top + 2):.0f}">\n<title>{building.title}, a unit is a metre</title>\n'
        + "\n".join(parts)
        + "\n</svg>\n",
        encoding="utf-8",
    )


def solid(wall: Points, walls: list[Points]) -> Geometry:
    """Give a wall its thickness; where it ends at another, the corner is filled."""
    others = union_all([LineString(other) for other in walls if other is not wall])
    posts = [
        end.buffer(WALL_THICKNESS / 2, cap_style="square")
        for end in map(Point, (wall[0], wall[-1]))
        if end.distance(others) == 0.0
    ]
    return union_all(
        [LineString(wall).buffer(WALL_THICKNESS / 2, cap_style="flat", join_style="mitre"), *posts]
    )


def group(name: str, style: str, lines: list[str]) -> str:
    """Write a layer."""
    return f'<g id="{name}" {style}>\n' + "\n".join(f"  {line}" for line in lines) + "\n</g>"


def ring(points: Array) -> str:
    """Write one ring of an area."""
    return "M" + " L".join(f"{x:.3f} {y:.3f}" for x, y in points[:-1]) + " Z"


def ends(a: tuple[float, float], b: tuple[float, float]) -> str:
    """Write the ends of a line."""
    return f'x1="{a[0]}" y1="{a[1]}" x2="{b[0]}" y2="{b[1]}"'


def listed(points: Points) -> str:
    """Write the points of a polyline."""
    return " ".join(f"{x:g},{y:g}" for x, y in points)


def write_drawing(folder: Path, building: Building, name: str, hand: Hand) -> None:
    """Write a drawing from memory, and beside it the truth about it."""
    rng = np.random.default_rng([SEED, *building.name.encode(), *name.encode()])
    memory = building.careful if name == "careful" else building.quick
    walls, rooms = building.walls, building.rooms
    if name == "quick":
        walls = [wall for wall in walls if wall not in building.left_out] + building.put_in
        rooms = rooms | building.redrawn
    scale, turn_deg = PAGES[building.name, name]
    corners = np.array(list(dict.fromkeys(point for wall in walls for point in wall)), dtype=np.float64)
    sheet = Sheet(memory, hand, scale, math.radians(turn_deg), rng.uniform(0.0, math.tau, 2))
    sheet = sheet.moved(MARGIN - sheet(corners).min(axis=0))
    width, height = (sheet(corners).max(axis=0) + MARGIN).round().astype(int)
    strokes = [f'<path d="{smooth(sheet(trembling(wall, hand, rng)))}"/>' for wall in walls]
    spots = sheet(np.array(list(building.labels.values())))
    texts = [
        f'<text x="{x:.0f}" y="{y:.0f}">{text}</text>'
        for text, (x, y) in zip(building.labels, spots, strict=True)
    ]
    (folder / f"{name}.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
        f'height="{height}">\n<title>{building.title}, from memory</title>\n'
        f'<rect width="{width}" height="{height}" fill="{hand.paper}"/>\n'
        + group(
            "walls",
            f'fill="none" stroke="{hand.ink}" stroke-width="{hand.pen}" stroke-linecap="round" '
            'stroke-linejoin="round"',
            strokes,
        )
        + "\n"
        + group("labels", f'fill="#5b6577" {FONTS[name]} text-anchor="middle"', texts)
        + "\n</svg>\n",
        encoding="utf-8",
    )
    truth = {
        "building": building.name,
        "hand": name,
        "control_points": [
            {"world": [x, -y], "sketch": place}
            for (x, y), place in zip(corners.tolist(), sheet(corners).round(2).tolist(), strict=True)
        ],
        "rooms": {room: sheet(np.array(outline)).round(2).tolist() for room, outline in rooms.items()},
        "missing_rooms": [],
    }
    (folder / f"{name}.json").write_text(by_line(truth), encoding="utf-8")


def write_rooms(path: Path, building: Building) -> None:
    """Write the rooms of the building in metres, y up."""
    features = [
        {
            "type": "Feature",
            "properties": {"name": name},
            "geometry": {
                "type": "Polygon",
                "coordinates": [[[x, 0.0 - y] for x, y in (*outline[::-1], outline[-1])]],
            },
        }
        for name, outline in building.rooms.items()
    ]
    path.write_text(
        by_line(
            {
                "type": "FeatureCollection",
                "properties": {"building": building.name, "frame": "of world.svg, metres, y up"},
                "features": features,
            }
        ),
        encoding="utf-8",
    )


def by_line(value: dict[str, object]) -> str:
    """Write JSON, an item of a list a line."""
    entries = []
    for key, entry in value.items():
        if isinstance(entry, list) and entry:
            text = "[\n" + ",\n".join(json.dumps(item) for item in entry) + "\n]"
        elif key == "rooms" and isinstance(entry, dict):
            text = "{\n" + ",\n".join(f"{json.dumps(k)}: {json.dumps(v)}" for k, v in entry.items()) + "\n}"
        else:
            text = json.dumps(entry)
        entries.append(f"{json.dumps(key)}: {text}")
    return "{\n" + ",\n".join(entries) + "\n}\n"


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER)
