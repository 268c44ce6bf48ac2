"""What was shown of a drive, to look back at: bounded, and the finer the shorter the drive."""

import bisect

MOST = 2000
"""Frames that are kept."""
GAP = 0.2
"""Time [s] of the drive between kept frames; doubled whenever there are too many."""


class History:
    """Frames as texts, by time of the drive [s]."""

    def __init__(self, most: int = MOST) -> None:
        self._most = most
        self._gap = GAP
        self._times: list[float] = []
        self._frames: list[str] = []

    def add(self, t: float, frame: str) -> None:
        """Keep a frame, unless it follows the last one too closely."""
        if self._times and t < self._times[-1] + self._gap:
            return
        self._times.append(t)
        self._frames.append(frame)
        if len(self._times) > self._most:
            self._gap *= 2.0
            self._times, self._frames = self._times[::2], self._frames[::2]

    def at(self, t: float) -> str | None:
        """Return what was shown then, or the first frame for an earlier time; None if there is none."""
        return self._frames[max(bisect.bisect_right(self._times, t) - 1, 0)] if self._frames else None

    @property
    def span(self) -> list[float]:
        """The first and the last time; empty if there is none."""
        return [self._times[0], self._times[-1]] if self._times else []

    def __len__(self) -> int:
        """Count the frames."""
        return len(self._frames)
