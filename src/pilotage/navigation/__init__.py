"""From a place to motion: cell by cell to the goal (Wolter 2001, section 4.2)."""

from pilotage.navigation.goal import Goal, sketch_point
from pilotage.navigation.navigator import Navigator
from pilotage.navigation.settings import NavigatorSettings
from pilotage.navigation.step import Behavior, Outcome, Step

__all__ = ["Behavior", "Goal", "Navigator", "NavigatorSettings", "Outcome", "Step", "sketch_point"]
