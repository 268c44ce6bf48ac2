"""Make the packed log: a robot that nobody steers drives through the packed office.

    python examples/make_log.py [folder]

writes `run.log.gz` and, known to nobody who localizes, `truth.jsonl`: where the robot was on the quick
drawing at each scan. All is made up, and the same every time.
"""

import json
import sys
from pathlib import Path

import numpy as np

import pilotage
from pilotage import worlds
from pilotage.evaluation.warp import read_warp
from pilotage.io import write_log
from pilotage.simulation import RunSettings, simulate

SEED = 2001
UP = np.array([1.0, -1.0])

# From the office to the library, the lab and round the hall, through the workshop to the kitchen; metres, y
# down as on the page.
WAYPOINTS = np.array(
    [
        (2.3, 5.6), (2.4, 7.6), (2.4, 9.2), (3.7, 9.6), (6.5, 9.5), (9.6, 9.9), (10.4, 10.6), (10.4, 12.2),
        (9.4, 12.6), (11.2, 13.2), (11.6, 15.3), (10.9, 13.2), (10.4, 11.6), (10.5, 10.0), (12.5, 9.6),
        (16.0, 9.6), (17.6, 9.4), (18.2, 8.6), (18.2, 7.2), (17.0, 5.6), (18.4, 6.6), (18.3, 8.4),
        (18.9, 9.5),
        (21.0, 9.8), (23.2, 7.8), (23.4, 4.6), (24.2, 2.4), (26.6, 2.0), (30.2, 3.2), (31.9, 6.0),
        (31.9, 9.4),
        (28.6, 10.4), (25.8, 10.8), (25.6, 12.6), (26.3, 14.6), (26.2, 17.6), (24.0, 17.6), (21.8, 17.9),
        (20.5, 17.0), (20.5, 14.0), (20.4, 11.2), (18.0, 9.6), (16.4, 10.0), (16.35, 11.2), (16.2, 13.2),
    ]
)  # fmt: skip


def main(folder: Path) -> None:
    """Write both files."""
    folder.mkdir(parents=True, exist_ok=True)
    world = pilotage.open_world(worlds.OFFICE.world)
    run = simulate(world, WAYPOINTS * UP, np.random.default_rng(SEED), RunSettings())
    write_log(folder / worlds.LOG.name, run.readings)
    sketch = pilotage.open_map(worlds.OFFICE.quick)
    warp = read_warp(worlds.OFFICE.quick.with_suffix(".json"), sketch)
    positions = np.array([moment.world_from_base.position for moment in run.truth])
    drawn = sketch.file_from_sketch(warp.sketch_from_world(positions))
    with (folder / worlds.TRUTH.name).open("w") as file:
        for moment, (x, y) in zip(run.truth, drawn, strict=True):
            file.write(
                json.dumps({"stamp": round(moment.stamp, 3), "x": round(x, 1), "y": round(y, 1)}) + "\n"
            )
    print(f"{len(run.readings)} scans in {folder}")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else worlds.OFFICE.folder)
