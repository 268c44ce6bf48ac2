"""A clustered particle filter: tracks compete by evidence, one of them says "no place here".

Clusters of particles are resampled apart, each keeping its mass, so that a place is given up only because of
evidence and never by chance (Milstein, Sanchez and Williamson 2002; Vermaak, Doucet and Perez 2003). All
masses together are 1. The null track, "on no place of this drawing", is not moved; its likelihood is that of
ranges in any building, and all other likelihoods are ratios to it.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from pilotage import kernels
from pilotage.geometry import Array
from pilotage.localization.particles import LOG_SCALE, Particles, join, weighted_sum
from pilotage.maps import Atlas

BLOCK = 1.0
"""[m] Particles in neighboring blocks of this size belong to one track ..."""
SECTORS = 12
"""... if their headings lie in neighboring sectors as well; this is the number of sectors."""
ROWS = 4_096
"""Numbers of rows and of columns of blocks: what lies farther off shares the outermost."""
MIN_SHARE = 1e-8
"""Share of the mass on the drawing below which a block is pruned, if not all blocks are that small.

Places that a search finds begin with hardly more, and some need tens of metres to show their worth.
"""
MINOR_SHARE = 0.02
"""Tracks with a smaller share get few particles."""
MINOR_COUNT = (500, 1_500)
"""Least and largest number of particles of a track with a small share."""
FEWEST = 100
"""Least number of particles of a track."""
EXCESS = 10
"""All tracks together have at most this many times `max_count` particles: of very many each gets fewer."""
RARE = (1e-12, 0.5)
"""Limits of a probability that the robot left the drawing or was carried: neither never nor nearly always."""
RESAMPLE_BELOW = 0.5
"""Effective share of particles below which a track is resampled."""


@dataclass(frozen=True, slots=True)
class TrackSettings:
    """Number of particles, and how tracks are born and end."""

    first_count: int = 120_000  # particles before the first scan, if the robot may be anywhere
    max_count: int = 30_000  # particles of all tracks, at most
    min_count: int = 4_000  # particles of a leading track
    count_per_area: int = 1_000  # particles for each square metre over which a track is spread
    first_null: float = 0.2  # probability, before the first scan, that the robot is nowhere on the drawing
    leaving: float = 0.0005  # probability per metre that the robot leaves what is drawn
    moving: float = 0.00001  # probability per metre that the robot was carried, and no scan showed it
    told_log_odds: float = 12.0  # [nats] by which both are less likely if the user tells the start

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        if not self.first_count >= self.max_count >= self.min_count >= 1:
            raise ValueError(
                "counts need first_count >= max_count >= min_count >= 1, "
                f"got {self.first_count}, {self.max_count} and {self.min_count}"
            )
        if not self.count_per_area >= 1:
            raise ValueError(f"count_per_area must be >= 1, got {self.count_per_area}")
        for name in ("first_null", "leaving", "moving"):
            if not 0.0 < getattr(self, name) < 1.0:
                raise ValueError(f"{name} must be in (0, 1), got {getattr(self, name)}")
        if not 0.0 <= self.told_log_odds < math.inf:
            raise ValueError(f"told_log_odds must be finite and >= 0, got {self.told_log_odds}")


@dataclass(frozen=True, eq=False)
class Track:
    """A cluster of particles that stand and move together."""

    particles: Particles

    @property
    def log_evidence(self) -> float:
        """The logarithm of the probability that the robot is here."""
        return self.particles.log_mass


@dataclass(frozen=True, eq=False)
class Tracks:
    """All tracks, the most probable first, and the null track."""

    tracks: tuple[Track, ...]
    log_null: float

    @cached_property
    def particles(self) -> Particles:
        """The particles of all tracks."""
        return join([track.particles for track in self.tracks])


def normalized(particles: Particles, log_null: float) -> tuple[Particles, float, float]:
    """Scale all masses so that they sum to 1; return the logarithm of what they summed to as well."""
    log_total = float(np.logaddexp(particles.log_mass, log_null))
    return particles.scaled(-log_total), log_null - log_total, log_total


def rare(probability: float) -> float:
    """Bring the probability of a rare event between its limits."""
    return min(max(probability, RARE[0]), RARE[1])


def leave(particles: Particles, log_null: float, probability: float) -> tuple[Particles, float]:
    """Move a share of the mass from all places to the null track: the robot may leave what is drawn."""
    probability = rare(probability)
    gained = particles.log_mass + math.log(probability)
    return particles.scaled(math.log1p(-probability)), float(np.logaddexp(log_null, gained))


def cluster(
    particles: Particles, log_null: float, atlas: Atlas, settings: TrackSettings, rng: np.random.Generator
) -> Tracks:
    """Split particles into tracks, prune the improbable, and give each as many particles as it needs.

    The masses that come in need not sum to 1; those of the tracks do.
    """
    if len(particles) == 0 or not particles.log_mass > -math.inf:
        return Tracks((), log_null)
    keys, inverse = _blocks(particles, atlas)
    shares = np.bincount(inverse, particles.shares).astype(np.float64)
    count, labels = _connected(keys, shares > min(MIN_SHARE, 0.1 * float(shares.max())))
    of_particle = labels[inverse]
    totals = np.bincount(labels[labels >= 0], shares[labels >= 0], count).astype(np.float64)
    wanted = _counts(shares, labels, totals, settings)
    tracks = [
        Track(_resample(particles.members(np.flatnonzero(of_particle == k)), int(wanted[k]), rng))
        for k in np.argsort(-totals, kind="stable").tolist()
    ]
    kept, log_null, _ = normalized(join([track.particles for track in tracks]), log_null)
    bounds = np.cumsum([0, *(len(track.particles) for track in tracks)])
    return Tracks(
        tuple(
            Track(Particles(kept.states[:, a:b], kept.log_weights[a:b])) for a, b in pairwise(bounds.tolist())
        ),
        log_null,
    )


def as_one(particles: Particles, log_null: float, count: int, rng: np.random.Generator) -> Tracks:
    """Make one track of `count` particles, wherever they stand; all masses sum to 1 after it."""
    particles, log_null, _ = normalized(particles, log_null)
    return Tracks((Track(_resample(particles, count, rng)),), log_null)


def _blocks(particles: Particles, atlas: Atlas) -> tuple[NDArray[np.int64], NDArray[np.intp]]:
    """Return the sorted keys of the blocks that hold particles, (k,), and which block each is in, (n,)."""
    size = BLOCK * math.exp(_mean_log_scale(particles))
    left, bottom = atlas.range_table.corner
    keys, numbers = kernels.blocks.number_blocks(particles.states, left, bottom, size, ROWS, SECTORS)
    order = np.argsort(keys)
    ranks = np.empty_like(order)
    ranks[order] = np.arange(len(order))
    return keys[order], ranks[numbers]


def _mean_log_scale(particles: Particles) -> float:
    """Average the log scale of particles."""
    return float(weighted_sum(particles.states[LOG_SCALE], particles.shares))


def _connected(keys: NDArray[np.int64], kept: NDArray[np.bool_]) -> tuple[int, NDArray[np.intp]]:
    """Label the connected components of the kept blocks, -1 for the others; `keys` (n,) are sorted."""
    labels = np.full(len(keys), -1, dtype=np.intp)
    labels[kept] = kernels.blocks.connect_blocks(keys[kept], ROWS, SECTORS)
    return int(labels.max()) + 1, labels


def _counts(
    shares: Array, labels: NDArray[np.intp], totals: Array, settings: TrackSettings
) -> NDArray[np.int64]:
    """Say how many particles each track needs, (tracks,): in proportion to the area over which it is spread.

    `shares` (blocks,) are those of the mass, `labels` (blocks,) the tracks of the blocks, -1 for none, and
    `totals` (tracks,) the shares of the tracks. The area is that of equally probable blocks with the same
    entropy.
    """
    members = labels >= 0
    inner = shares[members] / totals[labels[members]]
    positive = inner > 0.0
    entropy = np.bincount(labels[members][positive], -inner[positive] * np.log(inner[positive]), len(totals))
    wanted = settings.count_per_area * BLOCK**2 * np.exp(entropy)
    minor = totals < MINOR_SHARE * totals.sum()
    wanted = np.where(minor, np.clip(wanted, *MINOR_COUNT), np.maximum(wanted, settings.min_count))
    wanted *= min(1.0, settings.max_count / wanted.sum())
    least = min(FEWEST, EXCESS * settings.max_count / len(wanted))
    return np.maximum(wanted, least).astype(np.int64)


def _resample(particles: Particles, wanted: int, rng: np.random.Generator) -> Particles:
    """Resample a track if its weights are uneven, or if far more or fewer particles are `wanted`."""
    count = len(particles)
    is_even = particles.effective_size >= RESAMPLE_BELOW * count
    if is_even and 0.5 * wanted <= count <= 1.5 * wanted:
        return particles
    return particles.resampled(max(1, min(wanted, max(2 * count, MINOR_COUNT[0]))), rng)
