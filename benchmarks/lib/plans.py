"""The plans of others and the flat in many dialects: what a person reads on each, and how to score it.

A plan's truth is points, so what a room covers is told by a disc about its point, a quarter of the way to the
nearest other point in radius: it lies well within the room, and furniture or a wall that is none cuts it.
Of the flat the rooms are known, and the rooms themselves are taken.
"""

import json
import re
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import rustworkx
import shapely

from benchmarks.lib.data import DATA
from benchmarks.lib.divide import Division

PICTURES = (".png", ".jpg", ".jpeg")
"""Words of a picture are pixels: names are not scored."""

DISC = 0.25
"""Radius of the disc that stands for a room, as a share of the distance to the nearest other room's point."""

MOST = 0.5
"""Share of a room, or of the disc that stands for it, that its cell must hold, and more."""

FLAT = {
    "Kitchen": (0, 0, 350, 320),
    "Living": (350, 0, 800, 320),
    "Bedroom": (800, 0, 1200, 320),
    "Corridor": (0, 320, 1200, 440),
    "Bath": (0, 440, 250, 800),
    "Office": (250, 440, 700, 800),
    "Store": (700, 440, 1200, 800),
}
"""The rooms of the flat of the dialects: left, top, right and bottom, y down; its corridor is no. 3."""

FLAT_CONNECTIONS = ((0, 3), (1, 3), (2, 3), (3, 4), (3, 5), (3, 6), (5, 6))

SCAN = ((150.0, 128.0), (1350.0, 122.0), (1351.0, 932.0), (156.0, 932.0))
PHOTO_CORNERS = {
    "a-scan-plain.png": SCAN,
    "b-scan-notext.png": SCAN,
    "c-scan-ruled.png": SCAN,
    "d-scan-grid.png": SCAN,
    "e-shadow.jpg": SCAN,
    "f-phone.jpg": ((318.0, 240.0), (1462.0, 289.0), (1525.0, 1059.0), (275.0, 1022.0)),
    "g-phone-grid.jpg": ((322.0, 240.0), (1460.0, 285.0), (1527.0, 1060.0), (274.0, 1024.0)),
    "h-phone-ruled-notext.jpg": ((320.0, 240.0), (1455.0, 285.0), (1528.0, 1068.0), (278.0, 1022.0)),
    "i-phone-pencil-rot.jpg": ((1110.0, 323.0), (1058.0, 1457.0), (280.0, 1530.0), (330.0, 285.0)),
    "j-phone-12mp.jpg": ((714.0, 538.0), (3268.0, 635.0), (3400.0, 2372.0), (612.0, 2280.0)),
}
"""Where the corners (0, 0), (1200, 0), (1200, 800) and (0, 800) of the flat lie in each photo, by eye."""

OPEN = {
    "apartment-annotated-photo.jpg": ((7, 9), (8, 9), (7, 10)),
    "apartment-hebrew-scan.png": ((8, 9), (9, 10), (3, 9)),
    "apartment-inkscape-red-furniture.svg": ((3, 7),),
    "hackerspace-door-lines.dxf": ((1, 2), (2, 3)),
    "house-sketch-drawing-app.jpg": (),
    "villa-architect-site.dxf": ((0, 1), (0, 6)),
}
"""Rooms that the notes of a plan call one open space: to make one cell of such a pair is not wrong."""

UNWRITTEN = {
    "apartment-inkscape-red-furniture.svg": tuple(range(10)),
    "hackerspace-door-lines.dxf": (2,),
    "house-50x30-dimensions.pdf": (8,),
    "house-dark-theme.svg": (1, 3, 5, 8, 13, 14, 15, 16, 17),
    "house-drawio.drawio": (7, 8, 9),
    "house-home-assistant.svg": tuple(range(16)),
    "house-outline-single-layer.dxf": tuple(range(12)),
    "office-boxes.excalidraw": tuple(range(6)),
    "office-cad-grey-walls.svg": (0, 1, 2, 3, 4, 15, 16),
    "school-first-floor-figma.svg": tuple(range(16)),
    "two-levels-drawio-export.svg": tuple(range(7)),
    "villa-architect-site.dxf": (11,),
    "wayfinding-demo-offices.svg": tuple(range(15)),
}
"""Rooms whose name is nowhere in the file as text: the truth describes them, or their words are outlines."""

