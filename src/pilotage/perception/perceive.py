"""From a scan to slightly simplified partial shapes (Wolter 2001, sections 2.1 and 2.2)."""

from dataclasses import dataclass, field

import numpy as np

from pilotage.geometry import Polyline
from pilotage.perception.scan import LaserScan
from pilotage.perception.segmentation import SegmentationSettings, split_scan
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

    shapes = split_scan(scan, settings.segmentation)
    if not shapes:
        return ()
    vertices = [shape.polyline.vertices for shape in shapes]
    starts = np.cumsum([0, *map(len, vertices)])
    closed = np.array([shape.polyline.closed for shape in shapes])
    keep = evolve_runs(np.concatenate(vertices), starts, closed, settings.min_relevance)
    return tuple(
        PartialShape(
            Polyline(
                shape.polyline.vertices[keep[start : start + len(shape.polyline)]], shape.polyline.closed
            ),
            shape.first_end,
            shape.last_end,
        )
        for shape, start in zip(shapes, starts.tolist(), strict=False)
    )
