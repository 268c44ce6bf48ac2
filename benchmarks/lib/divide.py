"""Divide one drawing in a process of its own: `python -m benchmarks.lib.divide FILE` prints what came of it.

So that time and memory are those of this drawing, and a crash is that of this drawing.
"""

import json
import resource
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import shapely

from benchmarks.lib.data import DATA, ROOT
from pilotage.errors import FileError, PilotageError

LIMIT_S = 60
"""A drawing that takes more time of the processor counts as not read."""

PATIENCE = 20.0
"""How many times longer it may take by the clock, on a machine that does other things too."""

TOO_SLOW = f"takes more than {LIMIT_S} s"

BYTES_PER_MB = 1e6


@dataclass(frozen=True, eq=False)
class Division:
    """What the program made of a drawing; nothing and an error if it could not be read."""

    cells: tuple[shapely.Polygon, ...] = ()  # in the axes of the file
    labels: tuple[str, ...] = ()  # one for each cell, empty if it has none
    small: tuple[bool, ...] = ()  # one for each cell: a scrap, as `CellSize.SMALL` says
    gateways: tuple[tuple[int, int], ...] = ()  # pairs of cells
    seconds: float = 0.0  # from opening the file to the cells, libraries and kernels loaded
    mb: float = 0.0  # peak of the process
    error: str = ""  # one line


def divide(path: Path) -> Division:
    """Open a drawing and find its cells, in a new process."""
    command = [sys.executable, "-m", "benchmarks.lib.divide", str(path)]
    try:
        done = subprocess.run(  # noqa: S603  # our own module
            command, cwd=ROOT, capture_output=True, text=True, timeout=PATIENCE * LIMIT_S, check=False
        )
    except subprocess.TimeoutExpired:
        return Division(seconds=LIMIT_S, error=TOO_SLOW)
    if done.returncode == -signal.SIGXCPU:
        return Division(seconds=LIMIT_S, error=TOO_SLOW)
    if done.returncode:
        last = done.stderr.strip().splitlines()[-1:] or [f"ends with status {done.returncode}"]
        return Division(error=last[0])
    found = json.loads(done.stdout.splitlines()[-1])
    cells = tuple(shapely.Polygon(rings[0], rings[1:]) for rings in found.pop("rings"))
    gateways = tuple((first, second) for first, second in found.pop("gateways"))
    return Division(cells, tuple(found.pop("labels")), tuple(found.pop("small")), gateways=gateways, **found)


def main() -> None:
    """Print the cells of the drawing that the command line names, as JSON."""
    from pilotage.io import open_map
    from pilotage.maps import CellSize, DecompositionSettings, decompose
    from pilotage.worlds import OFFICE

    decompose(open_map(OFFICE.quick), DecompositionSettings())  # loads what is loaded once
    start = time.process_time()
    limit = int(start) + LIMIT_S
    resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1))
    try:
        sketch = open_map(sys.argv[1])
        graph = decompose(sketch, DecompositionSettings())
    except FileError as error:
        print(json.dumps(unread(f"{error.rule}: {name_of(error.path)}", time.process_time() - start)))
        return
    except Exception as error:  # noqa: BLE001  # whatever goes wrong is a result
        name = "" if isinstance(error, PilotageError) else f"{type(error).__name__}: "
        print(json.dumps(unread(f"{name}{error}", time.process_time() - start)))
        return
    seconds = time.process_time() - start
    index = graph.index_from_id
    found = {
        "rings": [
            [sketch.file_from_sketch(ring).tolist() for ring in (cell.outline, *cell.holes)]
            for cell in graph.cells
        ],
        "labels": [cell.label for cell in graph.cells],
        "small": [cell.size is CellSize.SMALL for cell in graph.cells],
        "gateways": [[index[name] for name in gateway.cell_ids] for gateway in graph.gateways],
        "seconds": seconds,
        "mb": peak_mb(),
    }
    print(json.dumps(found))


def name_of(path: Path) -> str:
    """Name a file by its place in the data folder, where it lies there: results are alike on all machines."""
    return str(path.relative_to(DATA) if path.is_relative_to(DATA) else path)


def unread(error: str, seconds: float) -> dict[str, object]:
    """Describe a drawing that could not be divided."""
    nothing: dict[str, object] = {"rings": [], "labels": [], "small": [], "gateways": []}
    return {**nothing, "seconds": seconds, "mb": peak_mb(), "error": " ".join(error.split())}


def peak_mb() -> float:
    """Return the most memory that this process had in use [MB], libraries included."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / BYTES_PER_MB


if __name__ == "__main__":
    main()
