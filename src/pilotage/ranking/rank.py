"""Rank drawings by the evidence of logs: all drawings with few particles first, then the best with all."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from pilotage.errors import FileError, PilotageError
from pilotage.localization import LocalizerSettings, Observation
from pilotage.maps import build_atlas
from pilotage.ranking.evidence import Evidence, observations_of, reduced, weigh
from pilotage.workers import Workers

COARSE = 1 / 8
"""Share of the particles and proposals of the localizer with which all drawings are tried ..."""
FINENESS = 1 / 2
"""... and of the cells along a drawing's longer side: its preparation takes a quarter of the time."""
KEPT = 1 / 8
"""Share of the drawings that are then tried with all of them ..."""
LEAST_KEPT = 4
"""... but at least so many."""
LOGS_AT_ONCE = 16
"""Logs that one task compares with a drawing, which has to be prepared anew for each task."""
SETTINGS = LocalizerSettings()

Candidate = tuple[Path, bool]
"""A drawing, and whether it is looked at in a mirror."""


@dataclass(frozen=True, slots=True)
class Score:
    """What one drawing tells about one log."""

    drawing: Path
    evidence: Evidence
    is_refined: bool  # with all particles
    is_mirrored: bool = False  # the drawing was looked at in a mirror

    @property
    def name(self) -> str:
        """The drawing, and whether it was mirrored."""
        return f"{self.drawing}, mirrored" if self.is_mirrored else str(self.drawing)

    @property
    def candidate(self) -> "Candidate":
        """What was compared with the log."""
        return self.drawing, self.is_mirrored


@dataclass(frozen=True, slots=True)
class LogTask:
    """Look at a log."""

    log: Path
    travel: float  # [m]


@dataclass(frozen=True, slots=True, eq=False)
class DrawingTask:
    """Compare a drawing with logs."""

    drawing: Path
    is_mirrored: bool
    seen: dict[Path, tuple[Observation, ...]]  # of each log
    settings: LocalizerSettings
    seed: int


@dataclass(slots=True)
class Board:
    """All scores that are known so far."""

    scores: dict[Path, dict[Candidate, Score]] = field(default_factory=dict)  # by log

    def ranking(self, log: Path) -> tuple[Score, ...]:
        """Return the scores of a log, the best first: those with all particles, then the others."""
        scores = self.scores.get(log, {}).values()
        return tuple(
            sorted(scores, key=lambda one: (not one.is_refined, -one.evidence.log_evidence, one.candidate))
        )

    def note(self, task: DrawingTask, found: dict[Path, Evidence], *, is_refined: bool) -> None:
        """Write down what a task found."""
        for log, evidence in found.items():
            score = Score(task.drawing, evidence, is_refined, task.is_mirrored)
            self.scores.setdefault(log, {})[score.candidate] = score


def rank(
    drawings: Sequence[Path],
    logs: Sequence[Path],
    workers: Workers,
    board: Board,
    *,
    travel: float,
    seed: int = 0,
    mirrored: bool = False,
    say: Callable[[str], None] = lambda _text: None,
) -> Iterator[Path]:
    """Compare drawings with the first metres of logs; yield each log when its ranking is on the board.

    With `mirrored` each drawing is also looked at in a mirror. The ranking is the same whatever the number of
    workers. Files that cannot be used are left out; `say` is told so, and how far it is.
    """
    candidates = [(drawing, one) for drawing in drawings for one in ((False, True) if mirrored else (False,))]
    for first in range(0, len(logs), LOGS_AT_ONCE):
        some = logs[first : first + LOGS_AT_ONCE]
        seen: dict[Path, tuple[Observation, ...]] = {}
        for look, observations in workers.run(observe_log, [LogTask(log, travel) for log in some]):
            if isinstance(observations, PilotageError):
                say(f"left out: {observations}")
            else:
                seen[look.log] = observations
        seen = {log: seen[log] for log in some if log in seen}  # in the order that was asked for
        yield from rank_some(candidates, seen, workers, board, seed=seed, say=say)


def rank_some(
    candidates: Sequence[Candidate],
    seen: dict[Path, tuple[Observation, ...]],
    workers: Workers,
    board: Board,
    *,
    seed: int,
    say: Callable[[str], None],
) -> Iterator[Path]:
    """Compare drawings with logs that were looked at."""
    coarse = reduced(SETTINGS, COARSE, FINENESS)
    tasks = [DrawingTask(*one, seen, coarse, seed) for one in candidates] if seen else []
    compare(tasks, workers, board, say, is_refined=False)
    kept_of = {log: best(board.ranking(log), len(candidates)) for log in seen}
    finals = [
        DrawingTask(*one, chosen, SETTINGS, seed)
        for one in candidates
        if (chosen := {log: seen[log] for log, kept in kept_of.items() if one in kept})
    ]
    compare(finals, workers, board, say, is_refined=True)
    yield from (log for log in seen if board.ranking(log))


def best(ranking: Sequence[Score], count: int) -> frozenset[Candidate]:
    """Choose the drawings that are tried with all particles."""
    return frozenset(one.candidate for one in ranking[: max(LEAST_KEPT, round(KEPT * count))])


def compare(
    tasks: Sequence[DrawingTask],
    workers: Workers,
    board: Board,
    say: Callable[[str], None],
    *,
    is_refined: bool,
) -> None:
    """Run tasks, and write down what they find as it comes."""
    pass_name = "second" if is_refined else "first"
    for done, (task, found) in enumerate(workers.run(compare_drawing, tasks), start=1):
        if isinstance(found, PilotageError):
            where = "" if isinstance(found, FileError) else f": {task.drawing}"
            say(f"left out: {found}{where}")
            continue
        board.note(task, found, is_refined=is_refined)
        highest = max(one.log_evidence for one in found.values())
        say(f"{pass_name} pass, {done} of {len(tasks)}: {task.drawing.name} {highest:+.1f}")


def observe_log(task: LogTask) -> tuple[Observation, ...]:
    """Look at a log; raise FileError if it cannot be used."""
    from pilotage.io import open_log

    try:
        return observations_of(open_log(task.log), task.travel, SETTINGS)
    except ValueError as error:
        raise FileError(str(error), task.log) from error


def compare_drawing(task: DrawingTask) -> dict[Path, Evidence]:
    """Compare a drawing with logs; raise FileError if it cannot be used."""
    from pilotage.io import open_map

    try:
        sketch = open_map(task.drawing)
        atlas = build_atlas(sketch.mirrored() if task.is_mirrored else sketch, task.settings.atlas)
        return {log: weigh(atlas, seen, task.settings, task.seed) for log, seen in task.seen.items()}
    except ValueError as error:
        raise FileError(str(error), task.drawing) from error
