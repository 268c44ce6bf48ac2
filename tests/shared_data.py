"""Where the data of others is, if it is here; it is not ours to pack with the project."""

from pathlib import Path

import pytest

LOGS = Path(__file__).resolve().parents[1] / ".." / "shared" / "data" / "logs"
needs_logs = pytest.mark.skipif(not LOGS.exists(), reason="the shared laser logs are not here")
