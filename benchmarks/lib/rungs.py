"""Drawings of the ladder of deformation, by names such as `ladder-0.5-3`: severity 0.5, person 3."""

from functools import cache

from benchmarks.lib.data import drawing_of
from pilotage.evaluation.deformation import Plan, deform, read_plan

PREFIX = "ladder"


def rung_name(severity: float, person: int) -> str:
    """Name a drawing of the ladder, as a hand."""
    return f"{PREFIX}-{severity:g}-{person}"


def is_rung(hand: str) -> bool:
    """Tell whether a hand is of the ladder."""
    return hand.startswith(f"{PREFIX}-")


@cache
def plan_of(building: str) -> Plan:
    """Read the true plan of a building."""
    return read_plan(drawing_of(building, "draftsman"))


def rung_of(building: str, hand: str) -> Plan:
    """Make a drawing of the ladder."""
    _, severity, person = hand.split("-")
    return deform(plan_of(building), float(severity), int(person))
