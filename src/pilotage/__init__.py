"""Find a robot's place in a hand-drawn map from its laser scans, and drive it from there.

>>> import pilotage
>>> "open_map" in dir(pilotage)
True
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pilotage.config import Settings
    from pilotage.drives import Drive, navigate
    from pilotage.errors import FileError, PilotageError, SettingsError
    from pilotage.findings import Finding
    from pilotage.findings.check import check
    from pilotage.geometry import Affine2, Pose2, Similarity2, Twist
    from pilotage.io import open_log, open_map, open_world
    from pilotage.io.state import resume, save_state
    from pilotage.localization import Estimate, Localizer, LocalizerSettings, PoseHypothesis, Status
    from pilotage.maps import SchematicMap
    from pilotage.navigation import Behavior, Navigator, NavigatorSettings, Outcome, Step, Tour
    from pilotage.perception import LaserScan, Odometry, Reading
    from pilotage.simulation import World

__all__ = [
    "Affine2",
    "Behavior",
    "Drive",
    "Estimate",
    "FileError",
    "Finding",
    "LaserScan",
    "Localizer",
    "LocalizerSettings",
    "Navigator",
    "NavigatorSettings",
    "Odometry",
    "Outcome",
    "PilotageError",
    "Pose2",
    "PoseHypothesis",
    "Reading",
    "SchematicMap",
    "Settings",
    "SettingsError",
    "Similarity2",
    "Status",
    "Step",
    "Tour",
    "Twist",
    "World",
    "check",
    "navigate",
    "open_log",
    "open_map",
    "open_world",
    "resume",
    "save_state",
]

HOMES = {
    "config": ("Settings",),
    "drives": ("Drive", "navigate"),
    "errors": ("FileError", "PilotageError", "SettingsError"),
    "findings": ("Finding", "check"),
    "geometry": ("Affine2", "Pose2", "Similarity2", "Twist"),
    "io": ("open_log", "open_map", "open_world"),
    "io.state": ("resume", "save_state"),
    "localization": ("Estimate", "Localizer", "LocalizerSettings", "PoseHypothesis", "Status"),
    "maps": ("SchematicMap",),
    "navigation": ("Behavior", "Navigator", "NavigatorSettings", "Outcome", "Step", "Tour"),
    "perception": ("LaserScan", "Odometry", "Reading"),
    "simulation": ("World",),
}
"""Where each public name lives; it is fetched at its first use, so that `import pilotage` stays light."""


def __getattr__(name: str) -> object:
    """Fetch a public name (PEP 562)."""
    for home, names in HOMES.items():
        if name in names:
            return getattr(import_module(f"pilotage.{home}"), name)
    raise AttributeError(f"module 'pilotage' has no attribute {name!r}")


def __dir__() -> list[str]:
    """List the public names."""
    return sorted(__all__)
