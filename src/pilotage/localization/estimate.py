"""What is claimed of the robot's place: never one global pose, but a place and a local similarity."""

import math
from dataclasses import dataclass, replace
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from pilotage.geometry import Array, Similarity2
from pilotage.localization.belief import LOG_SCALE, Belief, X, Y, mean_state, similarity_of
from pilotage.maps import Atlas

TRACE = 1e-3
"""Share of belief in a block and its neighbors from which on it is held possible at all."""


class Status(Enum):
    """Whether the robot claims to know where it is."""

    LOCATED = "located"
    LOST = "lost"
    MISMATCH = "mismatch"


@dataclass(frozen=True, slots=True)
class Hypothesis:
    """One place where the robot may be."""

    cell_id: str  # empty if the drawing has no cells
    sketch_from_base: Similarity2  # of the surroundings; y up [drawing units per metre]
    probability: float  # [0..1]


@dataclass(frozen=True, slots=True)
class Estimate:
    """Where the robot is on the drawing, as far as a scan can tell; the best guess even when lost."""

    stamp: float  # [s]
    status: Status
    cell_id: str
    sketch_from_base: Similarity2
    confidence: float  # [0..1] probability that the robot is at this place
    hypotheses: tuple[Hypothesis, ...] = ()  # the most probable first


