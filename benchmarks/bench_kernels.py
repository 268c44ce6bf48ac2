"""Time kernels beside the slow oracles that tests hold them to; `make bench` runs this.

A kernel and its oracle share a group, so that the table tells how many times faster the kernel is.
"""

import math

import numpy as np
import pytest
from pytest_benchmark.fixture import BenchmarkFixture

import grid_oracles
import oracles
import registration_oracles
from pilotage.geometry import Array
from pilotage.kernels import evolution_compiled, visibility
from pilotage.kernels.local_grid import DEAREST, DIAGONAL, STRAIGHT, clearances, flood
from pilotage.kernels.pose_search import add_place_scores
from pilotage.kernels.raycast import cast
from pilotage.kernels.samples import Samples
from pilotage.kernels.segment_field import SegmentField, build_segment_field
from pilotage.kernels.segment_sampling import sample_segments
from pilotage.kernels.steps import Steps
from pilotage.kernels.sweep import sweep
from pilotage.kernels.tangent import arc_dissimilarity

ROOM = np.array(
    [
        [-3.0, -2.0, 3.0, -2.0],
        [3.0, -2.0, 3.0, 2.0],
        [3.0, 2.0, 1.0, 2.0],
        [1.0, 2.0, 1.0, 1.0],
        [1.0, 1.0, -3.0, 1.0],
        [-3.0, 1.0, -3.0, -2.0],
    ]
)
DIRECTIONS, SIDE = 180, 40
GRID = (-3.0, -2.0, 0.15, SIDE, SIDE)


def once(benchmark: BenchmarkFixture, slow: object, *arguments: object, **options: object) -> None:
    """Time a slow oracle three times."""
    benchmark.pedantic(slow, arguments, options, rounds=3)


def lobed_outline(vertices: int) -> Array:
    """Draw a closed, noisy outline with five bulges, (n, 2) [m]."""
    directions = np.linspace(0.0, math.tau, vertices, endpoint=False)
    radii = 3.0 + np.cos(5 * directions) + np.random.default_rng(1).normal(0.0, 0.01, vertices)
    return radii[:, None] * np.column_stack([np.cos(directions), np.sin(directions)])


@pytest.mark.benchmark(group="evolution of 60 vertices")
class TestEvolution:
    """Eq. (1): simplify an outline."""

    OUTLINE = lobed_outline(60)

    def test_kernel(self, benchmark: BenchmarkFixture) -> None:
        """Compiled."""
        arguments = (self.OUTLINE, np.array([0, 60]), np.array([True]), 0.03)
        evolution_compiled.evolve_runs(*arguments)
        benchmark(evolution_compiled.evolve_runs, *arguments)

    def test_oracle(self, benchmark: BenchmarkFixture) -> None:
        """Look at all vertices again before each deletion."""
        once(benchmark, oracles.evolve_runs, [self.OUTLINE], [True], 0.03)


@pytest.mark.benchmark(group="dissimilarity of two arcs of 8 segments, eq. (2)")
class TestArcDissimilarity:
    """Eq. (2): compare tangent functions."""

    ARCS = tuple(
        (rng.uniform(0.1, 2.0, 8), rng.uniform(-4.0, 4.0, 8)) for rng in map(np.random.default_rng, (0, 1))
    )

    def test_kernel(self, benchmark: BenchmarkFixture) -> None:
        """Merged integrals."""
        c, d = (Steps(np.concatenate([[0.0], np.cumsum(along)]), turns) for along, turns in self.ARCS)
        arc_dissimilarity(c, 0, 8, d, 0, 8)
        benchmark(arc_dissimilarity, c, 0, 8, d, 0, 8)

    def test_oracle(self, benchmark: BenchmarkFixture) -> None:
        """Fine samples."""
        once(benchmark, oracles.arc_dissimilarity, *self.ARCS)


@pytest.mark.benchmark(group="clearances in 60 x 60 cells")
class TestClearances:
    """Distances to the nearest occupied cell."""

    EVIDENCE = np.random.default_rng(0).choice([1, -1], p=[0.05, 0.95], size=(60, 60)).astype(np.int8)

    def test_kernel(self, benchmark: BenchmarkFixture) -> None:
        """Distance transform."""
        clearances(self.EVIDENCE, 20)
        benchmark(clearances, self.EVIDENCE, 20)

    def test_oracle(self, benchmark: BenchmarkFixture) -> None:
        """Each cell against each occupied one."""
        once(benchmark, grid_oracles.clearances, self.EVIDENCE, 20)


