"""Keep what was measured last: figures, and of what code, when, on which machine and by which command."""

import json
import os
import platform
import subprocess
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.lib.data import ROOT, TUNED
from pilotage.io.files import write_text

FOLDER = ROOT / "benchmarks" / "results"
MADE = ("benchmarks/results", "README.md", "docs/images")  # written by benchmarks: no change of the code

Figures = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Measurement:
    """What one benchmark found."""

    name: str
    command: str
    commit: str  # short hash; "+" behind it if the code had changes that were not committed
    date: str  # ISO
    machine: dict[str, Any]  # cpu, cores, python
    figures: Figures


def measured(name: str, words: list[str], figures: Figures) -> Measurement:
    """Note down figures of the code as it is now."""
    command = " ".join(["python -m benchmarks", name, *words])
    date = datetime.now(UTC).date().isoformat()
    return Measurement(name, command, commit_of(ROOT), date, machine(), figures)


def commit_of(folder: Path) -> str:
    """Return the short hash of the commit, with a "+" if files that are not results differ from it."""

    def git(*words: str) -> str:
        return subprocess.run(  # noqa: S603  # fixed words
            ["git", *words],  # noqa: S607
            cwd=folder,
            capture_output=True,
            text=True,
            check=True,
        ).stdout.strip()

    try:
        head = git("rev-parse", "--short", "HEAD")
        changed = git("status", "--porcelain", "--", ".", *(f":(exclude){path}" for path in MADE))
    except (OSError, subprocess.CalledProcessError):
        return "unknown"
    return f"{head}+" if changed else head


def machine() -> dict[str, Any]:
    """Describe the machine."""
    return {"cpu": cpu_name(), "cores": os.cpu_count(), "python": platform.python_version()}


def cpu_name() -> str:
    """Return the name of the processor, as exactly as the system tells it."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


def save(measurement: Measurement, folder: Path = FOLDER) -> Path:
    """Write a measurement over the one before it."""
    path = folder / f"{measurement.name}.json"
    write_text(path, json.dumps(asdict(measurement), indent=1) + "\n")
    return path


def load(name: str, folder: Path = FOLDER) -> Measurement | None:
    """Read the last measurement of a benchmark; None if there is none."""
    path = folder / f"{name}.json"
    return Measurement(**json.loads(path.read_text())) if path.exists() else None


def mean_of(rows: Sequence[Figures]) -> Figures:
    """Average figures by name; intervals are left out, and so is what no row has."""
    return {
        name: float(np.mean(values))
        for name in (rows[0] if rows else ())
        if not name.endswith("_interval") and (values := [row[name] for row in rows if row[name] is not None])
    }


def means_of_groups(rows: Figures, buildings: Sequence[str], hands: Sequence[str]) -> dict[str, Figures]:
    """Average rows by hand: over all buildings, those that defaults were chosen on, and those held out.

    `rows` holds for each building a row for each hand that drew it.
    """
    groups = {
        "mean": buildings,
        "tuned": [building for building in buildings if building in TUNED],
        "held_out": [building for building in buildings if building not in TUNED],
    }
    return {
        name: {
            hand: mean_of(found)
            for hand in hands
            if (found := [rows[one][hand] for one in chosen if hand in rows.get(one, {})])
        }
        for name, chosen in groups.items()
    }
