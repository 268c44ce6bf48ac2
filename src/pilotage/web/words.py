"""What the page says of a drive, in a sentence."""

from pilotage.localization import Estimate, Status
from pilotage.maps import CellGraph
from pilotage.navigation import Behavior, Step

DOING = {
    Behavior.LOOK_AROUND: "looks around",
    Behavior.EXPLORE: "goes to look at the next corner",
    Behavior.DRIVE_ON: "drives on to see how far along it is",
    Behavior.CROSS: "drives",
    Behavior.GO_THROUGH: "goes through the opening",
    Behavior.BACK_OUT: "backs out",
    Behavior.WAIT: "waits, something is in the way",
}
"""What the robot does, by behavior; if it rests, or a log is replayed, it does nothing."""
LIKELY = 0.1
"""Probability from which on a place is worth a word."""
MOST_NAMED = 3


def sentence(step: Step, graph: CellGraph, goal: str) -> str:
    """Say where the robot believes to be and what it does; `goal` names where it is going."""
    if step.outcome is not None:
        return f"{step.outcome.value}: {step.reason}" if step.reason else step.outcome.value
    if step.behavior is Behavior.REST:
        return whereabouts(step.estimate, graph)
    doing = DOING[step.behavior]
    if step.behavior in (Behavior.CROSS, Behavior.GO_THROUGH):
        doing += f" to {name_of(step.next_cell_id, graph) if step.next_cell_id else goal}"
    return f"{whereabouts(step.estimate, graph)}; {doing}"


def whereabouts(estimate: Estimate, graph: CellGraph) -> str:
    """Say where the robot believes to be."""
    if estimate.status is Status.LOCATED:
        return f"in {name_of(estimate.cell_id, graph)}"
    if estimate.status is Status.MISMATCH:
        return "what it sees does not fit this drawing"
    likely = [one for one in estimate.hypotheses if one.probability >= LIKELY]
    names = list(dict.fromkeys(name_of(one.cell_id, graph) for one in likely))[:MOST_NAMED]
    return f"lost; most likely in {' or '.join(names)}" if names else "lost; it may be anywhere"


def name_of(cell_id: str, graph: CellGraph) -> str:
    """Name a cell in a sentence."""
    return place_of(cell_id, graph) or "an unknown place"


def place_of(cell_id: str, graph: CellGraph) -> str:
    """Name a cell as the drawing does, else by its id; a journal may name one that is no longer drawn."""
    index = graph.index_from_id.get(cell_id)
    return cell_id if index is None else graph.cells[index].label or cell_id
