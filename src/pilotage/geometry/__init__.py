"""Immutable values of the plane."""

from pilotage.geometry.affine import Affine2
from pilotage.geometry.angles import wrap_angle
from pilotage.geometry.arrays import Array, frozen_array, frozen_points, numbered
from pilotage.geometry.homography import Homography
from pilotage.geometry.polyline import Polyline, segments_of
from pilotage.geometry.pose import Pose2
from pilotage.geometry.rings import fit_circle, signed_area
from pilotage.geometry.similarity import Similarity2, fit_similarity
from pilotage.geometry.span import Span
from pilotage.geometry.trajectory import Trajectory
from pilotage.geometry.twist import Twist

__all__ = [
    "Affine2",
    "Array",
    "Homography",
    "Polyline",
    "Pose2",
    "Similarity2",
    "Span",
    "Trajectory",
    "Twist",
    "fit_circle",
    "fit_similarity",
    "frozen_array",
    "frozen_points",
    "numbered",
    "segments_of",
    "signed_area",
    "wrap_angle",
]
