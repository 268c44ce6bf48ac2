"""Fit an elastic map, the robot's path and the thickness of walls to sightings: sparse least squares.

Non-rigid registration as in Amberg, Romdhani and Vetter 2007: associate, solve, associate again, with a
stiffness that falls. The unknowns are the map's coefficients, changes of the path's knots, and half the
thickness of a wall, which is drawn as one stroke and seen from two sides.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import block_diag, coo_matrix, csr_matrix, diags, hstack, vstack
from scipy.sparse.linalg import splu
from scipy.spatial import cKDTree

from pilotage.correction.sighting import Sighting
from pilotage.correction.similarity import robust, robust_similarity
from pilotage.correction.spline import ElasticMap, Rows, SplineGrid
from pilotage.correction.trajectory import Path, path_of
from pilotage.correction.walls import Carried, Pieces, associate, find_posts
from pilotage.geometry import Array, Polyline
from pilotage.maps import SchematicMap

SPACING = 1.5
"""[m] Distance between the nodes of the spline's grid."""
MOST_NODES = 6_000
"""Nodes of the grid, at most."""
STAGES = ((300.0, 1.5, 6), (300.0, 1.0, 2), (100.0, 0.5, 2))
"""Stiffness of the bending energy, gate of the robust kernel [m] and rounds of each stage."""
RIGIDITY = 0.3
"""Weight of the squared gradient's difference from the similarity: what is not seen keeps its shape."""
WALL_STD = 0.1
"""[m] Standard deviation of a surface point from its wall."""
POST_STD = 0.07
"""[m] Standard deviation of an edge from the post that it is taken for."""
INDEPENDENT_POINTS = 8.0
"""Number of independent surface points in a sighting: more of them err together."""
THICKNESS_STD = 0.01
"""[m] Standard deviation of half the thickness of a wall around 0, before anything is seen."""
PLACE_STD, PLACE_STD_SHARE = 0.7, 0.15
"""[m, share of its distance] Standard deviation of where an estimate puts a point near the robot."""
LATER_WEIGHT = 0.05
"""Weight of the estimates once walls are associated."""
NEAR, EVERY = 6.0, 6
"""Of the surface points within this distance [m] every sixth goes with the estimate."""
ESTIMATE_GATE, MIN_ESTIMATE_GATE = 4.0, 2.0
"""Gate for estimates, as a multiple of that for walls, and at least [m]: places are known less exactly."""
POST_GATE, POST_REACH = 0.5, 1.5
"""Gate for posts, and distance up to which an edge may show one, as multiples of the gate for walls."""
HELD = 1e6
"""Information that holds the first pose where it began [1/m^2, 1/rad^2]."""
LOOSE_KNOT, LOOSE_NODE = 1e-3, 1e-6
"""Information on all other knots and on nodes: next to none, but the equations always have a solution."""


@dataclass(frozen=True, eq=False)
class Points:
    """Points of all sightings in one array, each in the frame of its sighting."""

    points: Array  # (m, 2) [m]
    owners: NDArray[np.intp]  # (m,) numbers of sightings


@dataclass(frozen=True, eq=False)
class Surfaces(Points):
    """Surface points."""

    normals: Array  # (m, 2)
    lasers: Array  # (m, 2) where the beams began [m]

    @classmethod
    def of(cls, sightings: Sequence[Sighting]) -> "Surfaces":
        """Join those of all sightings."""
        counts = [len(one.points) for one in sightings]
        return cls(
            np.vstack([one.points for one in sightings]),
            np.repeat(np.arange(len(sightings)), counts),
            np.vstack([one.normals for one in sightings]),
            np.repeat(np.array([one.laser for one in sightings]), counts, axis=0),
        )


@dataclass(frozen=True, eq=False)
class Beliefs(Points):
    """Points around the robot, and where the believed estimates put them on the drawing."""

    in_sketch: Array  # (m, 2) [drawing units]
    weights: Array  # (m,) reciprocal standard deviation [1/m]

    @classmethod
    def of(cls, sightings: Sequence[Sighting], believed: float) -> "Beliefs":
        """Take the robot itself and some surface points of each sighting that is at least so probable."""
        points, owners, in_sketch, weights = [], [], [], []
        for number, one in enumerate(sightings):
            if one.probability < believed:
                continue
            near = one.points[np.hypot(*one.points.T) < NEAR][::EVERY]
            here = np.vstack([np.zeros((1, 2)), near])
            points.append(here)
            owners.append(np.full(len(here), number))
            in_sketch.append(one.sketch_from_base @ here)
            std = PLACE_STD + PLACE_STD_SHARE * np.hypot(*here.T)
            weights.append(np.sqrt(one.probability / len(here)) / std)
        return cls(np.vstack(points), np.concatenate(owners), np.vstack(in_sketch), np.concatenate(weights))


