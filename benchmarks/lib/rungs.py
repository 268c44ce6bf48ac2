"""Drawings of the ladder of deformation, by names such as `ladder-0.5-3`: severity 0.5, person 3.

`straight-` before the name of any hand is its drawing with the true warp taken out, such as
`straight-ladder-0.5-3` and `straight-freehand`.
"""

from functools import cache

from benchmarks.lib.data import drawing_of
from pilotage.evaluation.deformation import Plan, deform, read_plan

PREFIX = "ladder"
STRAIGHT = "straight-"


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


def straight_name(hand: str) -> str:
    """Name the drawing of a hand with the true warp taken out."""
    return f"{STRAIGHT}{hand}"


def is_straight(hand: str) -> bool:
    """Tell whether the true warp is taken out of a drawing."""
    return hand.startswith(STRAIGHT)


def straight_of(building: str, hand: str) -> Plan:
    """Take the true warp out of a drawing."""
    drawn = hand.removeprefix(STRAIGHT)
    plan = rung_of(building, drawn) if is_rung(drawn) else read_plan(drawing_of(building, drawn))
    return plan.straightened()
