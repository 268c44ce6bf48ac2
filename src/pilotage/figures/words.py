"""What pictures and terminals say of a drive, in plain words."""

import math

from pilotage.localization import Status
from pilotage.maps import CellGraph
from pilotage.navigation import Step


def clock(seconds: float) -> str:
    """Write a time as minutes and seconds.

    >>> clock(75.0)
    '1:15'
    """
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes}:{rest:02d}"


def name_cell(cell_id: str, graph: CellGraph | None) -> str:
    """Name a cell by its label, with its id if another cell has the same label; else by its id."""
    label = graph.cell(cell_id).label if graph is not None and cell_id else ""
    if graph is None or not label:
        return cell_id
    is_one = sum(cell.label == label for cell in graph.cells) == 1
    return label if is_one else f"{label} ({cell_id})"


def describe(step: Step, seconds: float, graph: CellGraph | None) -> str:
    """Say in a line what happens at a step, `seconds` after the first one."""
    words = [clock(seconds), step.behavior.value, describe_place(step, graph)]
    words.append(f"cell {step.estimate.cell_probability:.2f}, place {step.estimate.probability:.2f}")
    if math.isfinite(step.distance):
        words.append(f"{step.distance:.0f} m to go")
    return "   ".join(words)


def describe_place(step: Step, graph: CellGraph | None) -> str:
    """Say where the robot believes to be, and which cell comes next."""
    here = name_cell(step.estimate.cell_id, graph)
    where = {
        Status.LOCATED: f"in {here}",
        Status.LOST: f"lost, perhaps in {here}",
        Status.MISMATCH: "the drawing does not fit",
    }[step.estimate.status]
    return f"{where}, next {name_cell(step.next_cell_id, graph)}" if step.next_cell_id else where
