"""A real browser on the page of the drawing table, and what a person would see there, with times."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from shutil import which
from typing import TYPE_CHECKING

from benchmarks.lib.table_server import TOKEN, TableServer

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page, WebSocket

CHROMIUM = which("chromium") or which("chromium-browser")
ARGUMENTS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)
"""A browser that needs no screen and asks nobody."""
PATIENCE_MS = 60_000
"""The machine may be busy."""
SHOWN_SINCE = (
    """since => performance.getEntriesByName("cells-shown").find(one => one.startTime > since)?.startTime"""
)
LAST_STROKE = """() => performance.getEntriesByName("stroke").at(-1)?.startTime ?? 0"""


@contextmanager
def opened_browser() -> "Iterator[Browser | None]":
    """Open Debian's chromium; None if it or playwright is not installed."""
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        yield None
        return
    if CHROMIUM is None:
        yield None
        return
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=ARGUMENTS)
        yield browser
        browser.close()


@contextmanager
def opened_page(browser: "Browser", server: TableServer) -> "Iterator[Page]":
    """Open the page until it can be drawn on."""
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    page = context.new_page()
    page.set_default_timeout(PATIENCE_MS)
    page.goto(f"http://127.0.0.1:{server.port}/?token={TOKEN}")
    page.wait_for_selector("body[data-ready]")
    yield page
    context.close()


def time_strokes(page: "Page", drawing: Path, count: int) -> list[float]:
    """Open a drawing and add short strokes; times [s] from the end of each until its cells are shown."""
    since = float(page.evaluate("performance.now()"))
    page.get_by_test_id("file-input").set_input_files(drawing)
    page.wait_for_function(SHOWN_SINCE, arg=since)
    page.mouse.click(640, 740)  # gives the editor the keyboard
    page.keyboard.press("Escape")
    taken = []
    for k in range(count):
        page.keyboard.press("7")
        x, y = 300.0 + 20.0 * k, 250.0 + 60.0 * (k % 3)
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + 8.0, y + 10.0)
        page.mouse.move(x + 12.0, y + 30.0)
        page.mouse.up()
        page.wait_for_timeout(50)  # until the editor has told the page
        stroke = float(page.evaluate(LAST_STROKE))
        shown = page.wait_for_function(SHOWN_SINCE, arg=stroke).json_value()
        taken.append((float(shown) - stroke) / 1e3)
    return taken


def frames_per_second(page: "Page", seconds: float) -> float:
    """Drive by an example at twice real time; frames a second that the page says it has shown."""
    seen: list[float] = []

    def watch(line: "WebSocket") -> None:
        line.on("framesent", lambda said: seen.append(time.monotonic()) if '"seen"' in str(said) else None)

    page.on("websocket", watch)
    page.get_by_role("button", name="File").click()
    page.get_by_role("button", name="office, quick").last.click()
    page.get_by_role("button", name="Drive", exact=True).click()
    page.get_by_role("combobox", name="World").select_option("packed:office")
    page.get_by_role("combobox", name="Goal").select_option("Ana")
    page.get_by_role("combobox", name="Speed").select_option("2")
    page.get_by_test_id("go").click()
    page.get_by_test_id("probability").wait_for()
    began = time.monotonic()
    page.wait_for_timeout(1e3 * seconds)
    took = time.monotonic() - began
    return sum(began <= one < began + took for one in seen) / took
