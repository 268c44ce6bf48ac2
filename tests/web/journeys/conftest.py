"""The drawing table as a person meets it: the real server, and the page in a real browser."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

pytest.importorskip("playwright.sync_api", reason="playwright is not installed")

from benchmarks.lib.table_browser import opened_browser
from httpx2 import Client
from playwright.sync_api import Browser, Page, expect

from web_page import PATIENCE_MS, Sheet


@pytest.fixture
def folder(drawings: Path) -> Path:
    """The folder of the server."""
    return drawings


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Debian's chromium; the test is skipped where there is none."""
    with opened_browser() as opened:
        if opened is None:
            pytest.skip("no chromium is installed")
        yield opened


@pytest.fixture
def page(browser: Browser, address: str) -> Iterator[Page]:
    """A page that is ready to draw on, and has shown nothing before."""
    with watched(browser, address) as page:
        yield page
    end_drives(address)


@contextmanager
def watched(browser: Browser, address: str) -> Iterator[Page]:
    """Open a page until it can be drawn on. It must raise no error and ask nobody but its server."""
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


def end_drives(address: str) -> None:
    """End the drives of a test: one that is no longer watched goes on, beside the next test."""
    server, _, token = address.partition("/?token=")
    headers = {"Authorization": f"Bearer {token}"}
    with Client(base_url=server, headers=headers) as client:
        for drive in client.get("/api/sessions").json()["sessions"]:
            client.delete(f"/api/sessions/{drive['session']}").raise_for_status()


@pytest.fixture
def sheet(page: Page) -> Sheet:
    """The sheet of a page that is ready to draw on."""
    return Sheet(page)


@pytest.fixture(scope="module")
def used_page(browser: Browser, address: str) -> Iterator[Page]:
    """A page that several tests draw on, one after the other."""
    with watched(browser, address) as page:
        yield page


@pytest.fixture
def new_sheet(used_page: Page) -> Sheet:
    """A new sheet of a page on which others were drawn before."""
    used_page.get_by_role("button", name="File").click()
    used_page.get_by_role("button", name="New, empty sheet").click()
    sheet = Sheet(used_page)
    expect(sheet.summary).to_contain_text("0 cells", timeout=PATIENCE_MS)
    return sheet
