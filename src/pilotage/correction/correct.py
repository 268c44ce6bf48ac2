"""The drawing as the robot found it: in metres, and what of it was seen."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pilotage.correction.corrected import (
    CorrectedDrawing,
    carried_polygon,
    carried_sketch,
    pieces_of,
    split_by_sight,
)
from pilotage.correction.fit import Fit, Surfaces, fit
from pilotage.correction.passages import find_passages
from pilotage.correction.sighting import Sighting
from pilotage.correction.similarity import CoincidingError
from pilotage.correction.walls import Carried, Pieces, associate
from pilotage.geometry import Polyline, Pose2
from pilotage.maps import Atlas, SchematicMap

BELIEVED = 0.5
"""Probability from which on an estimate is believed."""
FEWEST = 10
"""Believed sightings that a correction needs: 5 m of travel."""
AGREEING, WITHIN = 2.0 / 3.0, 2.0
"""Least share of the believed places that must lie on the path, to this distance [m]."""
SEEN_POINTS = 3
"""Surface points that show a piece of a wall ..."""
SEEN_WITHIN = 0.3
"""[m] ... if they are no farther from it."""


class NothingBelievedError(ValueError):
    """The localizer was hardly ever sure of its place, or was sure of places that contradict each other."""


def correct_drawing(atlas: Atlas, sightings: Sequence[Sighting]) -> CorrectedDrawing:
    """Move the strokes of a drawing to where the robot saw its walls, in metres.

    Raises NothingBelievedError if fewer than ten sightings have a place that is more probable than not, if
    these places are all the same, or if more than a third of them do not lie on one path.
    """
    believed = sum(one.probability >= BELIEVED for one in sightings)
    if believed < FEWEST:
        raise NothingBelievedError(
            f"a correction needs {FEWEST} keyframes of at least probability {BELIEVED:g}, got {believed}"
        )
    try:
        fitted = fit(atlas.sketch, sightings, BELIEVED)
    except CoincidingError as error:
        raise NothingBelievedError("the places that were believed must not be one and the same") from error
    found = laid_as_drawn(fitted, atlas.sketch)
    check_agreement(found, sightings)
    seen: list[Polyline] = []
    unseen: list[Polyline] = []
    sights = find_seen(atlas, sightings, found)
    for stroke, flags in zip(atlas.sketch.strokes, sights, strict=True):
        of_stroke = split_by_sight(stroke, flags, found.elastic)
        seen += of_stroke[0]
        unseen += of_stroke[1]
    graph = atlas.cell_graph
    return CorrectedDrawing(
        carried_sketch(atlas.sketch, found.elastic),
        tuple(seen),
        tuple(unseen),
        () if graph is None else find_passages(graph, sightings, found.path, found.elastic),
        () if graph is None else tuple(carried_polygon(cell.polygon, found.elastic) for cell in graph.cells),
        found.path.poses,
        found.elastic,
        max(2.0 * found.half_thickness, 0.0),
    )


def check_agreement(found: Fit, sightings: Sequence[Sighting]) -> None:
    """Raise NothingBelievedError if the places that were believed are not those of one path."""
    believed = [number for number, one in enumerate(sightings) if one.probability >= BELIEVED]
    drawn = np.array([sightings[number].sketch_from_base.translation for number in believed])
    off = np.hypot(*(found.elastic @ drawn - found.path.places[believed]).T)
    agreeing = int(np.count_nonzero(off < WITHIN))
    if agreeing < AGREEING * len(believed):
        raise NothingBelievedError(
            f"the places that were believed must agree, only {agreeing} of {len(believed)} keyframes do"
        )


def laid_as_drawn(found: Fit, sketch: SchematicMap) -> Fit:
    """Turn what was found as the drawing lies on its sheet, the lower left of the strokes at 0, 0."""
    turn = Pose2(0.0, 0.0, -found.elastic.rough.pose.theta)
    vertices = np.vstack([stroke.vertices for stroke in sketch.strokes])
    low = (turn @ (found.elastic @ vertices)).min(axis=0)
    sheet_from_odom = Pose2(-float(low[0]), -float(low[1]), turn.theta)
    poses = np.column_stack([sheet_from_odom @ found.path.places, found.path.poses[:, 2] + turn.theta])
    elastic = replace(found.elastic, coefficients=sheet_from_odom @ found.elastic.coefficients)
    return replace(found, elastic=elastic, path=replace(found.path, poses=poses))


def find_seen(atlas: Atlas, sightings: Sequence[Sighting], found: Fit) -> list[NDArray[np.bool_]]:
    """Tell which pieces of each stroke were seen."""
    of_strokes = [pieces_of(stroke, found.elastic) for stroke in atlas.sketch.strokes]
    pieces = Pieces(
        np.vstack([one.starts for one in of_strokes]),
        np.vstack([one.ends for one in of_strokes]),
    )
    surfaces, path = Surfaces.of(sightings), found.path
    points = path.from_base(surfaces.points, surfaces.owners)
    normals = path.turned(surfaces.normals, surfaces.owners)
    lasers = path.from_base(surfaces.lasers, surfaces.owners)
    carried = Carried.by(found.elastic, pieces)
    shown = associate(carried, lasers, points, normals)
    behind = ((shown.places(carried) - points[shown.points]) * normals[shown.points]).sum(axis=1)
    off = behind + found.half_thickness
    counts = np.bincount(shown.pieces[np.abs(off) < SEEN_WITHIN], minlength=len(pieces))
    bounds = np.cumsum([len(one) for one in of_strokes])[:-1]
    return [without_gaps(flags) for flags in np.split(counts >= SEEN_POINTS, bounds)]


def without_gaps(seen: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Count a single piece between two that were seen as seen, too."""
    filled = seen.copy()
    filled[1:-1] |= seen[:-2] & seen[2:]
    return filled
