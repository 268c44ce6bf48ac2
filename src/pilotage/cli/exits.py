"""How a run ends: its exit code, and one line for whatever went wrong."""

import contextlib
import os
import signal
import sys
import threading
import traceback
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import TypeVar

from pilotage.cli.terminal import say
from pilotage.errors import PilotageError

FAILURE, BUG = 1, 70
"""Exit codes: of an unusable input or output, and of a mistake of ours (EX_SOFTWARE in sysexits.h)."""
SIGNALLED = 128
"""Added to the number of a signal, it is the exit code of a run that the signal ended."""
LONGEST = 200
"""Letters of the message of an unexpected error that are shown."""
SHOW_TRACEBACK = "PILOTAGE_TRACEBACK"
"""An environment variable: if it is set, the traceback of an error is printed before its line."""


Item = TypeVar("Item")


class Stopped(KeyboardInterrupt):
    """The run was asked to end by a signal other than that of Ctrl-C."""

    def __init__(self, number: int) -> None:
        super().__init__()
        self.number = number


class Signals:
    """What signals do: they interrupt at once, or after the block in which they are held back."""

    holding = False
    waiting: int | None = None

    @classmethod
    def handle(cls, number: int, _frame: FrameType | None) -> None:
        """Interrupt what is going on, now or at the end of a block that holds signals back."""
        if cls.holding and cls.waiting is None:
            cls.waiting = number
        else:
            cls.waiting = None
            raise KeyboardInterrupt if number == signal.SIGINT else Stopped(number)


@contextmanager
def interrupted_by_signals() -> Iterator[None]:
    """Let SIGTERM and SIGHUP interrupt as Ctrl-C does, so that no temporary file is left.

    A signal that the caller ignores or handles, as `nohup` does, is left alone.
    """
    names = ("SIGINT", "SIGTERM", "SIGHUP")
    numbers = [getattr(signal, name) for name in names if hasattr(signal, name)]
    is_main = threading.current_thread() is threading.main_thread()
    defaults = (signal.SIG_DFL, signal.default_int_handler)
    before = {number: signal.getsignal(number) for number in numbers if is_main}
    ours = {number: handler for number, handler in before.items() if handler in defaults}
    for number in ours:
        signal.signal(number, Signals.handle)
    try:
        yield
    finally:
        for number, handler in ours.items():
            signal.signal(number, handler)


@contextmanager
def signals_held() -> Iterator[None]:
    """Let a signal wait until the block is done: an exception inside compiled code may crash Python.

    A second signal does not wait.
    """
    Signals.holding = True
    try:
        yield
    finally:
        Signals.holding = False
        number, Signals.waiting = Signals.waiting, None
    if number is not None:
        Signals.handle(number, None)


def interrupted_between(items: Iterable[Item]) -> Iterator[Item]:
    """Go through items, each made while signals are held."""
    source = iter(items)
    while True:
        with signals_held():
            item = next(source, None)
        if item is None:
            return
        yield item


def report(error: BaseException) -> int:
    """Say in one line why a run ended, and return its exit code."""
    interrupt = interrupt_behind(error)
    if interrupt is not None:
        number = interrupt.number if isinstance(interrupt, Stopped) else signal.SIGINT
        say("; ".join(["pilotage: interrupted", *getattr(interrupt, "__notes__", ())]))
        return SIGNALLED + number
    if isinstance(error, SystemExit):
        return error.code if isinstance(error.code, int) else FAILURE if error.code else 0
    if isinstance(error, BrokenPipeError):  # the reader of our output has seen enough
        silence_output()
        return FAILURE
    if os.environ.get(SHOW_TRACEBACK):
        say("".join(traceback.format_exception(error)).rstrip())
    say(f"pilotage: error: {' '.join(describe(error).split())}")
    return FAILURE if isinstance(error, PilotageError | OSError) else BUG


def describe(error: BaseException) -> str:
    """Say what went wrong."""
    if isinstance(error, PilotageError):
        return str(error)
    if isinstance(error, MemoryError):
        return f"there is not enough memory for this input, {SHOW_TRACEBACK}=1 prints the traceback"
    if isinstance(error, OSError):
        what = error.strerror or str(error)
        where = error.filename
        return f"output cannot be written ({what})" if where is None else f"{what}: {where}"
    return (
        f"this is a mistake in pilotage ({type(error).__name__}: {str(error)[:LONGEST]}),"
        f" please report it with the traceback that {SHOW_TRACEBACK}=1 prints"
    )


def interrupt_behind(error: BaseException) -> KeyboardInterrupt | None:
    """Find the KeyboardInterrupt that typer turned into an exit, or the error itself if it is one."""
    cause: BaseException | None = error
    if isinstance(error, SystemExit) and error.code == SIGNALLED + signal.SIGINT:
        while cause is not None and not isinstance(cause, KeyboardInterrupt):
            cause = cause.__cause__ or cause.__context__
    return cause if isinstance(cause, KeyboardInterrupt) else None


def flush_output(code: int) -> int:
    """Write what standard output still holds, and return the exit code: another one if that fails."""
    try:
        sys.stdout.flush()
    except OSError as error:
        failure = report(error)
        silence_output()
        return code or failure
    return code


def silence_output() -> None:
    """Send what is still to be written to standard output to nowhere."""
    with contextlib.suppress(OSError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
