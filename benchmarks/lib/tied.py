"""Run a benchmark that ends with who started it: `python -m benchmarks.lib.tied NAME [options]`.

Who starts it makes it the first of a process group and holds the other end of its standard input. Once this
is closed, the whole group is killed, processes that the benchmark has started included.
"""

import os
import signal

from benchmarks.__main__ import main


def watch() -> None:
    """Leave a process behind that waits for the end of the standard input."""
    if os.fork():
        return
    nowhere = os.open(os.devnull, os.O_RDWR)
    for stream in (1, 2):  # whose readers wait for all who hold them
        os.dup2(nowhere, stream)
    os.read(0, 1)
    os.killpg(0, signal.SIGKILL)


if __name__ == "__main__":
    watch()
    main()
