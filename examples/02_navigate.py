"""Drive a simulated robot to a place that is named on a drawing.

    python examples/02_navigate.py [MAP WORLD GOAL]

Without arguments it takes the packed office, drawn carefully, and goes to the archive. The robot is not told
where it starts.
"""

import sys

import pilotage
from pilotage import worlds


def main(drawing: str, world: str, goal: str) -> None:
    """Print where the robot believes to be whenever that changes, and how the drive ended."""
    driven = pilotage.navigate(pilotage.open_map(drawing), pilotage.open_world(world), goal=goal)
    said = ""
    for step in driven.steps:
        now = f"{step.behavior.value}, {step.estimate.status.value} in {step.estimate.place}"
        if now != said:
            print(f"{step.stamp:8.1f} s  {now}")
            said = now
    print(f"{driven.reason}; {driven.length:.0f} m, {driven.minutes:.1f} minutes")


if __name__ == "__main__":
    packed = (str(worlds.OFFICE.careful), str(worlds.OFFICE.world), "archive")
    main(*(sys.argv[1:4] if len(sys.argv) > 3 else packed))
