"""What a session keeps, and what a slow client gets."""

import asyncio

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pilotage.web.history import History
from pilotage.web.sessions import Client
from pilotage.web.workers import Jobs, WorkerError


def test_a_slow_client_gets_the_newest_of_each_kind_and_nothing_piles_up() -> None:
    async def watch() -> tuple[list[str], list[str]]:
        client = Client()
        for k in range(1000):
            client.put("frame", f"frame {k}")
            client.put("state", f"state {k}")
        first = await client.take()
        client.put("frame", "next")
        return first, await client.take()

    assert (["state 999", "frame 999"], ["next"]) == asyncio.run(watch())


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
    import time

    async def work() -> int:
        jobs = Jobs()
        with pytest.raises(WorkerError, match="ended unexpectedly"):
            await jobs.run(os._exit, 3, within=60.0)
        with pytest.raises(WorkerError, match=r"longer than 0\.3 s"):
            await jobs.run(time.sleep, 60.0, within=0.3)
        return await jobs.run(len, "abc", within=60.0)

    assert 3 == asyncio.run(work())
