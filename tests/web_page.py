"""Draws on the page of the drawing table by mouse and keyboard, and reads what it says."""

import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from playwright.sync_api import Browser, Locator, Page, expect

PICTURES = os.environ.get("TABLE_PICTURES")
"""Folder in which the pictures of the journeys are kept; without it none are taken."""

PATIENCE_MS = 60_000
"""The machine may be busy with other tests."""


@dataclass(frozen=True, slots=True)
class Sheet:
    """A page of the drawing table."""

    page: Page

    def box(self, left: float, top: float, right: float, bottom: float) -> None:
        """Draw a rectangle."""
        self._take("r", "toolbar-rectangle")
        self.drag((left, top), (right, bottom))
        self.page.keyboard.press("Escape")

    def drag(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        """Press, move and release."""
        mouse = self.page.mouse
        mouse.move(*start)
        mouse.down()
        mouse.move((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
        mouse.move(*end)
        mouse.up()

    def write(self, x: float, y: float, words: str) -> None:
        """Write words."""
        self._take("t", "toolbar-text")
        self.page.mouse.click(x, y)
        text = self.page.locator("textarea.excalidraw-wysiwyg")
        expect(text).to_be_focused(timeout=PATIENCE_MS)  # a moment after the click
        self.page.keyboard.type(words)
        self.page.keyboard.press("Escape")

    def _take(self, key: str, button: str) -> None:
        """Take a tool of the editor in hand by its key, and wait until the editor has it."""
        self.page.keyboard.press(key)
        expect(self.page.get_by_test_id(button)).to_be_checked(timeout=PATIENCE_MS)

    def tool(self, name: str) -> None:
        """Choose a tool of the table, or leave it."""
        tools = self.page.get_by_role("toolbar", name="Tools of the drawing table")
        tools.get_by_role("button", name=name).click()

    def doors(self, *places: tuple[float, float]) -> None:
        """Cut doors."""
        self.tool("Door")
        for place in places:
            self.page.mouse.click(*place)
        self.tool("Door")

    def focus(self) -> None:
        """Give the editor the keyboard."""
        self.page.mouse.click(640, 740)

    def draw_flat(self) -> None:
        """Draw four rooms with doors between them, two of them named."""
        self.focus()
        self.box(300, 150, 560, 380)
        self.box(560, 150, 900, 380)
        self.box(300, 380, 700, 620)
        self.box(700, 380, 900, 620)
        self.write(400, 240, "kitchen")
        self.write(760, 480, "bath")
        self.doors((560, 280), (430, 380), (700, 520))
        expect(self.summary).to_contain_text("4 cells, 3 openings", timeout=PATIENCE_MS)

    def drive(self, speed: int = 10, severity: float = 0.2) -> None:
        """Start a drive through this drawing, made real."""
        self.page.get_by_role("button", name="Drive", exact=True).click()
        self.page.get_by_label("How wrong the drawing is").fill(str(severity))
        self.page.get_by_role("combobox", name="Speed").select_option(str(speed))
        self.page.get_by_test_id("go").click()
        expect(self.page.get_by_test_id("probability")).to_be_visible(timeout=PATIENCE_MS)

    def in_world(self, x: float, y: float) -> tuple[float, float]:
        """Return where on the screen a point of the world [m] is."""
        canvas = self.page.get_by_test_id("world")
        box = canvas.bounding_box()
        assert box is not None
        scale = float(canvas.get_attribute("data-scale") or 1)
        left, top = (float(part) for part in (canvas.get_attribute("data-shift") or "0,0").split(","))
        return box["x"] + left + scale * x, box["y"] + top + scale * y

    def shot(self, name: str) -> None:
        """Take a picture if the environment says where to keep it."""
        if PICTURES:
            self.page.screenshot(path=Path(PICTURES, f"table-{name}.png"))

    @property
    def summary(self) -> Locator:
        """What is understood, in words."""
        return self.page.get_by_test_id("summary")

    @property
    def status(self) -> Locator:
        """What the robot is about, in words."""
        return self.page.get_by_test_id("status")

    @property
    def marks(self) -> Locator:
        """What happened last."""
        return self.page.get_by_test_id("marks")

    def ended(self, outcome: str) -> None:
        """Wait until the drive has ended like this."""
        expect(self.status).to_have_attribute("data-outcome", re.compile(outcome), timeout=8 * PATIENCE_MS)


def on_a_phone(browser: Browser, address: str) -> Sheet:
    """Open the quick drawing of the office on a phone; who calls it closes the page's context."""
    context = browser.new_context(viewport={"width": 390, "height": 760}, has_touch=True)
    page = context.new_page()
    page.goto(address)
    page.wait_for_selector("body[data-ready]")
    page.get_by_role("button", name="office, quick").tap()
    sheet = Sheet(page)
    expect(sheet.summary).to_contain_text(re.compile("[1-9] cells"), timeout=PATIENCE_MS)
    return sheet


def wait_until(page: Page, is_so: Callable[[], bool]) -> None:
    """Wait until something holds."""
    for _ in range(PATIENCE_MS // 50):
        if is_so():
            return
        page.wait_for_timeout(50)
    raise AssertionError
