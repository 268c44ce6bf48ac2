"""A drive in its worker answers whatever the page asks."""

import multiprocessing
from pathlib import Path
from types import SimpleNamespace

import pytest

from pilotage.errors import FileError
from pilotage.web import driver
from pilotage.web.driver import Driver, drive_in_worker
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


def test_a_recording_that_breaks_off_says_why(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken() -> None:
        raise FileError("the bag cannot be read", "run.bag")

    show = SimpleNamespace(stamp=1.0, describe=lambda _title: {}, describe_world=lambda: None, step=broken)
    monkeypatch.setattr(driver, "set_stage", lambda _order: show)
    monkeypatch.setattr(driver, "be_polite", lambda: None)
    here, there = multiprocessing.Pipe()
    drive_in_worker(there, Order("a drive", Sent(".svg", b""), Path("world.svg")))

    assert "session" == here.recv()[0]
    kind, _, said = here.recv()
    assert ("error", True) == (kind, said["fatal"])
    assert "the bag cannot be read" == said["text"]
