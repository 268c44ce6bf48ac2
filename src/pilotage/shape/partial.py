"""Partial shapes: what a scan shows of a contour, and why it shows no more."""

from dataclasses import dataclass
from enum import Enum

from pilotage.geometry import Polyline, Pose2


class EndCause(Enum):
    """Why a partial shape ends where it ends."""

    OCCLUDING = "a true edge, in front of something farther away"
    OCCLUDED = "goes on unseen behind something nearer"
    RANGE_LIMIT = "goes on out of reach: the next beam did not return"
    FIELD_LIMIT = "goes on beyond the first or last beam"
    DRAWN = "ends here because it was drawn so, or was cut here on purpose"

    @property
    def goes_on(self) -> bool:
        """Whether the true contour may continue past this end."""
        return self in (EndCause.OCCLUDED, EndCause.RANGE_LIMIT, EndCause.FIELD_LIMIT)


@dataclass(frozen=True, slots=True)
class PartialShape:
    """A polyline with free space on its left, and why it ends at either end."""

    polyline: Polyline
    first_end: EndCause = EndCause.DRAWN
    last_end: EndCause = EndCause.DRAWN

    def moved(self, a_from_b: Pose2) -> "PartialShape":
        """Carry from frame b to frame a."""
        return PartialShape(self.polyline.moved(a_from_b), self.first_end, self.last_end)

    def reversed(self) -> "PartialShape":
        """Run the other way, the ends exchanged."""
        return PartialShape(self.polyline.reversed(), self.last_end, self.first_end)
