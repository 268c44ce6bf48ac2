"""A pilot that keeps what it saw along the way, so that the drawing can be corrected afterwards."""

from pilotage.correction import Sighting, append_sighting
from pilotage.navigation import Navigator, Step
from pilotage.perception import LaserScan, Odometry


class WatchingPilot:
    """Drives as its navigator does; `sightings` grow along the way."""

    def __init__(self, navigator: Navigator) -> None:
        self.navigator = navigator
        self.sightings: list[Sighting] = []

    def step(self, scan: LaserScan, odometry: Odometry) -> Step:
        """Say what to do now, and keep what is seen if the localizer got the scan."""
        step = self.navigator.step(scan, odometry)
        if self.navigator.position.is_fresh:
            append_sighting(self.sightings, self.navigator.position.localizer, scan)
        return step