@dataclass(frozen=True, eq=False)
class Fit:
    """What was found."""

    elastic: ElasticMap  # from the drawing to metres
    path: Path
    half_thickness: float  # [m]


def fit(sketch: SchematicMap, sightings: Sequence[Sighting], believed: float) -> Fit:
    """Fit to sightings, of which at least one is as probable as `believed`.

    Raises CoincidingError if the places that are believed are all the same.
    """
    path = path_of([one.odom_from_base for one in sightings], np.array([one.travel for one in sightings]))
    surfaces, beliefs = Surfaces.of(sightings), Beliefs.of(sightings, believed)
    rough = robust_similarity(
        beliefs.in_sketch, path.from_base(beliefs.points, beliefs.owners), beliefs.weights
    )
    ends = rough @ sketch.segments.reshape(-1, 2)
    grid = SplineGrid.over(ends, SPACING, MOST_NODES)
    found = Fit(ElasticMap(rough, grid, grid.nodes), path, 0.0)
    posts = find_posts([Polyline(rough @ stroke.vertices, stroke.closed) for stroke in sketch.strokes])
    edges = Points(
        np.vstack([one.edges for one in sightings]),
        np.repeat(np.arange(len(sightings)), [len(one.edges) for one in sightings]),
    )
    problem = Problem(Pieces.of(ends.reshape(-1, 4)), surfaces, beliefs, grid, posts, edges)
    for number, (stiffness, gate, rounds) in enumerate(STAGES):
        for turn in range(rounds):
            by_estimates = number == 0 and turn < rounds - 1  # walls are not associated yet
            found = problem.solved(found, stiffness, gate, by_estimates=by_estimates)
    return found


