"""A drive in its worker answers whatever the page asks."""

import multiprocessing
from pathlib import Path
from types import SimpleNamespace

from pilotage.web.driver import Driver
from pilotage.web.order import Order, Sent


class Failing(Driver):
    """A drive whose drawing cannot be corrected, for a reason that nobody has thought of."""

    def _corrected(self) -> str:
        raise ValueError("a fit needs two points")


def test_an_export_that_fails_is_answered_at_once(tmp_path: Path) -> None:
    here, there = multiprocessing.Pipe()
    order = Order("a drive", Sent(".svg", b""), Path("world.svg"))
    path = str(tmp_path / "corrected.svg")
    Failing(there, SimpleNamespace(stamp=1.0), order)._obey(  # noqa: SLF001  # what the page sends
        {"type": "export", "kind": "corrected", "path": path}
    )

    assert ("exported", 1.0, {"path": path, "failure": "a fit needs two points"}) == here.recv()
