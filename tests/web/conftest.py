"""A server in this process, with workers of its own."""

from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip("starlette")

from starlette.testclient import TestClient

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
    """What the routes share."""
    return Table(Folder(folder))


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
