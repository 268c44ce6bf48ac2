"""A whole drive in one call."""

from collections.abc import Sequence

from pilotage.config import Settings
from pilotage.drives.loop import Start, drive, set_out
from pilotage.drives.record import Drive
from pilotage.geometry import Pose2
from pilotage.maps import Atlas, SchematicMap
from pilotage.navigation import Place, Tour
from pilotage.simulation import World


def navigate(
    drawing: SchematicMap | Atlas,
    world: World,
    goal: Place | Sequence[Place] | Tour,
    *,
    start: Start | None = None,
    world_start: Pose2 | None = None,
    scale: float | None = None,
    seed: int = 0,
    settings: Settings | None = None,
) -> Drive:
    """Drive a simulated robot to a goal on a drawing, or to several; arguments as of `set_out`."""
    navigator, simulator = set_out(
        drawing, world, goal, start=start, world_start=world_start, scale=scale, seed=seed, settings=settings
    )
    instants = list(drive(navigator, simulator))
    return Drive.of(navigator.planner.atlas, world, navigator.planner.goal, instants)
