"""What a session keeps, and what a slow client gets."""

import asyncio
import multiprocessing
import tempfile
import threading
import time
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from starlette.exceptions import HTTPException
from starlette.requests import Request

from pilotage.web import sessions, workers
from pilotage.web.file_routes import while_wanted
from pilotage.web.history import History
from pilotage.web.order import Order, Sent
from pilotage.web.sessions import MOST_GOING, Client, Sessions
from pilotage.web.workers import Jobs, Worker, WorkerError
from web_table import finished


def test_a_slow_client_gets_the_newest_of_each_kind_and_nothing_piles_up() -> None:
    async def watch() -> tuple[list[str], list[str]]:
        client = Client()
        for k in range(1000):
            client.put("frame", f"frame {k}")
            client.put("state", f"state {k}")
        first = await client.take()
        client.put("frame", "next")
        return first, await client.take()

    assert (["state 999", "frame 999"], ["next"]) == finished(watch())


def test_a_client_that_says_what_it_saw_is_never_far_behind() -> None:
    async def watch() -> list[list[str]]:
        client, taken = Client(), []
        client.saw()
        for k in range(10):
            client.put("frame", f"frame {k}")
            client.put("state", f"state {k}")
            taken.append(await client.take())
        client.saw()
        return [*taken, await client.take()]

    *taken, last = finished(watch())

    assert [["state 2", "frame 2"], ["state 3"]] == taken[2:4]
    assert ["state 9"] == taken[-1]
    assert ["frame 9"] == last


@given(st.lists(st.floats(0.01, 30.0), min_size=1, max_size=300))
def test_a_history_is_bounded_and_answers_with_the_past(gaps: list[float]) -> None:
    history, t, times = History(most=20), 0.0, []
    for gap in gaps:
        history.add(t, str(t))
        times.append(t)
        t += gap

    assert len(history) <= 20
    for wanted in times:
        assert float(history.at(wanted) or "nan") <= wanted
    assert 0.0 == history.span[0]


def test_an_empty_history_has_nothing_to_show() -> None:
    assert History().at(3.0) is None
    assert [] == History().span


def test_a_job_that_dies_or_hangs_takes_nothing_else_with_it() -> None:
    import os

    async def work() -> int:
        jobs = Jobs()
        with pytest.raises(WorkerError, match="ended unexpectedly"):
            await jobs.run(os._exit, 3, within=60.0)
        with pytest.raises(WorkerError, match=r"longer than 0\.3 s"):
            await jobs.run(time.sleep, 60.0, within=0.3)
        return await jobs.run(len, "abc", within=60.0)

    assert 3 == finished(work())


def test_a_job_whose_page_has_gone_on_is_ended() -> None:
    ended: list[str] = []

    async def job() -> None:
        try:
            await asyncio.sleep(60.0)
        finally:
            ended.append("job")

    async def leave() -> dict[str, str]:
        await asyncio.sleep(0.01)
        return {"type": "http.disconnect"}

    async def ask() -> None:
        with pytest.raises(HTTPException, match="nobody waits"):
            await while_wanted(Request({"type": "http"}, leave), job())
        await asyncio.sleep(0.0)

    finished(ask())

    assert ["job"] == ended


def test_what_a_job_leaves_in_its_folder_for_temporary_files_goes_with_it() -> None:
    async def work() -> str:
        return await Jobs().run(tempfile.mkdtemp, within=60.0)

    assert not Path(finished(work())).exists()


def test_a_job_that_is_given_up_while_it_starts_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    started: list[Worker] = []
    begin, has_begun = workers.start, threading.Event()

    def begin_late(*arguments: Any) -> Worker:
        time.sleep(0.2)
        started.append(begin(*arguments))
        has_begun.set()
        return started[0]

    async def work() -> None:
        job = asyncio.ensure_future(Jobs().run(time.sleep, 60.0, within=60.0))
        await asyncio.sleep(0.05)
        job.cancel()
        with pytest.raises(asyncio.CancelledError):
            await job
        assert await asyncio.to_thread(has_begun.wait, 20.0)

    monkeypatch.setattr(workers, "start", begin_late)
    finished(work())
    started[0].process.join(20.0)

    assert not started[0].process.is_alive()


class Standing:
    """A process that does nothing."""

    def kill(self) -> None:
        """End it."""

    def join(self, timeout: float | None = None) -> None:
        """Wait for its end."""


def test_drives_that_begin_together_are_no_more_than_may_go_on(monkeypatch: pytest.MonkeyPatch) -> None:
    ends = []

    def begin_late(*_: object) -> Worker:
        time.sleep(0.05)
        here, there = multiprocessing.Pipe()
        ends.append(there)
        return Worker(Standing(), here, tempfile.TemporaryDirectory())

    async def work() -> list[object]:
        table = Sessions()
        order = Order("a drive", Sent(".svg", b""), Path("world.svg"))
        begun = await asyncio.gather(*(table.begin(order) for _ in range(12)), return_exceptions=True)
        for end in ends:
            end.close()
        table.close()
        return begun

    monkeypatch.setattr(sessions, "start", begin_late)
    begun = finished(work())

    assert 12 - MOST_GOING == sum(isinstance(one, WorkerError) for one in begun)
