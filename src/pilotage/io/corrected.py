"""Write a corrected drawing in metres: as SVG, or as a map_server map for nav2.

Both are in the same frame and can be read again, as drawings and as worlds to drive in.
"""

import math
from html import escape
from pathlib import Path

import numpy as np
import shapely
from PIL import Image, ImageDraw

from pilotage.correction import CorrectedDrawing, PassageState
from pilotage.errors import FileError
from pilotage.geometry import Array, Polyline
from pilotage.interpretation import ZONE_ROLES
from pilotage.io.files import replacing, write_text
from pilotage.io.svg.reader import SCALE
from pilotage.maps import Zones

SVG_ENDINGS, MAP_ENDINGS = (".svg",), (".yaml", ".yml")
MARGIN = 1.0
"""[m] around the drawing."""
PIXEL = 0.05
"""[m] of a map, at least."""
MOST_PIXELS = 6_000
"""Pixels of a map to a side, at most."""
FREE, UNKNOWN, OCCUPIED = 254, 205, 0
THINNEST = 0.05
"""[m] Width of a wall on paper, at least."""
PASSAGE_COLORS = {
    PassageState.OPEN: "#2a9d3a",
    PassageState.CLOSED: "#c1272d",
    PassageState.UNSEEN: "#999999",
}


def check_ending(path: Path) -> None:
    """Raise FileError for a file that is neither SVG nor YAML by its name."""
    if path.suffix.lower() not in SVG_ENDINGS + MAP_ENDINGS:
        raise FileError("a corrected drawing must end in .svg, .yaml or .yml", path)


def files_of(path: Path) -> tuple[Path, ...]:
    """Return all files that are written: a map has a picture beside it."""
    return (path, picture_of(path)) if path.suffix.lower() in MAP_ENDINGS else (path,)


def write_corrected(corrected: CorrectedDrawing, path: Path) -> None:
    """Write as the ending of the path tells; files that are there are replaced."""
    check_ending(path)
    if path.suffix.lower() in SVG_ENDINGS:
        write_text(path, svg_text(corrected))
    else:
        write_map(corrected, path)


def svg_text(corrected: CorrectedDrawing) -> str:
    """Write as SVG whose unit is the metre: walls that were never seen are dashed."""
    left, bottom, right, top = bounds_of(corrected)
    width, height = right - left, top - bottom
    pen = max(corrected.wall_thickness, THINNEST)
    size = 0.02 * math.hypot(width, height)
    dashes = f'stroke-dasharray="{num(3.0 * pen)} {num(3.0 * pen)}"'
    parts = [
        (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{num(20 * width)}" height="{num(20 * height)}"'
            f' viewBox="{num(left)} {num(-top)} {num(width)} {num(height)}" {SCALE}="1">'
        ),
        (
            f"<desc>A drawing as a robot found it. Its unit is the metre; on the sheet a metre was "
            f"{num(corrected.scale)} units. Dashed walls were never seen.</desc>"
        ),
        (
            f'<g id="walls" class="wall" fill="none" stroke="black" stroke-width="{num(pen)}"'
            ' stroke-linecap="round" stroke-linejoin="round">'
        ),
        *(path_of(line) for line in corrected.seen),
        "</g>",
        f'<g id="walls-unseen" class="wall" fill="none" stroke="black" stroke-width="{num(pen)}" {dashes}>',
        *(path_of(line) for line in corrected.unseen),
        "</g>",
        f'<g id="found" class="ignore" fill="none" stroke-width="{num(0.6 * pen)}">',
        *(
            path_of(
                Polyline(passage.segment),
                f'stroke="{PASSAGE_COLORS[passage.state]}" id="{passage.state.value}-{passage.gateway_id}"',
            )
            for passage in corrected.passages
        ),
        f'<path d="M {num(left + 0.5)} {num(-bottom - 0.4)} h 5" stroke="black" stroke-width="0.1"/>',
        (
            f'<text x="{num(left + 5.7)}" y="{num(-bottom - 0.3)}" font-size="{num(0.8 * size)}" fill="black"'
            ' stroke="none">5 m</text>'
        ),
        "</g>",
        f'<g id="labels" class="label" font-size="{num(size)}" text-anchor="middle">',
        *(
            f'<text x="{num(label.position[0])}" y="{num(-label.position[1])}">{escape(label.text)}</text>'
            for label in corrected.sketch.labels
        ),
        "</g>",
        *zone_marks(corrected.sketch.zones),
        *mark("start", corrected.sketch.start, size),
        *mark("goal", corrected.sketch.goal, size),
        "</svg>",
    ]
    return "\n".join(parts) + "\n"


