"""Find a robot's place in a hand-drawn map from its laser scans, and drive it from there.

>>> import pilotage
>>> "open_map" in dir(pilotage)
True
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pilotage.errors import FileError, PilotageError, SettingsError
    from pilotage.geometry import Pose2, Similarity2
    from pilotage.io import open_log, open_map
    from pilotage.localization import Estimate, Hypothesis, Localizer, LocalizerSettings, Status
    from pilotage.maps import SchematicMap
    from pilotage.perception import LaserScan, Odometry, Reading

__all__ = [
    "Estimate",
    "FileError",
    "Hypothesis",
    "LaserScan",
    "Localizer",
    "LocalizerSettings",
    "Odometry",
    "PilotageError",
    "Pose2",
    "Reading",
    "SchematicMap",
    "SettingsError",
    "Similarity2",
    "Status",
    "open_log",
    "open_map",
]

HOMES = {
    "errors": ("FileError", "PilotageError", "SettingsError"),
    "geometry": ("Pose2", "Similarity2"),
    "io": ("open_log", "open_map"),
    "localization": ("Estimate", "Hypothesis", "Localizer", "LocalizerSettings", "Status"),
    "maps": ("SchematicMap",),
    "perception": ("LaserScan", "Odometry", "Reading"),
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
