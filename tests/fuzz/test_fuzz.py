"""A few hundred hostile files; `python -m tests.fuzz` reads them for as long as one likes."""

import math
import os

import pytest
from tests.fuzz.__main__ import one_round
from tests.fuzz.bombs import BOMBS
from tests.fuzz.seeds import seeds
from tests.fuzz.worker import Worker


@pytest.fixture(scope="module")
def worker():
    with Worker() as one:
        yield one


@pytest.mark.parametrize("name", sorted(seeds()))
def test_the_files_are_read_before_they_are_spoilt(worker, tmp_path, name):
    (tmp_path / "plan.png").write_bytes(seeds()["a.png"])
    path = tmp_path / name
    path.write_bytes(seeds()[name])
    verdict = worker.read(path)

    assert "read" == verdict.outcome, verdict


@pytest.mark.slow
def test_spoilt_files_are_read_or_refused_in_one_line(worker, tmp_path):
    (tmp_path / "plan.png").write_bytes(seeds()["a.png"])
    verdicts = [verdict for verdict, _ in one_round(1, tmp_path, worker, math.inf)]

    assert 150 < len(verdicts)
    assert not [verdict for verdict in verdicts if verdict.is_bad]


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(BOMBS))
def test_bombs_are_read_or_refused_in_bounded_time_and_memory(worker, tmp_path, name):
    (tmp_path / "plan.png").write_bytes(seeds()["a.png"])
    path = tmp_path / name
    path.write_bytes(BOMBS[name]())
    verdict = worker.read(path)

    assert not verdict.is_bad, verdict


@pytest.mark.parametrize("kind", ["a.svg", "a.png", "a.pdf", "a.dxf", "map.yaml"])
def test_pipes_do_not_block(worker, tmp_path, kind):
    path = tmp_path / kind
    os.mkfifo(path)

    assert "refused" == worker.read(path).outcome