class Problem:
    """The equations, linear around the last solution."""

    def __init__(  # noqa: PLR0917  # each once
        self,
        pieces: Pieces,
        surfaces: Surfaces,
        beliefs: Beliefs,
        grid: SplineGrid,
        posts: Array,
        edges: Points,
    ) -> None:
        self.posts, self.edges = posts, edges
        self.pieces, self.surfaces, self.beliefs, self.grid = pieces, surfaces, beliefs, grid
        bending, gradient = grid.bending, grid.gradient
        self._bending = bending.T @ bending
        self._rigid = RIGIDITY * gradient.T @ gradient
        self._rigid_sums = self._rigid @ grid.nodes

    def solved(self, last: Fit, stiffness: float, gate: float, *, by_estimates: bool) -> Fit:
        """Solve once around the last solution."""
        rows, wanted = zip(*self._equations(last, gate, by_estimates=by_estimates), strict=True)
        matrix, right = vstack(rows).tocsr(), np.concatenate(wanted)
        nodes, knots = len(self.grid.nodes), len(last.path.knots)
        smooth = stiffness * self._bending + self._rigid
        path_prior = np.full(3 * knots + 1, LOOSE_KNOT)
        path_prior[:3] = HELD
        path_prior[-1] = 1.0 / THICKNESS_STD**2
        prior = block_diag([smooth + LOOSE_NODE * diags(np.ones(nodes))] * 2 + [diags(path_prior)])
        sums = matrix.T @ right
        sums[:nodes] += self._rigid_sums[:, 0]
        sums[nodes : 2 * nodes] += self._rigid_sums[:, 1]
        normal = (matrix.T @ matrix + prior).tocsc()
        solution = splu(
            normal, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True}
        ).solve(sums)
        elastic = replace(last.elastic, coefficients=solution[: 2 * nodes].reshape(2, nodes).T)
        return Fit(elastic, last.path.changed(solution[2 * nodes : -1]), float(solution[-1]))

    def _equations(self, last: Fit, gate: float, *, by_estimates: bool) -> list[tuple[Rows, Array]]:
        """Weighted rows on all unknowns and what they should be."""
        nodes = len(self.grid.nodes)
        motions, wanted = last.path.motion_rows()
        front, back = csr_matrix((len(wanted), 2 * nodes)), csr_matrix((len(wanted), 1))
        equations = [(hstack([front, motions, back]), wanted)]
        equations += self._belief_rows(
            last, max(ESTIMATE_GATE * gate, MIN_ESTIMATE_GATE), 1.0 if by_estimates else LATER_WEIGHT
        )
        if not by_estimates and len(self.surfaces.points):
            equations.append(self._wall_rows(last, gate))
        if not by_estimates and len(self.posts) and len(self.edges.points):
            equations += self._post_rows(last, gate)
        return equations

    def _belief_rows(self, last: Fit, gate: float, share: float) -> list[tuple[Rows, Array]]:
        """Say that a point lies where the place of the drawing lies at which the estimate put it."""
        beliefs, path = self.beliefs, last.path
        basis = self.grid.basis(last.elastic.roughly(beliefs.in_sketch))
        targets = path.from_base(beliefs.points, beliefs.owners)
        off = np.hypot(*(basis @ last.elastic.coefficients - targets).T)
        weights = beliefs.weights * np.sqrt(share * robust(off, gate))
        weighted = basis.multiply(weights[:, np.newaxis])
        return self._point_rows(path, beliefs.owners, targets, weighted, weights)

    def _wall_rows(self, last: Fit, gate: float) -> tuple[Rows, Array]:
        """Say that a surface point lies half a thickness before the wall that it shows."""
        path, surfaces = last.path, self.surfaces
        points = path.from_base(surfaces.points, surfaces.owners)
        normals = path.turned(surfaces.normals, surfaces.owners)
        lasers = path.from_base(surfaces.lasers, surfaces.owners)
        shown = associate(Carried.by(last.elastic, self.pieces), lasers, points, normals)
        owners, points, normals = surfaces.owners[shown.points], points[shown.points], normals[shown.points]
        basis = self.grid.basis(shown.places(self.pieces))
        off = ((basis @ last.elastic.coefficients - points) * normals).sum(axis=1) + last.half_thickness
        kernel = robust(off, gate)
        counts = np.bincount(owners, kernel, len(path.poses))[owners]
        weights = np.sqrt(kernel * np.minimum(1.0, INDEPENDENT_POINTS / np.maximum(counts, 1.0))) / WALL_STD
        direction = normals * weights[:, np.newaxis]
        arms = points - path.places[owners]
        turning = direction[:, 1] * arms[:, 0] - direction[:, 0] * arms[:, 1]
        rows = hstack(
            [
                basis.multiply(direction[:, :1]),
                basis.multiply(direction[:, 1:]),
                pose_rows(path, owners, -direction, -turning),
                csr_matrix(weights[:, np.newaxis]),
            ]
        )
        return rows, (direction * points).sum(axis=1)

    def _post_rows(self, last: Fit, gate: float) -> list[tuple[Rows, Array]]:
        """Say that a seen edge is the post nearest to it."""
        path, edges = last.path, self.edges
        basis = self.grid.basis(self.posts)
        points = path.from_base(edges.points, edges.owners)
        off, nearest = cKDTree(basis @ last.elastic.coefficients).query(points)
        chosen = np.flatnonzero(off < POST_REACH * gate)
        owners, points = edges.owners[chosen], points[chosen]
        weights = np.sqrt(robust(off[chosen], POST_GATE * gate)) / POST_STD
        weighted = basis[nearest[chosen]].multiply(weights[:, np.newaxis])
        return self._point_rows(path, owners, points, weighted, weights)

    def _point_rows(
        self, path: Path, owners: NDArray[np.intp], points: Array, weighted: Rows, weights: Array
    ) -> list[tuple[Rows, Array]]:
        """Say that points lie where a basis, already weighted, puts them."""
        arms = points - path.places[owners]
        empty, last_column = csr_matrix(weighted.shape), csr_matrix((len(weights), 1))
        equations = []
        for axis, arm in ((0, -arms[:, 1]), (1, arms[:, 0])):
            direction = np.zeros((len(weights), 2))
            direction[:, axis] = weights
            knots = pose_rows(path, owners, -direction, -weights * arm)
            maps = [weighted, empty] if axis == 0 else [empty, weighted]
            equations.append((hstack([*maps, knots, last_column]), weights * points[:, axis]))
        return equations


def pose_rows(path: Path, owners: NDArray[np.intp], moving: Array, turning: Array) -> Rows:
    """Rows on changes of the knots, from those on moves (m, 2) and turns (m,) of the poses (m,)."""
    count = len(owners)
    columns = np.concatenate([3 * owners, 3 * owners + 1, 3 * owners + 2])
    values = np.concatenate([moving[:, 0], moving[:, 1], turning])
    rows = coo_matrix((values, (np.tile(np.arange(count), 3), columns)), shape=(count, 3 * len(path.poses)))
    return rows.tocsr() @ path.pose_changes
