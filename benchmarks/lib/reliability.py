"""Draw a reliability diagram."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from pilotage.figures import style


def write_reliability(path: Path, bins: Sequence[dict[str, Any]], ece: float) -> None:
    """Draw the share right against the probability claimed, and how often each probability is claimed."""
    figure = Figure(figsize=(4.5, 5.5), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(4, 1))
    above.plot((0, 1), (0, 1), color="0.7", linewidth=1.0, linestyle=(0, (4, 3)))
    above.plot(
        [one["probability"] for one in bins],
        [one["right"] for one in bins],
        color=style.ACCENT,
        marker="o",
        markersize=5.0,
    )
    above.set(xlim=(0, 1), ylim=(0, 1), ylabel="share in the right room", aspect="equal")
    above.set_title(f"expected calibration error {ece:.3f}", fontsize=10)
    below.bar(
        [(one["low"] + one["high"]) / 2 for one in bins],
        [one["share"] for one in bins],
        width=0.09,
        color=style.ACCENT,
    )
    below.set(xlabel="probability claimed", ylabel="share of scans")
    path.parent.mkdir(parents=True, exist_ok=True)
    style.save(figure, path)