TAG = re.compile(r"<[^>]*>")
DESCRIPTION = re.compile(r"\([^)]*\)")
MEASURE = re.compile(
    r"\d+(?:[.,]\d+)?\s*(?:m2|m²|sq\.?\s*ft|qm)\b|\d+\s*['′]\s*(?:\d+\s*[\"″])?|\d+(?:[.,]\d+)?\s*x\s*\d\S*"  # noqa: RUF001
)
"""Areas and sizes that stand in a name."""


@dataclass(frozen=True, eq=False)
class Plan:
    """One file, and what a person reads on it, in the axes of the file."""

    path: Path
    group: str  # dialects, photos or plans
    names: tuple[str, ...]  # empty where nothing is written
    points: np.ndarray  # (n, 2)
    bodies: tuple[shapely.Geometry, ...]  # the room, or what stands for it
    connections: frozenset[frozenset[int]]
    open_pairs: tuple[tuple[int, int], ...] = ()

    @property
    def key(self) -> str:
        """How the file is named in tables and figures."""
        return f"{self.group}/{self.path.name}"


@dataclass(frozen=True)
class PlanScore:
    """How one file went; counts, so that all rates follow."""

    key: str
    rooms: int
    found: int
    strictly: int  # found, were open spaces with two names two rooms
    named: int
    written: int
    hits: int  # connections
    claimed: int
    drawn: int
    seconds: float
    mb: float
    cells: int = 0
    error: str = ""
    missed: tuple[str, ...] = field(default=())  # rooms that were not found

    @property
    def figures(self) -> dict[str, Any]:
        """The figures of `--json`; None where nothing can be counted."""
        return {
            "rooms": self.found / self.rooms,
            "rooms_strict": self.strictly / self.rooms,
            "names": self.named / self.written if self.written else None,
            "connections_p": (self.hits / self.claimed if self.claimed else float(not self.drawn))
            * float(not self.error),
            "connections_r": (self.hits / self.drawn if self.drawn else 1.0) * float(not self.error),
            "connections_f1": f1(self.hits, self.claimed, self.drawn) * float(not self.error),
            "seconds": self.seconds,
            "mb": self.mb,
            **({"error": self.error} if self.error else {}),
        }


def f1(hits: int, claimed: int, drawn: int) -> float:
    """Return the harmonic mean of precision and recall; 1 if there is nothing and nothing is claimed.

    >>> f1(3, 4, 4), f1(0, 0, 0), f1(0, 2, 0)
    (0.75, 1.0, 0.0)
    """
    return 2.0 * hits / (claimed + drawn) if claimed + drawn else 1.0


def all_plans() -> list[Plan]:
    """List all files with their truth: the dialects, the photos, the real plans."""
    return [*dialects(), *photos(), *real_plans()]


def dialects() -> list[Plan]:
    """Read the flat in the dialects of SVG; its rooms are carried to each file by their points."""
    home = np.array([at_of(box) for box in FLAT.values()])
    home[3] = (700.0, 405.0)
    folder, found = DATA / "dialects", []
    for entry in json.loads((folder / "plans.json").read_text()):
        points = np.array([room["at"] for room in entry["rooms"]], dtype=np.float64)
        matrix = np.linalg.lstsq(np.column_stack([home, np.ones(len(home))]), points, rcond=None)[0]
        bodies = tuple(shapely.Polygon(np.column_stack([box, np.ones(4)]) @ matrix) for box in flat_boxes())
        raw = (folder / entry["file"]).read_text(encoding="utf-8").casefold()
        text = raw + TAG.sub("", raw)
        names = tuple(
            room["name"] if room["name"].casefold() in text else "" for room in entry["rooms"]
        )  # some dialects have no words, or outlines of letters
        found.append(
            Plan(folder / entry["file"], "dialects", names, points, bodies, pairs(entry["connections"]))
        )
    return found


