"""Why a robot stands is said once, however often it is told to, and without a network."""

from types import SimpleNamespace

from benchmarks.lib.bag_making import Maker

from pilotage.ros.robot import LiveRobot, Topics

MAKER = Maker("")


class Wire:
    """Carries scans that were put on it; all else is silent."""

    def __init__(self, scans):
        self.scans = scans

    def subscribe(self, topic, _type_name, _quality=None):
        """Hear the next scan, or nothing."""
        is_scan = topic == "scan"
        return SimpleNamespace(take=lambda: [self.scans.pop(0)] if is_scan and self.scans else [])

    def advertise(self, *_args, **_options):
        """Send to nobody."""
        return SimpleNamespace(publish=lambda _message: None)

    def wait(self, _seconds):
        """Wait for nothing."""


def test_a_reason_is_said_once_though_its_numbers_change():
    said = []
    scans = [MAKER.scan(1.0 + 0.1 * k, [1.0, 2.0])[1] for k in range(5)]
    live = LiveRobot(Wire(scans), SimpleNamespace(goal=None), Topics(), said.append, lambda: 0.0)
    live.sensing.hear_odometry(MAKER.odometry(9.0, (0.0, 0.0, 0.0))[1])
    for _ in range(5):
        live.spin_once()

    assert ["standing: odometry does not reach back to a scan that is 8.00 s older"] == said
