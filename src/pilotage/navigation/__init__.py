"""From a place to motion: cell by cell to the goal (Wolter 2001, section 4.2)."""

from pilotage.navigation.navigator import Navigator, NavigatorSettings
from pilotage.navigation.step import Behavior, Outcome, Step

__all__ = ["Behavior", "Navigator", "NavigatorSettings", "Outcome", "Step"]
