"""From a scan to slightly simplified partial shapes (Wolter 2001, sections 2.1 and 2.2)."""

from dataclasses import dataclass, field

import numpy as np

from pilotage.geometry import Polyline
from pilotage.perception.scan import LaserScan
from pilotage.perception.segmentation import SegmentationSettings, find_runs, points_in_laser
from pilotage.shape.partial import PartialShape


@dataclass(frozen=True, slots=True)
class PerceptionSettings:
    """How a scan becomes shapes."""

    segmentation: SegmentationSettings = field(default_factory=SegmentationSettings)
    min_relevance: float = (
        0.03  # [rad·m] keeps a right angle between sides of 4 cm; noise is metric, so is this
    )

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        if not self.min_relevance >= 0.0:
            raise ValueError(f"min_relevance must be >= 0 rad·m, got {self.min_relevance}")


def perceive(scan: LaserScan, settings: PerceptionSettings) -> tuple[PartialShape, ...]:
    """See a scan as partial shapes in the base frame, free space on their left, noise simplified away.

    Shapes come in the order of beams, counter-clockwise; a scan without returns shows none.
    """
    from pilotage.kernels.evolution_compiled import evolve_runs

    runs = find_runs(scan, settings.segmentation)
    if not runs:
        return ()
    points = scan.base_from_laser @ points_in_laser(scan)
    vertices = points[np.concatenate([run.beams for run in runs])]
    starts = np.cumsum([0, *(len(run.beams) for run in runs)])
    closed = np.array([run.closed for run in runs])
    keep = evolve_runs(vertices, starts, closed, settings.min_relevance)
    return tuple(
        PartialShape(Polyline(vertices[start:end][keep[start:end]], run.closed), run.first_end, run.last_end)
        for run, start, end in zip(runs, starts[:-1].tolist(), starts[1:].tolist(), strict=True)
    )
