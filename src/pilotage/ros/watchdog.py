"""When a robot must stand: what it knows of its surroundings is too old, or not to be trusted."""

from dataclasses import dataclass

NO_SCAN = 0.3
"""Time [s] without a scan after which a robot stands."""

CLOCK_JUMP = 1.0
"""A clock has jumped if the stamps of two scans differ from the time between them by more than this [s]."""


@dataclass
class Watchdog:
    """Hears of scans, and says why the robot must stand; empty if it may move. Times are monotonic [s]."""

    heard: float | None = None  # when the last scan came
    stamp: float | None = None  # what it was stamped
    trouble: str = ""  # of the last scan

    def hear(self, now: float, stamp: float, trouble: str = "") -> None:
        """Take note of a scan, and of what is wrong with it."""
        self.trouble = trouble
        if self.heard is not None and self.stamp is not None:
            passed, stamped = now - self.heard, stamp - self.stamp
            if stamped <= -CLOCK_JUMP or stamped - passed > CLOCK_JUMP:
                self.trouble = f"the clock jumped by {stamped - passed:+.1f} s"
        self.heard, self.stamp = now, stamp

    def reason(self, now: float) -> str:
        """Say why the robot must stand."""
        if self.heard is None:
            return "no scan has come"
        if self.trouble:
            return self.trouble
        silence = now - self.heard
        return f"no scan for {silence:.1f} s" if silence > NO_SCAN else ""
