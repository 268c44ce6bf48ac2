"""How a localizer fared along a log, in memory that does not grow with the log."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pilotage.localization import Estimate

MOST_KEPT = 20_000
"""Estimates that are kept for a picture; of a longer log, every second, fourth or eighth."""


@dataclass
class Trip:
    """What is told and drawn at the end."""

    estimates: "list[Estimate]" = field(default_factory=list)  # thinned out evenly if they are too many
    count: int = 0
    located: int = 0  # number of scans
    first_located: int | None = None
    final: "Estimate | None" = None
    most_kept: int = MOST_KEPT
    _every: int = 1

    def add(self, estimate: "Estimate") -> None:
        """Take the next estimate in."""
        from pilotage.localization import Status

        if estimate.status is Status.LOCATED:
            self.located += 1
            self.first_located = self.count if self.first_located is None else self.first_located
        if self.count % self._every == 0:
            self.estimates.append(estimate)
        if len(self.estimates) > self.most_kept:
            self.estimates = self.estimates[::2]
            self._every *= 2
        self.count += 1
        self.final = estimate

    @property
    def summary(self) -> str:
        """Say in one sentence how it went."""
        from pilotage.localization import Status

        count = f"{self.count} scan{'s' if self.count != 1 else ''}"
        final = self.final
        if final is None:
            return f"{count}."
        misfit = (
            f"this drawing does not seem to be of this building (evidence {final.log_evidence:.0f});"
            " `pilotage which` with --mirrored tells whether it is mirrored"
        )
        if not self.located:
            return f"{count}: lost in all of them{f'; {misfit}' if final.status is Status.MISMATCH else ''}."
        end = {
            Status.LOCATED: f"in {final.place} with probability {final.probability:.2f}",
            Status.LOST: "lost",
            Status.MISMATCH: misfit,
        }[final.status]
        began = f"the first time at scan {self.first_located}"
        return f"{count}: located in {self.located}, {began}; at the end {end}."
