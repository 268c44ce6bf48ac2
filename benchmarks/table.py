"""Measure how fast the drawing table answers: alone, with a drive, and with eight drives at once.

    python -m benchmarks table

The server is started as `pilotage table` starts it, and asked over HTTP and websockets:

- ready: from the start of the command until the page and its first request are answered;
- cells: from sending a drawing of 60 strokes until its cells are there;
- a drive in the packed office at twice real time: frames a second at the client, and processor time that
  the server and the making of a frame take for each, beside the robot's step;
- load: so many drives at once, restarted when they are over, while the page asks for files and cells;
- build: size of the packed page, zipped.

With playwright and Debian's chromium, a person's view of the same is measured on the page:

- ready: from the start of the command until the page can be drawn on;
- cells: from the end of a stroke on a drawing of 60 until its cells are shown;
- frames a second that the page has shown of a drive at twice real time.

Without them it says that these are not measured.
"""

import argparse
import io
import itertools
import json
import tempfile
import threading
import time
import zipfile
from pathlib import Path

import numpy as np

from benchmarks.lib.arguments import positive, seconds
from benchmarks.lib.data import ROOT
from benchmarks.lib.results import Figures
from benchmarks.lib.table_browser import frames_per_second, opened_browser, opened_page, time_strokes
from benchmarks.lib.table_server import TableServer, heard, serving
from benchmarks.lib.tables import table
from pilotage import worlds

QUESTIONS = 40
STROKES = 60
STROKES_DRAWN = 20
PAUSE = 0.25  # [s] between two questions of a page under load
IN_OFFICE = {"drawing": "example:office/quick", "world": "packed:office", "goal": "Ana"}
STATIC = ROOT / "src" / "pilotage" / "web" / "static"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Choose how long and how much."""
    parser.add_argument("--seconds", type=seconds, default=60.0, help="under load (default: %(default)s)")
    parser.add_argument("--drives", type=positive, default=8, help="at once (default: %(default)s)")


def measure(arguments: argparse.Namespace) -> Figures:
    """Print each figure as it is measured, and return all."""
    with tempfile.TemporaryDirectory() as folder, serving(Path(folder)) as server:
        for path in ("/", "/api/drawings"):
            server.ask(path)
        figures: Figures = {"ready_s": time.monotonic() - server.started}
        print(f"ready after {figures['ready_s']:.2f} s")
        figures["cells_s"] = time_cells(server)
        figures |= watch_one(server, arguments.seconds / 3.0)
        server.end_drives()
        figures["load"] = load(server, arguments.drives, arguments.seconds)
    figures["browser"] = look(arguments.seconds / 3.0)
    figures["build_mb"] = zipped_size() / 1e6
    print(f"page: {figures['build_mb']:.2f} MB zipped")
    return figures


def time_cells(server: TableServer) -> list[float]:
    """Ask for the cells of a drawing that changes a little each time; median and 95th percentile [s]."""
    server.ask("/api/understand", drawing(0))  # once the workers are there
    taken = []
    for k in range(QUESTIONS):
        began = time.monotonic()
        found = json.loads(server.ask("/api/understand", drawing(k)))
        taken.append(time.monotonic() - began)
        assert len(found["cells"]) > 1
    median, late = np.quantile(taken, (0.5, 0.95)).tolist()
    print(f"cells of {STROKES} strokes: {median:.3f} s, 95 % within {late:.3f} s")
    return [median, late]


def look(seconds: float) -> Figures | None:
    """Measure in a browser what a person sees; None without one."""
    with opened_browser() as browser, tempfile.TemporaryDirectory() as folder:
        if browser is None:
            print("not measured, for want of playwright or chromium: page ready, strokes and frames in it")
            return None
        plan = Path(folder, "sixty.svg")
        plan.write_bytes(drawing(0))
        with serving(Path(folder)) as server, opened_page(browser, server) as page:
            ready = time.monotonic() - server.started
            median, late = np.quantile(time_strokes(page, plan, STROKES_DRAWN), (0.5, 0.95)).tolist()
            fps = frames_per_second(page, seconds)
    print(f"in the browser: ready after {ready:.2f} s, {fps:.1f} frames a second")
    print(f"in the browser: stroke to cells {median:.3f} s, 95 % within {late:.3f} s")
    return {"ready_s": ready, "cells_s": [median, late], "fps": fps}


def drawing(k: int) -> bytes:
    """Draw a floor of 60 wobbly strokes: ten rooms on each side of a corridor, but for two walls."""
    rng = np.random.default_rng(k)
    lines = [((0, 0), (1000, 0)), ((1000, 0), (1000, 500)), ((1000, 500), (0, 500)), ((0, 500), (0, 0))]
    for side, wall in ((0, 200), (500, 300)):
        for left in range(0, 1000, 100):
            lines += [((left, wall), (left + 30, wall)), ((left + 55, wall), (left + 100, wall))]
        lines += [((left, side), (left, wall)) for left in range(100, 900, 100)]
    assert len(lines) == STROKES
    paths = []
    for start, end in lines:
        points = np.linspace(start, end, 12) + rng.normal(0.0, 0.6, (12, 2))
        points[[0, -1]] = start, end
        paths.append("M" + " L".join(f"{x:.1f} {y:.1f}" for x, y in points))
    content = "".join(f'<path d="{path}"/>' for path in paths)
    box = 'viewBox="-10 -10 1020 520" fill="none" stroke="black"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {box}>{content}</svg>'.encode()


def watch_one(server: TableServer, seconds: float) -> Figures:
    """Watch a drive; frames a second, and milliseconds of the processor a frame."""
    with server.live(**IN_OFFICE, speed=2) as websocket:
        next(one for one in heard(websocket, time.monotonic() + 60.0) if one["type"] == "frame")
        began, cpu = time.monotonic(), server.cpu()
        frames = sum(one["type"] == "frame" for one in heard(websocket, began + seconds))
        took = time.monotonic() - began
        serving_ms = 1e3 * (server.cpu() - cpu) / max(frames, 1)
    frame_ms = serving_ms + making_ms()
    print(f"one drive: {frames / took:.1f} frames a second, {frame_ms:.1f} ms a frame")
    return {"fps": frames / took, "frame_ms": frame_ms}


def making_ms() -> float:
    """Measure how long the worker of a drive takes to make a frame [ms], median."""
    from pilotage.web.order import Order, Sent
    from pilotage.web.stage import set_stage

    office = worlds.OFFICE
    stage = set_stage(Order("", Sent(".svg", office.quick.read_bytes()), office.world, goal="Ana"))
    taken = []
    for _ in range(100):
        stage.step()
        began = time.process_time()
        json.dumps(stage.frame())
        taken.append(time.process_time() - began)
    return 1e3 * float(np.median(taken))


def load(server: TableServer, drives: int, seconds: float) -> Figures:
    """Let drives go on at once, and ask as a page does meanwhile."""
    until = time.monotonic() + seconds
    dropped: list[str] = []
    watching = [
        threading.Thread(target=keep_driving, args=(server, seed, until, dropped)) for seed in range(drives)
    ]
    for one in watching:
        one.start()
    pages = []
    for path in itertools.cycle(("/", "/api/drawings", "/api/sessions", "/api/examples/office/quick")):
        if time.monotonic() >= until:
            break
        began = time.monotonic()
        server.ask(path)
        pages.append(time.monotonic() - began)
        time.sleep(PAUSE)
    for one in watching:
        one.join()
    print(
        f"{drives} drives: slowest page {max(pages):.3f} s of {len(pages)}, {len(dropped)} dropped {dropped}"
    )
    return {"drives": drives, "slowest_s": max(pages), "dropped": len(dropped)}


def keep_driving(server: TableServer, seed: int, until: float, dropped: list[str]) -> None:
    """Watch drives, one after the other, until the time is over; note those that break off."""
    while time.monotonic() < until:
        try:
            with server.live(**IN_OFFICE, seed=seed, speed=2) as websocket:
                for message in heard(websocket, until):
                    if message["type"] == "error":
                        dropped.append(message["text"])
                    if message["type"] in ("done", "error"):
                        break
        except (OSError, EOFError, RuntimeError) as error:
            dropped.append(str(error))
            return
        seed += 100


def zipped_size() -> int:
    """Pack the page as a wheel does [bytes]."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(STATIC.rglob("*")):
            archive.write(path, path.relative_to(STATIC))
    return len(packed.getvalue())