@dataclass(frozen=True, slots=True)
class EstimateSettings:
    """What counts as one place, and when the robot knows its own.

    How much way that takes is measured in diagonals of the drawing: the smaller a building is, the less of it
    can be mistaken for the place.
    """

    block: float = 1.0  # [m] hypotheses are gathered over three by three blocks of this size
    hypotheses: int = 5  # how many places are told, at most
    least: float = 0.02  # probability of a place that is worth telling
    confirmation: float = 0.065  # [diagonals] of way on which confidence makes up two thirds of what it lacks
    fading: float = 0.6  # [diagonals] on which a defended place loses as much while belief is with another
    jump: float = 2.0  # [m] beyond which it is another place that became the most probable
    located: float = 0.5  # confidence from which on the robot claims to be located

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        for name in ("block", "confirmation", "fading", "jump"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be > 0, got {getattr(self, name)}")
        if not self.hypotheses >= 1:
            raise ValueError(f"hypotheses must be >= 1, got {self.hypotheses}")
        for name in ("least", "located"):
            if not 0.0 <= getattr(self, name) <= 1.0:
                raise ValueError(f"{name} must be in [0, 1], got {getattr(self, name)}")


def find_places(belief: Belief, atlas: Atlas, settings: EstimateSettings) -> tuple[Hypothesis, ...]:
    """Gather hypotheses that stand close together into places, the most probable first; at least one."""
    columns, rows = _blocks(belief, atlas, _block_of(belief, settings))
    remaining = _masses(columns, rows, belief.weights)
    found: list[Hypothesis] = []
    while len(found) < settings.hypotheses:
        summed = _around(remaining)
        column, row = divmod(int(summed.argmax()), summed.shape[1])
        if found and summed[column, row] < settings.least:
            break
        members = (np.abs(columns - column) <= 1) & (np.abs(rows - row) <= 1)
        members &= remaining[columns + 1, rows + 1] > 0.0
        found.append(_place(belief.states[:, members], belief.weights[members], atlas))
        remaining[column : column + 3, row : row + 3] = 0.0
    return tuple(found)


def area_of(belief: Belief, atlas: Atlas, settings: EstimateSettings) -> float:
    """Measure how far belief is spread [m²]: evenly over as much, it would have the same entropy."""
    masses = _masses(*_blocks(belief, atlas, _block_of(belief, settings)), belief.weights)
    shares = masses[masses > 0.0]
    return float(settings.block**2 * np.exp(-shares @ np.log(shares)))


def agreement(belief: Belief, other: Belief, atlas: Atlas, settings: EstimateSettings) -> float:
    """Return the share of belief that stands where the other has at least a trace of its own."""
    block = _block_of(other, settings)
    held = _around(np.pad(_masses(*_blocks(other, atlas, block), other.weights), 1)) > TRACE
    columns, rows = (blocks + 1 for blocks in _blocks(belief, atlas, block))
    inside = (columns < held.shape[0]) & (rows < held.shape[1])
    inside[inside] = held[columns[inside], rows[inside]]
    return float(belief.weights[inside].sum())


def _masses(columns: NDArray[np.int64], rows: NDArray[np.int64], weights: Array) -> Array:
    """Sum weights block by block, with a margin of one block all around."""
    shape = int(columns.max()) + 3, int(rows.max()) + 3
    flat = (columns + 1) * shape[1] + rows + 1
    return np.asarray(np.bincount(flat, weights, shape[0] * shape[1]), dtype=np.float64).reshape(shape)


def _block_of(belief: Belief, settings: EstimateSettings) -> float:
    """Return the size of a block [drawing units]."""
    return settings.block * float(np.exp(belief.states[LOG_SCALE] @ belief.weights))


def _blocks(belief: Belief, atlas: Atlas, block: float) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Tell which block each hypothesis stands in, (n,), (n,); far off the drawing is at its rim."""
    table = atlas.range_table
    left, bottom = table.corner
    extents = table.columns * table.cell_size, table.rows * table.cell_size
    across, up = (
        np.clip((belief.states[row] - start) / block, -1.0, extent / block + 1.0).astype(np.int64) + 1
        for row, start, extent in zip((X, Y), (left, bottom), extents, strict=True)
    )
    return across, up


def _around(blocks: Array) -> Array:
    """Sum each block with its eight neighbors, the margin left out."""
    columns, rows = blocks.shape[0] - 2, blocks.shape[1] - 2
    shifts = [(i, j) for i in range(3) for j in range(3)]
    return np.asarray(sum(blocks[i : i + columns, j : j + rows] for i, j in shifts), dtype=np.float64)


def _place(states: Array, weights: Array, atlas: Atlas) -> Hypothesis:
    """Sum up hypotheses that stand close together."""
    mean = mean_state(states, weights)
    return Hypothesis(
        atlas.cell_at((float(mean[X]), float(mean[Y]))), similarity_of(mean), float(min(weights.sum(), 1.0))
    )


def share_at(place: Hypothesis, belief: Belief, settings: EstimateSettings) -> float:
    """Return the share of belief that stands at a place."""
    at, scale = place.sketch_from_base.pose, place.sketch_from_base.scale
    away = np.hypot(belief.states[X] - at.x, belief.states[Y] - at.y)
    return float(belief.weights[away <= settings.jump * scale].sum())


def defended(
    own: Hypothesis,
    probability: float,
    share: float,
    places: tuple[Hypothesis, ...],
    settings: EstimateSettings,
) -> tuple[Hypothesis, ...]:
    """Put the incumbent's place first among the challenger's; where it has no share, these have the rest."""
    probability = min(probability, 1.0)
    others = [place for place in places if distance_between(own, place) > settings.jump]
    held = sum(place.probability for place in others)
    left = (1.0 - probability) / max(1.0 - share, held, 1e-9)
    rest = (replace(place, probability=place.probability * left) for place in others)
    return (replace(own, probability=probability), *rest)[: settings.hypotheses]


def distance_between(first: Hypothesis, second: Hypothesis) -> float:
    """Measure between two places [m], in the scale of the first."""
    a, b = first.sketch_from_base.pose, second.sketch_from_base.pose
    return math.hypot(a.x - b.x, a.y - b.y) / first.sketch_from_base.scale


def steady_confidence(
    confidence: float, share: float, jump: float, way: float, settings: EstimateSettings
) -> float:
    """Let confidence grow with the `way` [diagonals] on which the same place stays the most probable.

    The `share` of the weights alone is badly overconfident: wrong places look certain for a few metres. A
    `jump` [m] from the place that was carried along by the robot's motion begins anew.
    """
    kept = confidence if jump <= settings.jump else 0.0
    return drawn_to(share, kept, way / settings.confirmation)


def defended_confidence(
    confidence: float, share: float, way: float, settings: EstimateSettings, *, is_led: bool
) -> float:
    """Let confidence in a defended place grow with the `way` [diagonals], and fade as another place leads.

    Belief that goes elsewhere without explaining more tells nothing: a building may repeat itself.
    """
    if share > confidence:
        return drawn_to(share, confidence, way / settings.confirmation)
    return drawn_to(share, confidence, way / settings.fading) if is_led else confidence


def drawn_to(target: float, value: float, time: float) -> float:
    """Draw a value to a target; two thirds of the way in a unit of time."""
    return value + (target - value) * -math.expm1(-time)


def estimate_from(
    places: tuple[Hypothesis, ...], confidence: float, stamp: float, settings: EstimateSettings
) -> Estimate:
    """Claim the most probable place."""
    best = places[0]
    confidence = min(confidence, best.probability)
    status = Status.LOCATED if confidence >= settings.located else Status.LOST
    return Estimate(stamp, status, best.cell_id, best.sketch_from_base, confidence, places)
