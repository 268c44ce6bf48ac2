"""Measure how fast the drawing table answers: alone, with a drive, and with eight drives at once.

    python -m benchmarks table [--seconds S] [--drives N]

The server is started as `pilotage table` starts it, and asked over HTTP and websockets, without a browser:

- ready: from the start of the command until the page and its first request are answered;
- cells: from sending a drawing of 60 strokes until its cells are there;
- a drive in the packed office at twice real time: frames a second at the client, and processor time that
  the server and the making of a frame take for each, beside the robot's step;
- load: so many drives at once, restarted when they are over, while the page asks for files and cells;
- build: size of the packed page, zipped.
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
from benchmarks.lib.table_server import TableServer, heard, serving
from benchmarks.lib.tables import table
from pilotage import worlds

QUESTIONS = 40
STROKES = 60
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
        figures["load"] = load(server, arguments.drives, arguments.seconds)
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
    return {"slowest_s": max(pages), "dropped": len(dropped)}


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
    load_figures = figures["load"]
    rows = [
        ("from `pilotage table` to the first answers", f"{figures['ready_s']:.1f} s"),
        (f"cells of {STROKES} strokes, median and 95th percentile", f"{cells:.2f} s, {late:.2f} s"),
        ("frames a second with one drive, at twice real time", f"{figures['fps']:.0f}"),
        ("processor time a frame, beside the robot's step", f"{figures['frame_ms']:.1f} ms"),
        ("8 drives at once: slowest page answer", f"{load_figures['slowest_s']:.2f} s"),
        ("8 drives at once: dropped drives", f"{load_figures['dropped']}"),
        ("the page, zipped", f"{figures['build_mb']:.1f} MB"),
    ]
    return table(("what", "measured"), rows)
