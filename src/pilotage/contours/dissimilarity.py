"""How unlike two contours are: the measure of the paper, and what it builds on (Wolter 2001, section 3)."""

from dataclasses import dataclass
from enum import Enum

from pilotage import kernels
from pilotage.contours.sequence import ArcSequence
from pilotage.contours.tangent import TangentFunction
from pilotage.geometry import Polyline


class Measure(Enum):
    """How two arcs are compared; values as the kernels know them."""

    TANGENT = 0  # eq. (2) as it stands (Latecki and Lakämper)
    COMBINED = 1  # the lesser of eq. (2) and a correspondence of segments (the paper)


class Lengths(Enum):
    """What length means."""

    RELATIVE = "a share of the contour: the scale does not matter, as against a drawing"
    ABSOLUTE = "as measured: the scale matters, as between two scans"


@dataclass(frozen=True, slots=True)
class Comparison:
    """How to compare two contours."""

    measure: Measure = Measure.COMBINED
    lengths: Lengths = Lengths.RELATIVE
    largest_group: int = 7  # arcs that may answer to a single one; odd, so that convex answers to convex
    largest_run: int = 7  # segments that may answer to a single one; a notch in a wall makes 5 of 1

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        if self.largest_group < 1 or self.largest_group % 2 == 0:
            raise ValueError(f"largest_group must be odd and positive, got {self.largest_group}")
        if self.largest_run < 1:
            raise ValueError(f"largest_run must be >= 1, got {self.largest_run}")

    def length(self, tangent: TangentFunction) -> float:
        """Tell what length a contour counts with."""
        return 1.0 if self.lengths is Lengths.RELATIVE else tangent.length  # section 3.4: scale normalized


def dissimilarity(a: Polyline, b: Polyline, settings: Comparison) -> float:
    """Compare two contours, both open or both closed; 0 is equal up to rotation and translation.

    Arcs answer to arcs in order, one to one or one to an odd number of them; the sum of their dissimilarities
    is least. All of one may also answer to all of the other, whatever their arcs. Mirror images differ.

    In rad² with relative lengths, in rad² times the unit of length with absolute ones.

    >>> square = Polyline.through([(0, 0), (1, 0), (1, 1), (0, 1)], closed=True)
    >>> diamond = Polyline.through([(0, -3), (3, 0), (0, 3), (-3, 0)], closed=True)
    >>> round(dissimilarity(square, diamond, Comparison()), 9)
    0.0
    """
    return sequence_dissimilarity(ArcSequence.of(a), ArcSequence.of(b), settings)


def sequence_dissimilarity(a: ArcSequence, b: ArcSequence, settings: Comparison) -> float:
    """Compare as `dissimilarity` does what is compared with many others."""
    if a.closed != b.closed:
        raise ValueError(f"contours must be both closed or both open, got {a.closed} and {b.closed}")
    arcs = kernels.arc_correspondence
    compare = arcs.closed_dissimilarity if a.closed else arcs.open_dissimilarity
    return float(
        compare(
            a.steps(settings.length(a.tangent)),
            b.steps(settings.length(b.tangent)),
            settings.largest_group,
            settings.measure.value,
            settings.largest_run,
        )
    )


def arc_dissimilarity(c: Polyline, d: Polyline, settings: Comparison) -> float:
    """Compare two open polylines, each as a single arc: S(c, d) of eq. (2), or the paper's combination.

    >>> corner = Polyline.through([(0, 0), (1, 0), (1, 1)])
    >>> straight = Polyline.through([(0, 0), (2, 0)])
    >>> round(arc_dissimilarity(corner, straight, Comparison(Measure.TANGENT)), 4)  # (pi / 4)**2
    0.6169
    """
    if c.closed or d.closed:
        raise ValueError(f"arcs must be open, got closed {c.closed} and {d.closed}")
    c_tangent, d_tangent = TangentFunction.of(c), TangentFunction.of(d)
    return float(
        kernels.arc_correspondence.stretch_dissimilarity(
            c_tangent.steps(settings.length(c_tangent)),
            0,
            len(c_tangent.directions),
            d_tangent.steps(settings.length(d_tangent)),
            0,
            len(d_tangent.directions),
            settings.measure.value,
            settings.largest_run,
        )
    )
