"""Marks on the timeline: where something changes from one step to the next."""

from collections.abc import Iterator

from pilotage.localization import Status
from pilotage.maps import CellGraph
from pilotage.navigation import Outcome, Step
from pilotage.navigation.tour import name_of as goal_in_words
from pilotage.web.words import name_of


def changes(before: Step | None, now: Step, graph: CellGraph) -> Iterator[tuple[str, str]]:
    """Tell what has changed since the step before: the kind of each change, and words."""
    was = before.estimate.status if before is not None else Status.LOST
    status = now.estimate.status
    if status is Status.LOCATED and status is not was:
        yield "found", f"believes to be in {name_of(now.estimate.cell_id, graph)}"
    elif status is Status.LOST and status is not was:
        yield "lost", "does not know where it is any more"
    elif status is not was:
        yield "mismatch", "what it sees does not fit this drawing"
    old = before.closed_gateway_ids if before is not None else ()
    for gateway_id in now.closed_gateway_ids:
        if gateway_id not in old:
            yield "blocked", f"found no way through {gateway_id}"
    over = len(before.visits) if before is not None else 0
    for visit in now.visits[over:] if len(now.visits) > 1 or now.outcome is None else ():
        yield kind_of(visit.outcome), f"{goal_in_words(visit.goal)}: {visit.reason or visit.outcome.value}"
    if now.outcome is not None:
        yield kind_of(now.outcome), now.reason or now.outcome.value


def kind_of(outcome: Outcome) -> str:
    """Return the kind of the mark at the end of a drive."""
    return "reached" if outcome is Outcome.REACHED else "gave up"


def mark(t: float, kind: str, text: str) -> dict[str, object]:
    """Describe a mark."""
    return {"t": round(t, 2), "kind": kind, "text": text}