def photos() -> list[Plan]:
    """Read the flat in photos: its rooms are carried to each picture by the flat's corners."""
    frame, found = np.array([(0, 0), (1200, 0), (1200, 800), (0, 800)], dtype=np.float64), []
    for name, corners in PHOTO_CORNERS.items():
        matrix = homography(frame, np.array(corners))
        bodies = tuple(shapely.Polygon(projected(matrix, box)) for box in flat_boxes())
        points = np.array([projected(matrix, box.mean(axis=0, keepdims=True))[0] for box in flat_boxes()])
        path = DATA / "dialects" / "photos" / name
        found.append(Plan(path, "photos", ("",) * len(FLAT), points, bodies, pairs(FLAT_CONNECTIONS)))
    return found


def homography(points: np.ndarray, images: np.ndarray) -> np.ndarray:
    """Find the projective map (3, 3) that carries four points (4, 2) to their images (4, 2)."""
    rows, values = [], []
    for (x, y), image in zip(points, images, strict=True):
        for axis, value in enumerate(image):
            row = np.zeros(8)
            row[3 * axis : 3 * axis + 3] = x, y, 1.0
            row[6:] = -x * value, -y * value
            rows.append(row)
            values.append(value)
    return np.append(np.linalg.solve(np.array(rows), np.array(values)), 1.0).reshape(3, 3)


