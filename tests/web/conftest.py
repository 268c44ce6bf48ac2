"""Servers with workers of their own: one in this process for each test, and the real command for all."""

import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip("starlette")

from starlette.testclient import TestClient

from few_particles import FEW, FEW_AS_TOML
from pilotage.web.app import build_app
from pilotage.web.folder import Folder
from pilotage.web.guard import Access
from pilotage.web.table import Table
from web_table import TOKEN


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder of drawings, in a folder with a secret."""
    drawings = tmp_path / "drawings"
    drawings.mkdir()
    (tmp_path / "secret.svg").write_text("<svg>secret</svg>")
    return drawings


@pytest.fixture
def table(folder: Path) -> Table:
    """What the routes share; its robots keep few particles."""
    return Table(Folder(folder), settings=FEW)


@pytest.fixture
def stranger(table: Table, tmp_path: Path) -> Iterator[TestClient]:
    """A client without a token."""
    static = tmp_path / "static"
    (static / "assets").mkdir(parents=True)
    (static / "index.html").write_text("<!doctype html><title>table</title>")
    (static / "assets" / "page.js").write_text("// the page")
    app = build_app(table, Access(TOKEN, frozenset({"127.0.0.1:8765"})), static)
    with TestClient(app, base_url="http://127.0.0.1:8765", follow_redirects=False) as client:
        yield client


@pytest.fixture
def client(stranger: TestClient) -> TestClient:
    """A client with the token."""
    stranger.headers["Authorization"] = f"Bearer {TOKEN}"
    return stranger


@pytest.fixture(scope="session")
def drawings(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the command that runs."""
    return tmp_path_factory.mktemp("drawings")


@pytest.fixture(scope="session")
def address(drawings: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Address that the command prints, with its token."""
    said = tmp_path_factory.mktemp("said") / "stderr.txt"
    pilotage = Path(sys.executable).with_name("pilotage")
    settings = said.with_name("few.toml")
    settings.write_text(FEW_AS_TOML)
    command = [pilotage, "table", drawings, "--no-browser", "--port", "0", "--settings", settings]
    with said.open("w") as stderr, subprocess.Popen(command, stderr=stderr) as server:  # noqa: S603  # our own
        try:
            while not said.read_text().endswith("\n"):
                assert server.poll() is None
                time.sleep(0.05)
            yield said.read_text().split()[-1]
        finally:
            server.terminate()
            server.wait(30)
    assert "Traceback" not in said.read_text()
