"""The ranking follows from the evidence alone, in whatever order it comes."""

import math
from pathlib import Path

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from pilotage.errors import FileError
from pilotage.ranking import Board, Evidence, rank
from pilotage.ranking.rank import KEPT, LEAST_KEPT, LogTask

LOGS = [Path("a.log"), Path("b.log")]


class Table:
    """Workers that look evidence up, and answer in an order of their own."""

    def __init__(self, coarse, fine, seed, broken=()):
        self.tables, self.broken = (coarse, fine), broken
        self.rng = np.random.default_rng(seed)
        self.passes = 0
        self.tried = []

    def run(self, _function, tasks):
        tasks = list(tasks)
        order = [tasks[k] for k in self.rng.permutation(len(tasks))]
        if tasks and isinstance(tasks[0], LogTask):
            yield from ((task, ()) for task in order)
            return
        table = self.tables[min(self.passes, 1)]
        self.passes += 1
        self.tried.append({(task.drawing, log) for task in order for log in task.seen})
        for task in order:
            if task.drawing in self.broken:
                yield task, FileError("broken", task.drawing)
            else:
                yield task, {log: Evidence(table[task.drawing, log], "", 0.0) for log in task.seen}


def ranked(drawings, workers):
    board = Board()
    logs = list(rank(drawings, LOGS, workers, board, travel=1.0))
    return logs, {log: board.ranking(log) for log in LOGS}


@st.composite
def evidences(draw):
    drawings = [Path(f"{k}.svg") for k in range(draw(st.integers(1, 40)))]
    values = st.integers(-3, 3).map(float)
    keys = [(drawing, log) for drawing in drawings for log in LOGS]
    return drawings, *({key: draw(values) for key in keys} for _ in range(2))


@given(evidences(), st.integers(0, 99), st.integers(0, 99))
def test_the_order_of_answers_does_not_matter(made, one, other):
    drawings, coarse, fine = made

    assert ranked(drawings, Table(coarse, fine, one)) == ranked(drawings, Table(coarse, fine, other))


@given(evidences())
def test_the_best_of_the_first_pass_are_ranked_by_the_second(made):
    drawings, coarse, fine = made
    table = Table(coarse, fine, 0)
    logs, rankings = ranked(drawings, table)

    kept = min(len(drawings), max(LEAST_KEPT, round(KEPT * len(drawings))))
    assert LOGS == logs
    for log, ranking in rankings.items():
        assert sorted(drawings) == sorted(one.drawing for one in ranking)
        assert [True] * kept + [False] * (len(drawings) - kept) == [one.is_refined for one in ranking]
        assert {(one.drawing, log) for one in ranking[:kept]} == {
            key for key in table.tried[1] if key[1] == log
        }
        for some, values in ((ranking[:kept], fine), (ranking[kept:], coarse)):
            found = [one.evidence.log_evidence for one in some]
            assert [values[one.drawing, log] for one in some] == found == sorted(found, reverse=True)
        left = max((one.evidence.log_evidence for one in ranking[kept:]), default=-math.inf)
        assert all(coarse[one.drawing, log] >= left for one in ranking[:kept])


def test_drawings_that_cannot_be_used_are_left_out_and_told():
    drawings, told = [Path("good.svg"), Path("bad.svg")], []
    values = {(drawing, log): 1.0 for drawing in drawings for log in LOGS}
    board = Board()
    workers = Table(values, values, 0, broken=[Path("bad.svg")])

    assert LOGS == list(rank(drawings, LOGS, workers, board, travel=1.0, say=told.append))
    assert [Path("good.svg")] == [one.drawing for one in board.ranking(LOGS[0])]
    assert "left out: broken: bad.svg" in told
