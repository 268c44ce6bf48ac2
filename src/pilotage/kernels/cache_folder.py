"""Make sure that numba finds a folder for its compiled code: without one it refuses to compile."""

import atexit
import os
import shutil
import sys
import tempfile
from pathlib import Path

from platformdirs import user_cache_dir

VARIABLE = "NUMBA_CACHE_DIR"


def ensure_cache_folder() -> None:
    """Point numba to a temporary folder if none of the folders that it would use is writable.

    The folder is new for each process, and removed at its end: numba runs what its cache holds, and a folder
    with a known name in a shared place could be filled by others. Child processes inherit it.
    """
    if any(is_writable(folder) for folder in candidates()):
        return
    try:
        folder = tempfile.mkdtemp(prefix="pilotage-numba-")
    except OSError:
        return  # `compiling.njit` does without a cache then
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    os.environ[VARIABLE] = folder
    if "numba" in sys.modules:  # it has read its environment already
        sys.modules["numba"].config.CACHE_DIR = folder


def candidates() -> list[Path]:
    """List where numba looks for a place, in its order."""
    asked_for = os.environ.get(VARIABLE)
    return [
        *([Path(asked_for)] if asked_for else []),
        Path(__file__).parent / "__pycache__",
        Path(user_cache_dir("numba", appauthor=False)),
    ]


def is_writable(folder: Path) -> bool:
    """Tell whether files can be written to a folder, which is made if there is none."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError:
        return False
    return True