def projected(matrix: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Carry points (n, 2) by a projective map (3, 3)."""
    carried = np.column_stack([points, np.ones(len(points))]) @ matrix.T
    return np.asarray(carried[:, :2] / carried[:, 2:])


def real_plans() -> list[Plan]:
    """Read the plans of others."""
    folder, found = DATA / "plans", []
    for entry in json.loads((folder / "plans.json").read_text()):
        path = folder / entry["file"]
        points = np.array([room["at"] for room in entry["rooms"]], dtype=np.float64)
        silent = UNWRITTEN.get(path.name, ())
        names = tuple(
            "" if number in silent or path.suffix in PICTURES else room["name"]
            for number, room in enumerate(entry["rooms"])
        )
        found.append(
            Plan(
                path,
                "plans",
                names,
                points,
                discs(points),
                pairs(entry["connections"]),
                OPEN.get(path.name, ()),
            )
        )
    return found


def at_of(box: tuple[float, float, float, float]) -> tuple[float, float]:
    """Return where the truth of the dialects has its point in a room."""
    left, top, right, bottom = box
    return left + 0.3 * (right - left), top + 0.72 * (bottom - top)


def flat_boxes() -> list[np.ndarray]:
    """List the corners of the flat's rooms, (4, 2) each."""
    return [
        np.array([(left, top), (right, top), (right, bottom), (left, bottom)], dtype=np.float64)
        for left, top, right, bottom in FLAT.values()
    ]


def discs(points: np.ndarray) -> tuple[shapely.Geometry, ...]:
    """Draw about each point the disc that stands for its room."""
    gaps = np.hypot(*(points[:, None] - points[None]).transpose(2, 0, 1))
    np.fill_diagonal(gaps, np.inf)
    return tuple(shapely.buffer(shapely.points(points), DISC * gaps.min(axis=1)))


def pairs(connections: Any) -> frozenset[frozenset[int]]:  # noqa: ANN401  # as JSON has it
    """Take connections as pairs without order."""
    return frozenset(frozenset(pair) for pair in connections)


def score(plan: Plan, division: Division) -> PlanScore:
    """Compare what the program made of a file with what a person reads."""
    cells = division.cells
    holder = [cell_at(cells, point) for point in plan.points]
    open_to = open_groups(plan, holder)
    found, strictly, named = [], 0, 0
    for room, cell in enumerate(holder):
        others = [other for other, same in enumerate(holder) if same == cell and other != room]
        covers = cell >= 0 and covered(plan.bodies[room], cells[cell]) > MOST
        is_one = covers and all(open_to[other] == open_to[room] for other in others)
        found.append(is_one)
        strictly += bool(covers and not others)
        named += bool(is_one and plan.names[room] and bears(division.labels[cell], plan.names[room]))
    hits, claimed, drawn = connections(plan, division, holder, open_to)
    return PlanScore(
        plan.key,
        len(holder),
        sum(found),
        strictly,
        named,
        sum(bool(name) for name in plan.names),
        hits,
        claimed,
        drawn,
        division.seconds,
        division.mb,
        len(cells),
        division.error,
        tuple(str(room) for room, is_found in enumerate(found) if not is_found),
    )


def cell_at(cells: Sequence[shapely.Polygon], point: np.ndarray) -> int:
    """Find the cell that a point lies in; -1 if it lies in none."""
    held = [number for number, cell in enumerate(cells) if cell.covers(shapely.Point(point))]
    return min(held, key=lambda number: float(cells[number].area)) if held else -1


def covered(room: shapely.Geometry, cell: shapely.Geometry) -> float:
    """Measure the share of a room that a cell holds."""
    return float(shapely.intersection(room, shapely.make_valid(cell)).area / room.area)


def open_groups(plan: Plan, holder: list[int]) -> list[int]:
    """Give the rooms of one open space that are one cell the same number."""
    network = rustworkx.PyGraph()
    network.add_nodes_from(range(len(holder)))
    joined = [(a, b) for a, b in plan.open_pairs if holder[a] >= 0 and holder[a] == holder[b]]
    network.add_edges_from_no_data(joined)
    number = list(range(len(holder)))
    for part in rustworkx.connected_components(network):
        for room in part:
            number[room] = min(part)
    return number


def bears(label: str, name: str) -> bool:
    """Tell whether a cell's label is a room's name, or has it among its words.

    >>> bears("Kitchen, 11.2 m2", "KITCHEN"), bears("Küche", "kuche"), bears("", "hall"), bears("WC 2", "WC")
    (True, True, False, False)
    """
    wanted = plain(name)
    return wanted in {plain(label), *(plain(word) for word in re.split(r",|\n", label))}


def plain(name: str) -> str:
    """Drop case, accents, areas, sizes, descriptions in brackets and all but letters and digits.

    >>> plain("Bed Room 11' x 10'"), plain("SUÍTE"), plain("210 (cupboard 2)")
    ('bed room', 'suite', '210')
    """
    text = MEASURE.sub(" ", DESCRIPTION.sub(" ", name.casefold()))
    text = "".join(c for c in unicodedata.normalize("NFKD", text) if not unicodedata.combining(c))
    return " ".join(word for word in re.split(r"\W+", text) if word and word != "x")


def connections(
    plan: Plan, division: Division, holder: list[int], open_to: list[int]
) -> tuple[int, int, int]:
    """Count the connections that are right, those that are claimed, and those that a person reads.

    Rooms are joined if gateways lead from one's cell to the other's, also through scraps: small cells without
    a name that hold no room's point. Rooms that are wrongly one cell claim all that the cell claims. Rooms of
    an open space that are one cell count as one room, and the connection between them as found.
    """
    drawn = {frozenset(open_to[room] for room in pair) for pair in plan.connections}
    inner = sum(
        len({open_to[room] for room in pair}) == 1 for pair in plan.connections
    )  # within an open space
    drawn = {pair for pair in drawn if len(pair) == 2}
    rooms_of: dict[int, set[int]] = {}
    for room, cell in enumerate(holder):
        if cell >= 0:
            rooms_of.setdefault(cell, set()).add(open_to[room])
    beside: dict[int, set[int]] = {}
    for first, second in division.gateways:
        beside.setdefault(first, set()).add(second)
        beside.setdefault(second, set()).add(first)
    claimed = {
        frozenset((one, other))
        for cell, ones in rooms_of.items()
        for reached in reachable_rooms(cell, beside, rooms_of, division)
        for one in ones
        for other in rooms_of[reached]
        if one != other
    }
    return len(claimed & drawn) + inner, len(claimed) + inner, len(drawn) + inner


def reachable_rooms(
    cell: int, beside: dict[int, set[int]], rooms_of: dict[int, set[int]], division: Division
) -> set[int]:
    """Find the cells with rooms that are next to a cell, or behind scraps alone."""
    found, seen, front = set(), {cell}, [cell]
    while front:
        for other in beside.get(front.pop(), set()) - seen:
            seen.add(other)
            if other in rooms_of:
                found.add(other)
            elif division.small[other] and not division.labels[other]:
                front.append(other)
    return found
