"""What looks wrong with a drawing: where, why, and what to do about it.

`check` is for whoever draws: it finds what the program most likely understands in another way than was meant.
"""

from pilotage.findings.check import Report, check, for_ends, report
from pilotage.findings.finding import Finding, Mend, MendKind, Severity, worst

__all__ = ["Finding", "Mend", "MendKind", "Report", "Severity", "check", "for_ends", "report", "worst"]
