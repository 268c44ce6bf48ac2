"""Find a robot in a drawing, scan by scan.

    python examples/01_localize.py [MAP LOG]

Without arguments it takes the packed office.
"""

import sys

import pilotage
from pilotage import worlds


def main(drawing: str, log: str) -> None:
    """Print where the robot is, whenever that changes."""
    localizer = pilotage.Localizer(pilotage.open_map(drawing))
    said = ""
    for reading in pilotage.open_log(log):
        estimate = localizer.update(reading.scan, reading.odometry)
        now = f"{estimate.status.value} in {estimate.cell_id}"
        if now != said:
            print(f"{estimate.stamp:8.1f} s  {now}, probability {estimate.probability:.2f}")
            said = now


if __name__ == "__main__":
    main(*sys.argv[1:3]) if len(sys.argv) > 2 else main(str(worlds.OFFICE.quick), str(worlds.LOG))
