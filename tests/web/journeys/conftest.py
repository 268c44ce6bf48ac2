"""The drawing table as a person meets it: the real server, and the page in a real browser."""

import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip("playwright.sync_api", reason="playwright is not installed")

from benchmarks.lib.table_browser import opened_browser
from playwright.sync_api import Browser, Page

from web_page import Sheet


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the server."""
    return tmp_path_factory.mktemp("drawings")


@pytest.fixture(scope="session")
def address(folder: Path) -> Iterator[str]:
    """Address of the page, with its token."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    pilotage = Path(sys.executable).with_name("pilotage")
    command = [pilotage, "table", folder, "--no-browser", "--port", str(port), "--token", "journeys"]
    server = subprocess.Popen(command)  # noqa: S603  # our own command
    for _ in range(300):
        with socket.socket() as caller:
            if caller.connect_ex(("127.0.0.1", port)) == 0:
                break
        time.sleep(0.1)
    yield f"http://127.0.0.1:{port}/?token=journeys"
    server.terminate()
    server.wait(30)


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Debian's chromium; the test is skipped where there is none."""
    with opened_browser() as opened:
        if opened is None:
            pytest.skip("no chromium is installed")
        yield opened


@pytest.fixture
def page(browser: Browser, address: str) -> Iterator[Page]:
    """A page that is ready to draw on. It must raise no error and ask nobody but its server."""
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    page = context.new_page()
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on("console", lambda said: errors.append(said.text) if "Content Security" in said.text else None)
    page.goto(address)
    page.wait_for_selector("body[data-ready]")
    yield page
    context.close()

    assert [] == errors


@pytest.fixture
def sheet(page: Page) -> Sheet:
    """The sheet of a page that is ready to draw on."""
    return Sheet(page)
