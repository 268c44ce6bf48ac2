"""Where the data of others is, if it is here; it is not ours to pack with the project."""

from pathlib import Path

import pytest

DATA = Path(__file__).resolve().parents[1] / ".." / "shared" / "data"
LOGS = DATA / "logs"
needs_logs = pytest.mark.skipif(not LOGS.exists(), reason="the shared laser logs are not here")
needs_bags = pytest.mark.skipif(not (DATA / "bags").exists(), reason="the shared bags are not here")