def render(figures: Figures) -> str:
    """Write the table of README."""
    cells, late = figures["cells_s"]
    loaded, seen = figures["load"], figures.get("browser")
    at_once = f"{loaded['drives']} drives at once"
    rows = [
        ("from `pilotage table` to the first answers", f"{figures['ready_s']:.1f} s"),
        (f"cells of {STROKES} strokes, median and 95th percentile", f"{cells:.2f} s, {late:.2f} s"),
        ("frames a second with one drive, at twice real time", f"{figures['fps']:.0f}"),
        ("processor time a frame, beside the robot's step", f"{figures['frame_ms']:.1f} ms"),
        (f"{at_once}: slowest page answer", f"{loaded['slowest_s']:.2f} s"),
        (f"{at_once}: dropped drives", f"{loaded['dropped']}"),
        *rows_in_browser(seen),
        ("the page, zipped", f"{figures['build_mb']:.1f} MB"),
    ]
    return table(("what", "measured"), rows)


def rows_in_browser(seen: Figures | None) -> list[tuple[str, str]]:
    """Write the rows that need a browser."""
    names = (
        "in the browser: from `pilotage table` to a page that can be drawn on",
        f"in the browser: from a stroke to its cells, {STROKES} strokes, median and 95th percentile",
        "in the browser: frames a second",
    )
    if seen is None:
        return [(name, "not measured") for name in names]
    median, late = seen["cells_s"]
    return list(
        zip(
            names,
            (f"{seen['ready_s']:.1f} s", f"{median:.2f} s, {late:.2f} s", f"{seen['fps']:.0f}"),
            strict=True,
        )
    )
