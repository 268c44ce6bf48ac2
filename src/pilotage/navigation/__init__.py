"""From a place to motion: cell by cell to the goal (Wolter 2001, section 4.2)."""

from pilotage.navigation.goal import Goal, find_goal, sketch_point
from pilotage.navigation.navigator import Navigator
from pilotage.navigation.settings import NavigatorSettings
from pilotage.navigation.step import Behavior, Outcome, Place, Step, Visit
from pilotage.navigation.tour import Tour

__all__ = [
    "Behavior",
    "Goal",
    "Navigator",
    "NavigatorSettings",
    "Outcome",
    "Place",
    "Step",
    "Tour",
    "Visit",
    "find_goal",
    "sketch_point",
]
