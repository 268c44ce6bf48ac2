"""A contour as a sequence of arcs, laid out once and compared often."""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from pilotage.contours.arcs import Bend, find_arcs
from pilotage.contours.tangent import TangentFunction
from pilotage.geometry import Polyline, frozen_array, wrap_angle
from pilotage.kernels.steps import ArcSteps, Steps

REPEAT = 1e-9  # share of the length; a shorter segment is rounding


@dataclass(frozen=True, eq=False)
class ArcSequence:
    """The tangent function of a contour, its maximal arcs marked on it.

    Where an inflection segment is cut at its middle, the tangent function has a stop without a step.
    """

    tangent: TangentFunction
    arc_starts: NDArray[np.int64]  # (k + 1,) the piece with which each arc starts, and the end
    bends: tuple[Bend, ...]  # (k,)
    closed: bool

    @classmethod
    def of(cls, polyline: Polyline) -> Self:
        """Cut a polyline into arcs; a closed one with inflections starts at the first of them."""
        line = _without_repeats(polyline)
        arcs = find_arcs(line)
        stretches = [line.cut(arc.span).vertices for arc in arcs]
        vertices = np.vstack([stretches[0], *(stretch[1:] for stretch in stretches[1:])])
        return cls(
            TangentFunction.of(Polyline(vertices)),
            np.cumsum([0, *(len(stretch) - 1 for stretch in stretches)]),
            tuple(arc.bend for arc in arcs),
            polyline.closed,
        )

    def steps(self, length: float) -> ArcSteps:
        """Lay out for the kernels, as if the contour had this length."""
        stops, along, starts = self.tangent.stops, self.tangent.directions, self.arc_starts
        if self.closed:
            gap = along[0] - along[-1]
            around = along[-1] - along[0] + wrap_angle(float(gap))
            stops = np.concatenate([stops, 1.0 + stops[1:]])
            along = frozen_array(np.concatenate([along, along + around]))  # as that of an open line
            starts = np.concatenate([starts, starts[-1] + starts[1:]])
        bends = np.array([bend.value for bend in self.bends])
        return ArcSteps(Steps(length * stops, along), starts, bends)


def _without_repeats(polyline: Polyline) -> Polyline:
    """Leave out vertices that repeat the one before them, or nearly so."""
    advances = polyline.segment_lengths > REPEAT * polyline.length
    is_new = np.roll(advances, 1) if polyline.closed else np.concatenate([[True], advances])
    return polyline.subset(np.flatnonzero(is_new)) if np.count_nonzero(is_new) > 1 else polyline
