"""Find what looks wrong with a drawing."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from pilotage.findings.closed_rooms import drawn_doors, find_closed_areas, find_rooms_without_door
from pilotage.findings.doors import has_doors
from pilotage.findings.finding import Finding, Point, Severity
from pilotage.findings.gaps import find_closed_gaps, find_idle_arrows, find_odd_gateways
from pilotage.findings.names import find_names, find_stair_rooms
from pilotage.findings.page import (
    find_far_strokes,
    find_marks_left_out,
    find_no_door,
    find_scale,
    no_doors,
    nothing_enclosed,
)
from pilotage.findings.parts import find_parts
from pilotage.findings.steps import find_drivable_stairs
from pilotage.interpretation import GAP, Interpretation
from pilotage.maps import (
    CellGraph,
    DecompositionSettings,
    Division,
    NoDoorsError,
    NotEnclosedError,
    RouteError,
    SchematicMap,
    check_place,
    check_reachable,
    divide,
)
from pilotage.maps.routing.forgotten_doors import join_parts
from pilotage.maps.routing.roadmap import check_allowed

ORDER = tuple(Severity)
END_KINDS = ("bad-start", "bad-goal", "closed-goal")

FOLLOWING = ("unreachable", "room-without-door", "closed-gap")
"""Where a drawing is in pieces these follow from it, and are but notes."""


@dataclass(frozen=True, eq=False)
class Report:
    """What was understood of a drawing, and what looks wrong with it."""

    sketch: SchematicMap
    graph: CellGraph | None  # None if nothing is enclosed
    findings: tuple[Finding, ...]  # the worst first
    interpretation: Interpretation | None = None  # None: a picture that was read by its free space


def check(sketch: SchematicMap, settings: DecompositionSettings | None = None) -> tuple[Finding, ...]:
    """Find what looks wrong with a drawing, the worst first; points are in the axes of its file.

    An empty tuple means that nothing does. A drawing that encloses nothing is a finding, no error.
    """
    return report(sketch, settings=settings).findings


def report(
    sketch: SchematicMap,
    interpretation: Interpretation | None = None,
    *,
    settings: DecompositionSettings | None = None,
) -> Report:
    """Divide a drawing into cells, and find what looks wrong with it and with its marks."""
    try:
        division = divide(sketch, settings or DecompositionSettings())
    except NoDoorsError as error:
        found = [no_doors(str(error), to_open_in(interpretation))]
        return Report(sketch, None, in_order(sketch, found), interpretation)
    except NotEnclosedError as error:
        found = [nothing_enclosed(sketch, str(error))]
        return Report(sketch, None, in_order(sketch, found), interpretation)
    return Report(
        sketch,
        division.graph,
        in_order(sketch, [*find_all(sketch, division, interpretation)]),
        interpretation,
    )


def find_all(
    sketch: SchematicMap, division: Division, interpretation: Interpretation | None
) -> Iterator[Finding]:
    """Ask all checks."""
    drawn, to_open = drawn_doors(interpretation), to_open_in(interpretation)
    yield from find_bad_ends(sketch, division.graph)
    joined = len(division.graph.cells) == 1 or has_doors(division.graph)
    if not joined:
        yield from find_no_door(division.graph, drawn, to_open)
    else:
        yield from find_parts(division.graph, to_open)
    yield from find_closed_areas(sketch, division, to_open)
    yield from find_rooms_without_door(sketch, division.graph, drawn, to_open, joined=joined)
    yield from find_stair_rooms(division.graph, sketch.zones)
    yield from find_drivable_stairs(division.graph, interpretation)
    yield from find_far_strokes(sketch, division.graph)
    yield from find_names(sketch, division)
    yield from find_closed_gaps(division)
    yield from find_odd_gateways(division.graph)
    yield from find_idle_arrows(sketch, division.graph)
    yield from find_scale(sketch, division.graph)
    if interpretation is not None:
        yield from find_marks_left_out(interpretation)


def to_open_in(interpretation: Interpretation | None) -> str:
    """Say how one makes a door in a wall of such a drawing."""
    return GAP if interpretation is None else interpretation.sheet.to_open


def for_ends(
    report: Report,
    start: Point | None,
    goal: Point | None,
    problems: Mapping[str, str] = MappingProxyType({}),
) -> Report:
    """Judge another start or goal than those that are marked: points of the sketch (y up); None: as marked.

    `problems` says of a "start" or "goal" that was told by a name why no place could be found for it.
    """
    assert report.graph is not None
    marked = report.sketch
    sketch = replace(
        marked,
        start=None if "start" in problems else start or marked.start,
        goal=None if "goal" in problems else goal or marked.goal,
    )
    unknown = [bad_end(what, None, problem) for what, problem in problems.items()]
    ends = in_order(sketch, [*unknown, *find_bad_ends(sketch, report.graph)])
    others = tuple(finding for finding in report.findings if finding.kind not in END_KINDS)
    return replace(report, sketch=sketch, findings=ends + others)


def find_bad_ends(sketch: SchematicMap, graph: CellGraph) -> Iterator[Finding]:
    """Find a start or goal that lies in no room, and a goal that cannot be reached."""
    start, goal = (usable(graph, point) for point in (sketch.start, sketch.goal))
    for what, point, fine in (("start", sketch.start, start), ("goal", sketch.goal, goal)):
        if point is not None and fine is None:
            yield bad_end(what, point, place_problem(graph, point, what))
    if goal is not None:
        try:
            check_allowed(sketch.zones, goal)
            check_reachable(graph, goal, start)
        except RouteError as error:
            yield no_way(sketch, graph, goal, start, str(error))


def no_way(sketch: SchematicMap, graph: CellGraph, goal: Point, start: Point | None, problem: str) -> Finding:
    """Report a goal to which no drawn door leads: a robot tries the walls, if there are any between."""
    try:
        check_allowed(sketch.zones, goal)
        check_reachable(join_parts(graph).graph, goal, start)
    except RouteError:
        return bad_end("goal", goal, problem)
    advice = "draw the doors that lead there: without them the robot tries wall after wall, and often fails"
    return Finding("closed-goal", Severity.WARNING, problem, advice, goal)


def usable(graph: CellGraph, point: Point | None) -> Point | None:
    """Return a point that lies in a cell, else None."""
    return None if point is None or place_problem(graph, point, "place") else point


def place_problem(graph: CellGraph, point: Point, what: str) -> str:
    """Say why a point cannot be used; nothing if it can."""
    try:
        check_place(graph, point, what)
    except RouteError as error:
        return str(error)
    return ""


def bad_end(what: str, point: Point | None, problem: str) -> Finding:
    """Report a start or goal that cannot be used; without a point it is a name that no one room bears."""
    advice = f"move the mark of the {what}" if point else f"name a room or a point X,Y for the {what}"
    return Finding(f"bad-{what}", Severity.ERROR, problem, advice, point)


def in_order(sketch: SchematicMap, findings: list[Finding]) -> tuple[Finding, ...]:
    """Sort findings, the worst first, else as they were found; carry them to the axes of the file."""
    if any(finding.kind == "in-pieces" for finding in findings):
        findings = [
            replace(finding, severity=Severity.NOTE) if finding.kind in FOLLOWING else finding
            for finding in findings
        ]
    ranked = sorted(findings, key=lambda finding: ORDER.index(finding.severity))
    return tuple(finding.in_file(sketch) for finding in ranked)