def path_of(line: Polyline, attributes: str = "") -> str:
    """Write a polyline as a path."""
    points = " ".join(f"{num(x)} {num(-y)}" for x, y in line.vertices.tolist())
    return f'<path d="M {points}{" Z" if line.closed else ""}"{attributes and " " + attributes}/>'


def zone_marks(zones: Zones) -> list[str]:
    """Write where not to drive, where to drive slowly, and which way to pass, by the names of their roles."""
    return [
        path_of(line, f'class="{role.value}" fill="none" stroke="gray" stroke-width="{num(THINNEST)}"')
        for role, lines in zip(ZONE_ROLES, zones.lines, strict=True)
        for line in lines
    ]


def mark(name: str, place: tuple[float, float] | None, size: float) -> list[str]:
    """Write the mark of the start or the goal, if there is one."""
    if place is None:
        return []
    return [f'<circle class="{name}" cx="{num(place[0])}" cy="{num(-place[1])}" r="{num(size / 4)}"/>']


def num(value: float) -> str:
    """Write a length [m] to the millimetre.

    >>> num(-0.0001), num(2.5)
    ('0', '2.5')
    """
    return f"{round(value, 3) + 0.0:.3f}".rstrip("0").rstrip(".")


def write_map(corrected: CorrectedDrawing, path: Path) -> None:
    """Write a picture and, last, the YAML file that names it."""
    left, bottom, right, top = bounds_of(corrected)
    pixel = max(PIXEL, max(right - left, top - bottom) / MOST_PIXELS)
    size = (math.ceil((right - left) / pixel), math.ceil((top - bottom) / pixel))
    picture = Image.new("L", size, UNKNOWN)
    brush = ImageDraw.Draw(picture)

    def pixels(points: Array) -> list[tuple[float, float]]:
        x, y = (points[:, 0] - left) / pixel, size[1] - (points[:, 1] - bottom) / pixel
        return list(zip(x.tolist(), y.tolist(), strict=True))

    free = shapely.union_all([polygon.buffer(pixel) for polygon in corrected.floor])
    for polygon in shapely.get_parts(free):
        brush.polygon(pixels(shapely.get_coordinates(polygon.exterior)), fill=FREE)
        for hole in polygon.interiors:
            brush.polygon(pixels(shapely.get_coordinates(hole)), fill=UNKNOWN)
    width = max(1, round(corrected.wall_thickness / pixel))
    for stroke in corrected.sketch.strokes:
        brush.line(pixels(stroke.ring), fill=OCCUPIED, width=width)
    picture_path = picture_of(path)
    with replacing(picture_path) as beside:
        picture.save(beside, format="PNG")
    write_text(
        path,
        f"image: {picture_path.name}\nmode: trinary\nresolution: {pixel:g}\n"
        f"origin: [{num(left)}, {num(bottom)}, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
    )


def picture_of(path: Path) -> Path:
    """Return the file of a map's picture."""
    return path.with_suffix(".png")


def bounds_of(corrected: CorrectedDrawing) -> tuple[float, float, float, float]:
    """Left, bottom, right and top of the drawing with a margin [m], rounded to the millimetre."""
    left, bottom, right, top = np.array(corrected.sketch.bounds)
    low = np.floor((np.array([left, bottom]) - MARGIN) * 1e3) / 1e3
    high = np.ceil((np.array([right, top]) + MARGIN) * 1e3) / 1e3
    return float(low[0]), float(low[1]), float(high[0]), float(high[1])
