"""Film the drawing table: a flat is drawn, its rooms are named, and a robot drives through it.

    python -m examples.make_table_film [docs/images/table.gif]

takes a minute and needs chromium and the extra `dev`. What a person would do is done by mouse and keyboard in
the real page, and every picture is the page as it is then. The drive is shown faster than it was watched.
"""

import io
import sys
import tempfile
import time
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

from benchmarks.lib.table_browser import opened_browser, opened_page
from benchmarks.lib.table_server import serving
from PIL import Image
from playwright.sync_api import Page

SIZE = (960, 600)
COLORS = 64
TICK = 0.12
"""Time [s] that a picture of the drawing is shown."""
DRIVE = 11.0
"""Time [s] in which the drive is shown, however long it was watched."""
LAST = 3.0
"""Time [s] that the last picture is shown."""
ACCENTS = (
    *("#d1495b", "#e0a100", "#4f9d69", "#1f6f8b", "#8c4a2f", "#e79a3c", "#7cc4dc", "#b58a5a", "#7a5fc0"),
    *("#e2eef4", "#ecf3e5", "#faf3e1", "#f8ebe9", "#efecf7", "#e8f4f0", "#5b6470", "#20262e", "#ffffff"),
)
"""Colors of the page that only thin lines have, or that are nearly white."""
POINTER = """addEventListener("mousemove", event => {
  const dot = document.getElementById("pointer") ?? document.body.appendChild(document.createElement("div"));
  dot.id = "pointer";
  Object.assign(dot.style, {position: "fixed", width: "18px", height: "18px", borderRadius: "50%",
    background: "rgba(209, 73, 91, .55)", zIndex: 9999, pointerEvents: "none", translate: "-50% -50%",
    left: event.clientX + "px", top: event.clientY + "px"});
}, true)"""
"""A dot where the mouse is: pictures of a page show none."""


class Film:
    """Pictures of a page, and how long each is shown [s]."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.pictures: list[Image.Image] = []
        self.shown: list[float] = []

    def take(self, shown: float = TICK) -> None:
        """Take a picture."""
        picture = Image.open(io.BytesIO(self.page.screenshot(type="jpeg", quality=95)))
        self.pictures.append(picture.convert("RGB").resize(SIZE, Image.Resampling.LANCZOS))
        self.shown.append(shown)

    def drag(self, start: Sequence[float], end: Sequence[float], steps: int = 4) -> None:
        """Draw from here to there."""
        mouse = self.page.mouse
        mouse.move(*start)
        mouse.down()
        for k in range(1, steps + 1):
            mouse.move(*(a + (b - a) * k / steps for a, b in zip(start, end, strict=True)))
            self.take()
        mouse.up()

    def box(self, left: float, top: float, right: float, bottom: float) -> None:
        """Draw a room."""
        self.page.keyboard.press("r")
        self.drag((left, top), (right, bottom))
        self.page.keyboard.press("Escape")

    def write(self, x: float, y: float, words: str) -> None:
        """Name a room."""
        self.page.keyboard.press("t")
        self.page.mouse.click(x, y)
        self.page.locator("textarea.excalidraw-wysiwyg").wait_for()
        for k in range(0, len(words), 3):
            self.page.keyboard.type(words[k : k + 3])
            self.take()
        self.page.keyboard.press("Escape")

    def tool(self, name: str, *places: Sequence[float]) -> None:
        """Use a tool of the table at some places."""
        button = self.page.get_by_role("toolbar", name="Tools of the drawing table").get_by_role(
            "button", name=name
        )
        button.hover()
        button.click()
        self.take(2 * TICK)
        for x, y in places:
            self.page.mouse.move(x, y)
            self.page.mouse.click(x, y)
            self.page.wait_for_timeout(500)  # until it is understood
            self.take(3 * TICK)

    def wait(self, summary: str) -> None:
        """Wait until what is drawn is understood, and take a picture."""
        self.page.get_by_test_id("summary").filter(has_text=summary).wait_for()
        self.take(4 * TICK)

    def watch(self, until: str, most: float = 90.0) -> None:
        """Take pictures as fast as they come until something is there [s]."""
        began, times = time.monotonic(), []
        while not self.page.locator(until).count() and time.monotonic() - began < most:
            times.append(time.monotonic())
            self.take()
        times.append(time.monotonic())
        hurry = (times[-1] - times[0]) / DRIVE
        self.shown[-len(times) + 1 :] = [(b - a) / hurry for a, b in pairwise(times)]

    def save(self, path: Path) -> None:
        """Write an animation whose pictures share their colors."""
        sample = Image.new("RGB", (SIZE[0], 7 * SIZE[1]))
        for k in range(6):
            sample.paste(self.pictures[(k + 1) * len(self.pictures) // 6 - 1], (0, k * SIZE[1]))
        for k, color in enumerate(ACCENTS):  # thin lines would not be missed otherwise
            sample.paste(color, (k * SIZE[0] // len(ACCENTS), 6 * SIZE[1], SIZE[0], 7 * SIZE[1]))
        palette = sample.quantize(COLORS, method=Image.Quantize.MEDIANCUT)
        first, *rest = [one.quantize(palette=palette, dither=Image.Dither.NONE) for one in self.pictures]
        durations = [round(1e3 * shown) for shown in self.shown]
        first.save(path, save_all=True, append_images=rest, duration=durations, loop=0, optimize=True)


def draw(film: Film) -> None:
    """Draw a flat of four rooms with doors, and a flag."""
    film.page.mouse.click(640, 740)  # gives the editor the keyboard
    film.take()
    film.box(300, 150, 560, 380)
    film.box(560, 150, 900, 380)
    film.box(300, 380, 700, 620)
    film.box(700, 380, 900, 620)
    film.wait("4 cells")
    film.write(400, 240, "kitchen")
    film.write(760, 560, "bath")
    film.write(430, 500, "living room")
    film.tool("Door", (560, 280), (430, 380), (700, 500))
    film.wait("4 cells, 3 openings")
    film.tool("Goal", (820, 230))
    film.take(5 * TICK)


def drive(film: Film) -> None:
    """Let a robot drive to the flag, in this drawing made real."""
    page = film.page
    page.get_by_role("button", name="Drive", exact=True).click()
    page.get_by_role("combobox", name="Speed").select_option("2")
    page.get_by_label("How wrong the drawing is").fill("0.4")
    page.get_by_test_id("go").hover()
    film.take(10 * TICK)
    page.get_by_test_id("go").click()
    page.get_by_test_id("probability").wait_for()
    page.mouse.move(640, 560)
    film.watch("[data-testid=status]:not([data-outcome=''])")
    page.wait_for_timeout(3000)  # the drawing is corrected once more
    film.take(LAST)


def main() -> None:
    """Film, and say how long and how large it became."""
    path = Path(sys.argv[1] if len(sys.argv) > 1 else "docs/images/table.gif")
    with (
        tempfile.TemporaryDirectory() as folder,
        serving(Path(folder)) as server,
        opened_browser() as browser,
    ):
        if browser is None:
            raise SystemExit("a film needs chromium and playwright")
        with opened_page(browser, server) as page:
            page.evaluate(f"() => {{ {POINTER} }}")
            film = Film(page)
            draw(film)
            drive(film)
    film.save(path)
    print(f"{path}: {len(film.shown)} pictures, {sum(film.shown):.1f} s, {path.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
