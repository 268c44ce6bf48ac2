"""A stretch of a polyline."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Span:
    """The run of vertices `first .. last` (inclusive), its end segments cut short by a share.

    On a closed polyline `last` may run past the end and counts on from vertex 0.
    """

    first: int
    last: int
    trim_first: float = 0.0  # share of segment (first, first + 1) left out, [0, 1)
    trim_last: float = 0.0  # share of segment (last - 1, last) left out, [0, 1)

    def __post_init__(self) -> None:
        """Reject an empty span, and shares that leave nothing of it."""
        if not 0 <= self.first < self.last:
            raise ValueError(f"a span needs 0 <= first < last, got first {self.first}, last {self.last}")
        for name, trim in (("trim_first", self.trim_first), ("trim_last", self.trim_last)):
            if not 0.0 <= trim < 1.0:
                raise ValueError(f"{name} must be in [0, 1), got {trim}")
        if self.last - self.first == 1 and self.trim_first + self.trim_last >= 1.0:
            raise ValueError(
                f"trims must leave a part of the one segment, got {self.trim_first + self.trim_last}"
            )
