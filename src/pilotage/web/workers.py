"""Processes that do the work: each is forked in milliseconds from one that has loaded everything.

A worker that fails, hangs or is killed takes nothing else with it.
"""

import asyncio
import contextlib
import multiprocessing
import os
import sys
import tempfile
import threading
from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.connection import Connection
from multiprocessing.context import ForkServerContext, SpawnContext
from multiprocessing.process import BaseProcess
from typing import TypeVar

from pilotage.errors import PilotageError

Result = TypeVar("Result")

MEMORY = 4 << 30
"""Bytes of address space of a worker that reads what a page sent; libraries alone take half a gigabyte."""
JOBS = 2
"""Drawings that are read at the same time; further ones wait."""


class WorkerError(Exception):
    """A worker ended without a result: it crashed, or its time was over."""


class RefusedError(Exception):
    """What a worker was given will not do; the message says why."""


def context() -> ForkServerContext | SpawnContext:
    """Return how processes are started; forking is safe from a process that runs no threads."""
    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn")
    forking = multiprocessing.get_context("forkserver")
    forking.set_forkserver_preload(["__main__", "pilotage.web.preload"])
    return forking


def warm_up() -> None:
    """Start the process that workers are forked from; it loads in the background."""
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"):
        os.environ.setdefault(name, "1")  # drives share the processors; threads of one would starve others
    if "forkserver" in multiprocessing.get_all_start_methods():
        context()
        from multiprocessing import forkserver

        forkserver.ensure_running()


@dataclass(frozen=True, slots=True)
class Worker:
    """A process, the connection to it, and its temporary files, which it cannot delete if it is killed."""

    process: BaseProcess
    connection: Connection
    folder: "tempfile.TemporaryDirectory[str]"

    def end(self) -> None:
        """Kill the process; `tidy` is still to be called."""
        self.process.kill()

    def tidy(self) -> None:
        """Wait for the end of the process, and delete what it leaves."""
        self.process.join()
        self.folder.cleanup()


def start(work: Callable[..., None], *arguments: object) -> Worker:
    """Start a worker that talks over a connection, its first argument."""
    here, there = multiprocessing.Pipe()
    folder = tempfile.TemporaryDirectory(prefix="pilotage-", ignore_cleanup_errors=True)
    process = context().Process(target=run, args=(folder.name, there, work, *arguments), daemon=True)
    process.start()
    there.close()
    return Worker(process, here, folder)


async def started(work: Callable[..., None], *arguments: object) -> Worker:
    """Start a worker in a thread; one that nobody waits for any more is ended once it has begun."""
    starting = asyncio.ensure_future(asyncio.to_thread(start, work, *arguments))
    try:
        return await asyncio.shield(starting)
    except asyncio.CancelledError:
        starting.add_done_callback(end_unwanted)
        raise


def end_unwanted(starting: "asyncio.Future[Worker]") -> None:
    """End a worker that has begun."""
    if not starting.cancelled() and starting.exception() is None:
        starting.result().end()
        starting.get_loop().run_in_executor(None, starting.result().tidy)


def run(folder: str, connection: Connection, work: Callable[..., None], *arguments: object) -> None:
    """Do the work in the worker; the end of the connection ends it too."""
    tempfile.tempdir = folder
    with contextlib.suppress(ConnectionError, EOFError, KeyboardInterrupt):
        work(connection, *arguments)


class Jobs:
    """Runs functions in workers of their own, no more than a few at once, each within a time limit."""

    def __init__(self) -> None:
        self._free = asyncio.Semaphore(JOBS)

    async def run(
        self, function: Callable[..., Result], *arguments: object, within: float, name: str = "the work"
    ) -> Result:
        """Return what a function returns.

        Raises RefusedError with the message of a PilotageError, WorkerError for all else.
        """
        async with self._free:
            worker = await started(answer, function, *arguments)
            try:
                is_there = await waited(worker.connection, within)
                if not is_there:
                    raise WorkerError(f"{name} took longer than {within:g} s and was stopped")
                is_right, result = worker.connection.recv()
            except (EOFError, OSError) as error:
                raise WorkerError(f"{name} failed: its process ended unexpectedly") from error
            finally:
                worker.connection.close()
                worker.end()
                asyncio.get_running_loop().run_in_executor(None, worker.tidy)
        if is_right:
            found: Result = result
            return found
        raise RefusedError(result)


async def waited(connection: Connection, within: float) -> bool:
    """Wait until something can be read; a question that nobody waits for any more is given up."""
    given_up = threading.Event()

    def wait() -> bool:
        steps = max(int(within / 0.05), 1)
        return any(connection.poll(0.05) for _ in range(steps) if not given_up.is_set())

    try:
        return await asyncio.to_thread(wait)
    finally:
        given_up.set()


def answer(connection: Connection, function: Callable[..., object], *arguments: object) -> None:
    """Send what a function returns, or why it refused."""
    limit_memory()
    try:
        connection.send((True, function(*arguments)))
    except PilotageError as error:
        connection.send((False, str(error)))
    except MemoryError:
        connection.send((False, "there is not enough memory for this drawing"))


def limit_memory() -> None:
    """Let a worker fail, rather than the machine, if it takes too much."""
    if sys.platform == "linux":
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
