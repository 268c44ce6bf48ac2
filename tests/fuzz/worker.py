"""Read files in a process of its own, and bound its time and memory.

The process reads paths from its standard input, and answers each with a line of JSON.
"""

import contextlib
import json
import os
import resource
import select
import signal
import subprocess
import sys
import time
import traceback
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Self

ROOT = Path(__file__).resolve().parents[2]

SECONDS = 60.0
"""The longest that a hostile file may take of the processor; what grows without bound takes longer."""

PATIENCE = 5.0
"""How many times longer it may take by the clock, on a machine that does other things too."""

MEGABYTES = 1_000.0
"""The most memory that the process may take, libraries included."""

HARD_BYTES = 6 << 30
"""Beyond this much address space the system itself says no."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """What came of a file."""

    name: str
    outcome: str  # read, refused, or what is wrong
    seconds: float
    mb: float
    detail: str = ""  # the message, or the end of the traceback

    @property
    def is_bad(self) -> bool:
        """Whether the file broke a promise."""
        return self.outcome not in ("read", "refused")


class Worker:
    """A process that reads files; it is started anew when it hangs, dies or has grown too large."""

    def __init__(self) -> None:
        self.process: subprocess.Popen[bytes] | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_error: object) -> None:
        self.stop()

    def read(self, path: Path) -> Verdict:
        """Read one file."""
        process = self.process or self.start()
        assert process.stdin is not None
        assert process.stdout is not None
        process.stdin.write(os.fsencode(path) + b"\n")
        process.stdin.flush()
        began = time.monotonic()
        ready, _, _ = select.select([process.stdout], [], [], PATIENCE * SECONDS)
        line = process.stdout.readline() if ready else b""
        took = time.monotonic() - began
        if not line:
            self.stop()
            hangs = not ready or process.returncode == -signal.SIGPROF
            return Verdict(path.name, "hangs" if hangs else "kills the process", took, 0.0)
        answer = json.loads(line)
        outcome = answer.pop("outcome")
        if answer["seconds"] > SECONDS:
            outcome = "takes too long"
        if answer["mb"] > MEGABYTES:
            outcome = "takes too much memory"
            self.stop()
        return Verdict(path.name, outcome, **answer)

    def start(self) -> subprocess.Popen[bytes]:
        """Start the process and wait until it is ready."""
        self.process = subprocess.Popen(
            [sys.executable, "-m", "tests.fuzz.worker"],
            cwd=ROOT,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )
        assert self.process.stdout is not None
        assert self.process.stdout.readline() == b"ready\n"
        return self.process

    def stop(self) -> None:
        """End the process."""
        if self.process is not None:
            self.process.kill()
            self.process.communicate()
            self.process = None


def serve() -> None:
    """Answer until the standard input ends."""
    resource.setrlimit(resource.RLIMIT_AS, (HARD_BYTES, HARD_BYTES))
    warnings.simplefilter("ignore")
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # nothing that a library prints gets among the answers
    print("ready", file=answers, flush=True)
    for line in sys.stdin:
        began = time.process_time()
        signal.setitimer(signal.ITIMER_PROF, 2.0 * SECONDS)  # of the processor; it ends the process
        outcome, detail = outcome_of(Path(line.rstrip("\n")))
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        answer = {
            "outcome": outcome,
            "detail": detail,
            "seconds": time.process_time() - began,
            "mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0,
        }
        print(json.dumps(answer), file=answers, flush=True)


def outcome_of(path: Path) -> tuple[str, str]:
    """Read a file as a user would, and say what came of it."""
    from pilotage.errors import PilotageError

    try:
        read(path)
    except PilotageError as error:
        bad = "\n" in str(error) or not str(error)
        return ("is refused in no clear line" if bad else "refused"), str(error)[:300]
    except BaseException as error:  # noqa: BLE001  # that is what is looked for
        last = traceback.extract_tb(error.__traceback__)[-1]
        where = f"{Path(last.filename).name}:{last.lineno}"
        return "traceback", f"{type(error).__name__} at {where}: {error}"[:300]
    return "read", ""


def read(path: Path) -> None:
    """Read a file by the reader that its name asks for; a drawing is understood and checked, too."""
    from pilotage.config import read_settings
    from pilotage.findings import report
    from pilotage.io import open_log, open_world
    from pilotage.io.hints import read_hints
    from pilotage.io.maps import open_drawing
    from pilotage.io.records import read_records

    if path.name.startswith("world"):
        open_world(path)
    elif path.name.startswith("run"):
        open_log(path)
    elif path.name.startswith("settings"):
        read_settings(path)
    elif path.suffix == ".toml":
        read_hints(path)
    elif path.suffix == ".jsonl":
        read_records(path)
    else:
        drawing = open_drawing(path)
        report(drawing.sketch, drawing.interpretation)


if __name__ == "__main__":
    with contextlib.suppress(KeyboardInterrupt, BrokenPipeError):
        serve()
