"""Where the data of others is, if it is here; it is not ours to pack with the project."""

from pathlib import Path

import pytest

DATA = Path(__file__).resolve().parents[1] / ".." / "shared" / "data"
LOGS = DATA / "logs"
needs_logs = pytest.mark.skipif(not LOGS.exists(), reason="the shared laser logs are not here")
needs_bags = pytest.mark.skipif(not (DATA / "bags").exists(), reason="the shared bags are not here")
PLANS = DATA / "plans"
VECTOR = DATA / "vector"
SKETCHES = DATA / "sketches"
needs_plans = pytest.mark.skipif(not PLANS.exists(), reason="the shared floor plans are not here")
needs_sketches = pytest.mark.skipif(not SKETCHES.exists(), reason="the shared drawings are not here")
needs_vector = pytest.mark.skipif(not VECTOR.exists(), reason="the shared vector plans are not here")


def plan(name: str) -> Path:
    """Return the path of one of the floor plans by others."""
    return PLANS / name
