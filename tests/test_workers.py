"""Every task comes back once, whatever becomes of the processes that run it."""

import asyncio
import contextlib
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

import worker_tasks
from pilotage import workers as workers_module
from pilotage.errors import PilotageError
from pilotage.workers import Cluster, ClusterError, LostTaskError, Processes


@pytest.mark.parametrize("count", [1, 3])
def test_each_task_comes_with_its_result(count):
    with Processes(count) as processes:
        found = list(processes.run(worker_tasks.square, range(5)))

    assert [(k, k * k) for k in range(5)] == sorted(found)


@pytest.mark.slow
def test_a_killed_process_loses_no_task(tmp_path):
    markers = [str(tmp_path / name) for name in "abcd"]
    with Processes(2) as processes:
        found = list(processes.run(worker_tasks.die_once, markers))

    assert [(marker, marker) for marker in markers] == sorted(found)


@pytest.mark.slow
def test_a_task_that_always_kills_is_given_up_and_takes_no_other_with_it():
    with Processes(2) as processes:
        found = dict(processes.run(worker_tasks.die_if_negative, [1, -1, 2, 3]))

    assert isinstance(found.pop(-1), LostTaskError)
    assert {1: 1, 2: 4, 3: 9} == found


def test_an_error_that_a_user_can_mend_is_a_result():
    with Processes(1) as processes:
        found = dict(processes.run(worker_tasks.fail_if_negative, [2, -1]))

    assert 4 == found[2]
    assert "numbers must not be negative: -1" == str(found[-1])


def test_a_mistake_in_a_task_is_told_and_leaves_the_others_alone():
    with Processes(1) as processes:
        found = dict(processes.run(worker_tasks.square, [3, "a"]))

    assert 9 == found[3]
    assert "this is a mistake in pilotage (TypeError" in str(found["a"])


def test_a_number_of_processes_is_positive():
    with pytest.raises(ValueError, match="must be >= 1, got 0"):
        Processes(0)


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:1", "nonsense"])
def test_a_scheduler_that_is_not_there_is_told_in_one_line(address, monkeypatch):
    pytest.importorskip("distributed")
    monkeypatch.setattr(workers_module, "PATIENCE", "1s")
    with pytest.raises(ClusterError, match="there is no scheduler of Dask at") as caught:
        Cluster(address)

    assert "\n" not in str(caught.value)
    assert "IO loop" not in {thread.name for thread in threading.enumerate()}  # of a client that still waits


def test_a_cluster_can_be_asked_for_where_an_event_loop_runs(monkeypatch):
    pytest.importorskip("distributed")
    monkeypatch.setattr(workers_module, "PATIENCE", "1s")

    async def notebook():
        Cluster("tcp://127.0.0.1:1")

    with (  # in a thread: a browser of other tests may have a loop that runs in this one
        ThreadPoolExecutor(1) as thread,
        pytest.raises(ClusterError, match="there is no scheduler of Dask at"),
    ):
        thread.submit(lambda: asyncio.run(notebook())).result()


def connected(address):
    """Connect; a thread of `distributed` that a busy machine starts too late is tried again."""
    for _ in range(2):
        with contextlib.suppress(ClusterError):
            return Cluster(address)
    return Cluster(address)


@pytest.mark.slow
def test_a_killed_worker_of_a_cluster_loses_no_task(tmp_path, monkeypatch):
    pytest.importorskip("distributed")
    from benchmarks.which import local_cluster

    monkeypatch.setenv("PYTHONPATH", str(Path(worker_tasks.__file__).parent))

    markers = [str(tmp_path / name) for name in "abcd"]
    for marker in markers[1:]:
        Path(marker).touch()  # only the first one kills
    with local_cluster() as (address, _), connected(address) as cluster:
        found = dict(cluster.run(worker_tasks.die_once, markers))
        failed = dict(cluster.run(worker_tasks.fail_if_negative, [2, -1]))

    assert {marker: marker for marker in markers} == found
    assert 4 == failed[2]
    assert isinstance(failed[-1], PilotageError)


@pytest.mark.slow
def test_a_worker_that_lacks_what_it_needs_is_told():
    pytest.importorskip("distributed")
    from benchmarks.which import local_cluster

    with (
        local_cluster() as (address, _),
        connected(address) as cluster,
        pytest.raises(ClusterError, match="lacks pilotage"),
    ):
        list(cluster.run(worker_tasks.square, [1]))  # workers do not see the tests
