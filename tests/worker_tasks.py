"""What tests let other processes do; it must be importable there."""

import os
import signal
from pathlib import Path

from pilotage.errors import FileError


def square(number):
    return number * number


def die_once(marker):
    """Kill the own process the first time."""
    if not Path(marker).exists():
        Path(marker).touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return marker


def die_if_negative(number):
    if number < 0:
        os.kill(os.getpid(), signal.SIGKILL)
    return square(number)


def fail_if_negative(number):
    if number < 0:
        raise FileError("numbers must not be negative", str(number))
    return square(number)


def measured(name):
    """Stand in for a benchmark: one fails, one kills its process, others have a figure."""
    from benchmarks.all import Answer
    from benchmarks.lib.results import Measurement

    if name == "deadly":
        os.kill(os.getpid(), signal.SIGKILL)
    if name == "failing":
        return Answer("a line\n", 1.0, None, "it fell over")
    return Answer("a line\n", 1.0, Measurement(name, "", "", "", {}, {"name": name}))
