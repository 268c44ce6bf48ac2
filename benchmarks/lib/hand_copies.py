"""Copy a plan by hand, by program: its rooms as single strokes in people's manner, in pen, photographed.

Rooms grow into the walls between them until they meet: there a person draws one line. Doors stay gaps.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import count
from pathlib import Path

import numpy as np
import shapely
from PIL import Image, ImageDraw

from pilotage.evaluation.deformation import Plan, deform
from pilotage.evaluation.deformation.doors import all_lines
from pilotage.evaluation.deformation.plan import with_dense_control
from pilotage.evaluation.rooms import Rooms
from pilotage.evaluation.warp import Warp
from pilotage.geometry import Array, Homography
from pilotage.maps import Cell, CellGraph

PEOPLE = 1000
"""People from the first of one seed to the first of the next: more than are ever asked for a copy."""
SEAM = 0.02
"""Space [m] between rooms that touch, so that each side has an owner."""
SPACING = 0.1
"""Distance [m] between the points of an outline that grow."""
OFF = 0.003
"""Distance [m] by which points are moved: four on a circle have no one Voronoi diagram."""
GRID = 0.001
"""Distance [m] below which points are one."""
THICKEST, OUTER = 0.8, 0.1
"""Greatest thickness [m] of a wall that becomes one line; distance [m] of outer walls from rooms."""
SMOOTH = 0.15
"""Deviations [m] of a wall that are not drawn."""
FRAME = 0.45
"""Greatest depth [m] of a doorway to either side of its gateway."""
LEAST_STROKE = 0.15
"""Length [m] below which strokes are not drawn."""

LONG_SIDE, SHORT_SIDE = 2000, 1500
"""Sides of the paper and of the photo [px]."""
MARGIN = 0.1
"""Share of the paper that stays empty around the drawing."""
PEN = 5
"""Width of the pen on paper [px]."""
PAPER, INK, TABLE = (245, 243, 238), (25, 30, 110), (0.4, 0.28, 0.2)
INSET = (0.03, 0.1)
"""Least and greatest share of the photo between its corners and those of the paper."""
SHADOW, SHADOW_SIZE = 0.35, 0.15
"""How much darker the middle of a shadow is, and how wide it is as a share of the photo."""
NOISE = 0.02


@dataclass(frozen=True, eq=False)
class HandCopy:
    """A photo of a drawing by hand, and where each place of the plan is in it."""

    photo: Image.Image
    copy: Plan
    metres_per_unit: float  # of the plan
    photo_from_copy: Homography

    def photo_from_plan(self, points: Array) -> Array:
        """Carry points (n, 2) of the plan [drawing units, y up] to the photo [px, y down]."""
        on_copy = self.copy.warp.sketch_from_world(points * self.metres_per_unit)
        return self.photo_from_copy.points(on_copy)


def copy_by_hand(lines: Plan, room: str, metres_per_unit: float, severity: float, seed: int) -> HandCopy:
    """Draw a plan [m] on paper as a person would who does not leave out this room, and take a photo of it."""
    people = (deform(lines, severity, number) for number in count(PEOPLE * seed))
    copy = next(copy for copy in people if room in copy.rooms.names)
    photo, photo_from_copy = photographed(copy, np.random.default_rng(seed))
    return HandCopy(photo, copy, metres_per_unit, photo_from_copy)


def save_photo(copy: HandCopy, path: Path) -> None:
    """Write the photo as a phone would."""
    copy.photo.save(path, quality=88)


def single_lines(graph: CellGraph, cells: Sequence[Cell], metres_per_unit: float) -> Plan:
    """Draw rooms [m] with one line for each wall, and gaps for gateways."""
    rooms = [shapely.transform(cell.polygon, lambda points: points * metres_per_unit) for cell in cells]
    grown = grow(rooms)
    walls = shapely.union_all([room.boundary for room in grown])
    ids = {cell.cell_id for cell in cells}
    gaps = [
        shapely.buffer(shapely.LineString(gateway.segment * metres_per_unit), FRAME, cap_style="flat")
        for gateway in graph.gateways
        if ids.issuperset(gateway.cell_ids)
    ]
    drawn = shapely.line_merge(shapely.difference(walls, shapely.union_all(gaps)))
    strokes = shapely.MultiLineString([line for line in all_lines(drawn) if line.length > LEAST_STROKE])
    corners = shapely.get_coordinates(shapely.box(*shapely.total_bounds(strokes)))[:4]
    names = tuple(cell.cell_id for cell in cells)
    return with_dense_control(Plan(strokes, Rooms(names, tuple(map(largest, grown))), Warp(corners, corners)))


def grow(rooms: Sequence[shapely.Polygon]) -> list[shapely.MultiPolygon]:
    """Let rooms [m] grow until they meet in the middle of the walls between them."""
    shrunk = [shapely.segmentize(room.buffer(-SEAM), SPACING) for room in rooms]
    owners = np.repeat(np.arange(len(rooms)), [shapely.get_num_coordinates(room) for room in shrunk])
    points = np.vstack([shapely.get_coordinates(room) for room in shrunk])
    points += np.random.default_rng(0).normal(0.0, OFF, points.shape)
    floor = shapely.union_all(rooms).buffer(THICKEST / 2.0, join_style="mitre")
    floor = floor.buffer(OUTER - THICKEST / 2.0, join_style="mitre")
    pieces = shapely.get_parts(shapely.voronoi_polygons(shapely.multipoints(points), extend_to=floor))
    tree = shapely.STRtree(shapely.points(points))
    at, inside = tree.query(pieces, predicate="contains")
    owner_of = np.zeros(len(pieces), dtype=np.intp)
    owner_of[at] = owners[inside]
    whole = [shapely.union_all(pieces[owner_of == k], grid_size=GRID) for k in range(len(rooms))]
    smooth = shapely.buffer(shapely.coverage_simplify(whole, SMOOTH), 0.0)  # valid
    return list(map(areas_of, shapely.intersection(smooth, floor, grid_size=GRID)))


def areas_of(geometry: shapely.Geometry) -> shapely.MultiPolygon:
    """Leave out what has no area."""
    return shapely.MultiPolygon([part for part in shapely.get_parts(geometry) if part.area > 0.0])


def largest(geometry: shapely.Geometry) -> shapely.Polygon:
    """Return the largest polygon of a geometry."""
    return max(shapely.get_parts(geometry), key=shapely.area)


def photographed(copy: Plan, rng: np.random.Generator) -> tuple[Image.Image, Homography]:
    """Draw strokes in pen on paper, and take a photo from one side, in bad light."""
    left, bottom, right, top = shapely.total_bounds(copy.strokes).tolist()
    wide = right - left > top - bottom
    size = np.array([LONG_SIDE, SHORT_SIDE] if wide else [SHORT_SIDE, LONG_SIDE])
    zoom = float(np.min((1.0 - 2.0 * MARGIN) * size / (right - left, top - bottom)))
    shift = size / 2.0 - zoom * np.array([left + right, -bottom - top]) / 2.0
    paper_from_copy = np.array([[zoom, 0.0, shift[0]], [0.0, -zoom, shift[1]], [0.0, 0.0, 1.0]])
    paper = Image.new("RGB", tuple(size.tolist()), PAPER)
    pen = ImageDraw.Draw(paper)
    for line in copy.strokes.geoms:
        points = shapely.get_coordinates(line) * (zoom, -zoom) + shift
        pen.line([tuple(point) for point in points.tolist()], fill=INK, width=PEN, joint="curve")
    frame = np.array([(0, 0), (1, 0), (1, 1), (0, 1)]) * size
    inward = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)]) * size
    corners = frame + rng.uniform(*INSET, (4, 2)) * inward
    photo_from_paper = Homography.between(frame, corners)
    photo = lit(seen(paper, corners, photo_from_paper), rng)
    return photo, Homography.from_matrix(photo_from_paper.matrix @ paper_from_copy)


def seen(paper: Image.Image, corners: Array, photo_from_paper: Homography) -> Array:
    """Lay paper on a table: colors (rows, columns, 3) from 0 to 1."""
    matrix = photo_from_paper.inverse.matrix
    matrix = matrix / matrix[2, 2]
    sheet = paper.transform(
        paper.size, Image.Transform.PERSPECTIVE, matrix.ravel()[:8].tolist(), Image.Resampling.BICUBIC
    )
    mask = Image.new("1", paper.size)
    ImageDraw.Draw(mask).polygon([tuple(corner) for corner in corners.tolist()], fill=1)
    return np.where(np.asarray(mask)[..., None], np.asarray(sheet) / 255.0, TABLE)


def lit(colors: Array, rng: np.random.Generator) -> Image.Image:
    """Let a shadow fall on colors (rows, columns, 3), and add the noise of a camera."""
    rows, columns = colors.shape[:2]
    y, x = np.mgrid[:rows, :columns]
    middle = rng.uniform(0.3, 0.9, 2) * (columns, rows)
    width = SHADOW_SIZE * math.hypot(columns, rows)
    dark = 1.0 - SHADOW * np.exp(-((x - middle[0]) ** 2 + (y - middle[1]) ** 2) / (2.0 * width**2))
    noisy = colors * dark[..., None] + rng.normal(0.0, NOISE, (rows, columns, 1))
    return Image.fromarray((255.0 * np.clip(noisy, 0.0, 1.0)).astype(np.uint8))
