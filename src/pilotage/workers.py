"""Run tasks in processes of this machine, or on a cluster; a killed process loses none of them.

Results come as they are made, in any order. A task must give the same result wherever it runs.
"""

import asyncio
import multiprocessing
import signal
from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import (
    FIRST_COMPLETED,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
    wait,
)
from concurrent.futures.process import BrokenProcessPool
from types import TracebackType
from typing import Any, Protocol, Self, TypeVar

from pilotage.errors import PilotageError

Task = TypeVar("Task")
Result = TypeVar("Result")

ATTEMPTS = 3
"""How often a task is tried whose process is killed meanwhile."""
PATIENCE = "10s"
"""How long a scheduler may take to answer."""


UNREADABLE = "deserialization"
"""A word of the message of a scheduler whose workers cannot read their tasks."""


class LostTaskError(PilotageError):
    """The processes that tried a task were killed, again and again."""


class FailedTaskError(PilotageError):
    """A task met a mistake of ours: it alone is left out, not what hours of work found."""

    @classmethod
    def of(cls, error: Exception) -> Self:
        """Say what went wrong."""
        return cls(f"this is a mistake in pilotage ({type(error).__name__}: {error}), please report it")


class ClusterError(PilotageError):
    """A cluster cannot be used."""


class Workers(Protocol):
    """Where tasks are run."""

    def run(
        self, function: Callable[[Task], Result], tasks: Iterable[Task]
    ) -> Iterator[tuple[Task, Result | PilotageError]]:
        """Yield each task with its result, or with what went wrong."""


class Processes:
    """Processes of this machine; a context that ends them, and what they are doing, when it is left.

    Functions, tasks and results must pass from one process to another; tasks must be hashable.
    """

    def __init__(self, count: int) -> None:
        if count < 1:
            raise ValueError(f"the number of processes must be >= 1, got {count}")
        self._count = count
        self._pool = self._new_pool()

    def __enter__(self) -> Self:
        """Return itself: processes start when they are needed."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """End all processes, at once after an error."""
        if kind is not None:
            self._pool.shutdown(wait=False, cancel_futures=True)
            for process in multiprocessing.active_children():
                process.terminate()
        self._pool.shutdown()

    def run(
        self, function: Callable[[Task], Result], tasks: Iterable[Task]
    ) -> Iterator[tuple[Task, Result | PilotageError]]:
        """Yield results; what a killed process had is tried again after all others, and alone.

        When a process is killed, its pool ends, so no more tasks are begun than there are processes. Who is
        tried alone cannot suffer from another.
        """
        fresh, lost = deque(tasks), deque[Task]()
        failures: Counter[Task] = Counter()
        running: dict[Future[Result], Task] = {}
        while fresh or lost or running:
            while fresh and len(running) < self._count:
                self._submit(running, function, fresh.popleft())
            if not running:
                self._submit(running, function, lost.popleft())
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                task = running.pop(future)
                try:
                    yield task, future.result()
                except BrokenProcessPool:
                    failures[task] += 1
                    if failures[task] < ATTEMPTS:
                        lost.append(task)
                    else:
                        yield task, LostTaskError("the processes that tried it were killed")
                except PilotageError as error:
                    yield task, error
                except Exception as error:  # noqa: BLE001  # a mistake of ours
                    yield task, FailedTaskError.of(error)

    def _submit(
        self, running: dict[Future[Result], Task], function: Callable[[Task], Result], task: Task
    ) -> None:
        """Begin a task, in a new pool if the one there was is broken."""
        try:
            future = self._pool.submit(function, task)
        except BrokenProcessPool:
            self._pool = self._new_pool()
            future = self._pool.submit(function, task)
        running[future] = task

    def _new_pool(self) -> ProcessPoolExecutor:
        return ProcessPoolExecutor(
            self._count, mp_context=multiprocessing.get_context("spawn"), initializer=leave_signals_alone
        )


def leave_signals_alone() -> None:
    """Let the process that started this one decide what Ctrl-C means."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def knock(address: str) -> None:
    """Connect with a scheduler, and leave it; raises OSError or ValueError if there is none.

    In a thread of its own: the caller's may have an event loop that runs, as in a notebook.
    """
    from distributed.comm.core import connect

    async def visit() -> None:
        connection = await connect(address, timeout=PATIENCE)
        await connection.close()

    with ThreadPoolExecutor(1) as thread:
        thread.submit(lambda: asyncio.run(visit())).result()


class Cluster:
    """Workers of a Dask scheduler, which gives the tasks of a dead worker to others (extra `cluster`).

    A context. Files must have the same paths on all workers, and `pilotage` must be installed there.
    """

    def __init__(self, address: str) -> None:
        try:
            from distributed import Client
        except ImportError as error:
            raise ClusterError(
                "a cluster needs the extra cluster: pip install 'pilotage[cluster]'"
            ) from error
        try:
            knock(address)  # a client that fails to connect may stop the start of a later one
            self._client: Any = Client(address, timeout=PATIENCE, set_as_default=False)
        except (OSError, ValueError, AssertionError) as error:  # the last if its own thread does not start
            reason = (str(error) or type(error).__name__).splitlines()[0]
            raise ClusterError(f"there is no scheduler of Dask at {address} ({reason})") from error

    def __enter__(self) -> Self:
        """Return itself, connected."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Leave the scheduler; it drops what was not finished."""
        self._client.close()

    def run(
        self, function: Callable[[Task], Result], tasks: Iterable[Task]
    ) -> Iterator[tuple[Task, Result | PilotageError]]:
        """Yield results; a task whose workers die again and again is lost."""
        from distributed import KilledWorker, as_completed

        begun = {self._client.submit(function, task, pure=False): task for task in tasks}
        for future in as_completed(list(begun), loop=self._client.loop):
            task = begun.pop(future)
            try:
                yield task, future.result()
            except KilledWorker:
                yield task, LostTaskError("the workers that tried it died")
            except PilotageError as error:
                yield task, error
            except Exception as error:  # a mistake of ours, or workers without pilotage
                if isinstance(error, ImportError) or UNREADABLE in str(error):
                    raise ClusterError("a worker lacks pilotage, or has another version of it") from error
                yield task, FailedTaskError.of(error)