@pytest.mark.benchmark(group="reachable cells of 60 x 60")
class TestReachable:
    """The cheapest ways to all cells."""

    EVIDENCE = TestClearances.EVIDENCE

    def test_kernel(self, benchmark: BenchmarkFixture) -> None:
        """Dijkstra with buckets."""
        clearance = clearances(self.EVIDENCE, 6)
        flood(self.EVIDENCE, clearance, (30, 30), 1.0, 3.0, 3.0)
        benchmark(flood, self.EVIDENCE, clearance, (30, 30), 1.0, 3.0, 3.0)

    def test_oracle(self, benchmark: BenchmarkFixture) -> None:
        """Dijkstra with a heap."""
        once(
            benchmark,
            grid_oracles.cheapest_costs,
            self.EVIDENCE,
            clearances(self.EVIDENCE, 6),
            (30, 30),
            tight=1.0,
            easy=3.0,
            freed=3.0,
            prices=(STRAIGHT, DIAGONAL, DEAREST),
        )


@pytest.mark.benchmark(group="score of one pose in a segment field")
class TestPlaceScore:
    """How well samples of a scan lie on the local map."""

    @pytest.fixture
    def seen(self) -> tuple[SegmentField, Samples]:
        """Return the room as a field, and as samples."""
        points, directions, weights, _ = sample_segments(ROOM, 0.1)
        return build_segment_field(ROOM, 0.1, 0.6), Samples(points, directions, weights)

    def test_kernel(self, benchmark: BenchmarkFixture, seen: tuple[SegmentField, Samples]) -> None:
        """Compiled, over all samples."""
        field, samples = seen
        scores, place = np.zeros((1, 1)), np.array([0.1, 0.1])
        add_place_scores(scores, samples, field, place, 0.1, 1, 0.3, 0.5)
        benchmark(add_place_scores, scores, samples, field, place, 0.1, 1, 0.3, 0.5)

    def test_oracle(self, benchmark: BenchmarkFixture, seen: tuple[SegmentField, Samples]) -> None:
        """Sample by sample."""
        field, samples = seen
        once(
            benchmark,
            registration_oracles.place_score,
            samples,
            field,
            (0.1, 0.1, 0.1),
            width=0.3,
            min_cosine=0.5,
        )


@pytest.mark.benchmark(group="ranges in 180 directions from 1600 places")
class TestRanges:
    """What a range table holds."""

    PLACES = np.stack(np.meshgrid(np.linspace(-2.9, 0.9, 40), np.linspace(-1.9, 0.9, 40)), -1).reshape(-1, 2)

    def test_kernel(self, benchmark: BenchmarkFixture) -> None:
        """Sweep a line around each place."""
        sweep(self.PLACES, ROOM, DIRECTIONS, 20.0)
        benchmark(sweep, self.PLACES, ROOM, DIRECTIONS, 20.0)

    def test_oracle(self, benchmark: BenchmarkFixture) -> None:
        """Cast single beams at all segments, compiled as well."""
        angles = np.tile(np.arange(DIRECTIONS) * math.tau / DIRECTIONS, len(self.PLACES))
        starts = np.repeat(self.PLACES, DIRECTIONS, axis=0)
        cast(starts[:1], angles[:1], ROOM)
        once(benchmark, cast, starts, angles, ROOM)


@pytest.mark.benchmark(group="scores of 10,000 particles, 60 beams")
def test_scores_of_particles(benchmark: BenchmarkFixture) -> None:
    """The sensor model in the range table of a room."""
    rng = np.random.default_rng(0)
    middles = np.stack(
        np.meshgrid(*(start + (np.arange(SIDE) + 0.5) * 0.15 for start in GRID[:2]), indexing="ij"), -1
    ).reshape(-1, 2)
    ranges = sweep(middles, ROOM, DIRECTIONS, 20.0)
    levels = np.log(np.maximum(ranges / 0.15, 1e-3)) / visibility.LOG_STEP + visibility.LOG_ZERO
    states = np.vstack(
        [
            rng.uniform((-2.9, -1.9, -math.pi), (2.9, 1.9, math.pi), (10_000, 3)).T,
            rng.normal(0.0, 0.1, (3, 10_000)),
        ]
    )
    beams = np.arange(60, dtype=np.int32) * (visibility.HEADINGS // 60)
    scan_levels = np.round(np.log(rng.uniform(0.5, 5.0, 60)) / visibility.LOG_STEP).astype(np.int32)
    arguments = (
        states,
        np.zeros((1, 3)),
        np.ones(1),
        np.array([0, 60]),
        (beams, scan_levels, np.zeros(60, dtype=np.int32)),
        np.clip(np.round(levels), 0, 255).astype(np.uint8),
        GRID,
        visibility.stretch_tables(DIRECTIONS),
        -np.abs(np.arange(-400, 401) * visibility.LOG_STEP).astype(np.float32)[np.newaxis],
        (0, 0.0),
        -1.0,
        0,
    )
    visibility.sum_over_beams(*arguments)
    benchmark(visibility.sum_over_beams, *arguments)
