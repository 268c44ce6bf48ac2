"""Read long logs of every format: how fast, in how much memory, and whether all formats tell the same.

    python -m benchmarks logs

An MCAP file of many scans is written and read in a process of its own. A stretch of the packed log is
written as CARMEN, ROS 1, sqlite3 and MCAP, and localized; the estimates must be the same to the byte.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from benchmarks.lib.arguments import positive
from benchmarks.lib.bag_making import KINDS
from benchmarks.lib.long_logs import four_formats, write_long_bag
from benchmarks.lib.results import Figures
from pilotage import Localizer, LocalizerSettings, open_log, open_map, worlds
from pilotage.io.estimates import estimate_record

BEAMS = 720
READ = """
import json, resource, sys, time
from pilotage import open_log
began = time.perf_counter()
count = sum(1 for _ in open_log(sys.argv[1]))
mb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
print(json.dumps({"scans": count, "seconds": time.perf_counter() - began, "mb": mb}))
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose the length of the log."""
    parser.add_argument("--scans", type=positive, default=100_000, help="(default: %(default)s)")


def measure(arguments: argparse.Namespace) -> Figures:
    """Print and return time and memory, and whether the estimates are the same."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        bag = write_long_bag(folder / "long", arguments.scans, BEAMS)
        told = subprocess.run([sys.executable, "-c", READ, bag], capture_output=True, check=True)  # noqa: S603
        figures: Figures = json.loads(told.stdout)
        estimates = [localized(path) for path in four_formats(folder)]
    figures["identical"] = all(one == estimates[0] for one in estimates)
    print(f"{figures['scans']} scans of {BEAMS} beams: {figures['seconds']:.1f} s, {figures['mb']:.0f} MB")
    print(f"CARMEN, {', '.join(KINDS)}: {'the same' if figures['identical'] else 'different'} estimates")
    return figures


def localized(path: Path) -> str:
    """Return the estimates along a log, as they are written."""
    sketch = open_map(worlds.OFFICE.careful)
    localizer = Localizer(sketch, LocalizerSettings(proposals=500))
    records = (
        estimate_record(localizer.update(reading.scan, reading.odometry), sketch)
        for reading in open_log(path)
    )
    return "\n".join(map(json.dumps, records))
