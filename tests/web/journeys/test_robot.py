"""A robot on the network, as a person meets it on the page: watched, allowed to drive, and stopped."""

import os
import re
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip("cyclonedds")

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, BrowserContext, Page, expect

from loopback_robot import LoopbackRobot
from web_page import PATIENCE_MS, Sheet, wait_until

pytestmark = pytest.mark.slow
DOMAIN = 97
LIMITS = ("--radius", "0.2", "--speed", "0.4", "--turn-rate", "1", "--braking", "0.5")


@pytest.fixture
def robot() -> Iterator[LoopbackRobot]:
    """A robot on the network."""
    robot = LoopbackRobot(DOMAIN)
    robot.start()
    yield robot
    robot.end()


@pytest.fixture
def table(tmp_path: Path) -> Iterator[tuple[str, subprocess.Popen[bytes]]]:
    """Address of a table that may drive the robot, and its process."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    pilotage = Path(sys.executable).with_name("pilotage")
    options = ["--no-browser", "--port", str(port), "--token", "robot", "--ros2", "--domain", str(DOMAIN)]
    with tempfile.TemporaryDirectory() as left:  # a test kills the server, which then cannot tidy up
        server = subprocess.Popen(  # noqa: S603  # our own command
            [pilotage, "table", tmp_path, *options, "--drive", *LIMITS], env={**os.environ, "TMPDIR": left}
        )
        for _ in range(300):
            with socket.socket() as caller:
                if caller.connect_ex(("127.0.0.1", port)) == 0:
                    break
            time.sleep(0.1)
        yield f"http://127.0.0.1:{port}/?token=robot", server
        server.terminate()
        server.wait(30)


def open_page(context: BrowserContext, address: str) -> Page:
    """Open a tab."""
    page = context.new_page()
    page.goto(address)
    page.wait_for_selector("body[data-ready]")
    return page


def let_drive(page: Page, robot: LoopbackRobot) -> None:
    """Press the button, and wait until the wheels turn."""
    page.get_by_test_id("let-drive").click()
    expect(page.get_by_test_id("mode")).to_contain_text("The real robot drives to Ana", timeout=PATIENCE_MS)
    wait_until(page, lambda: robot.moves)


def test_a_real_robot_is_watched_driven_by_a_button_and_stopped(
    browser: Browser, table: tuple[str, subprocess.Popen[bytes]], robot: LoopbackRobot
) -> None:
    context = browser.new_context(viewport={"width": 1280, "height": 900})
    address, server = table
    page = open_page(context, address)
    sheet = Sheet(page)
    page.get_by_role("button", name="office, careful").click()
    expect(sheet.summary).to_contain_text(re.compile("[1-9] cells"), timeout=PATIENCE_MS)
    page.get_by_role("button", name="Drive", exact=True).click()
    page.get_by_role("combobox", name="World").select_option("robot")
    page.get_by_test_id("go").click()
    expect(page.get_by_test_id("probability")).to_be_visible(timeout=2 * PATIENCE_MS)
    expect(page.get_by_test_id("mode")).to_contain_text("Dry run")
    expect(page.get_by_role("button", name="Step")).to_be_disabled()
    page.get_by_role("combobox", name="Goal").select_option("Ana")
    expect(page.get_by_test_id("let-drive")).to_be_enabled(timeout=PATIENCE_MS)
    assert 0 == robot.heard
    violations = Axe().run(page).response["violations"]
    assert [] == [one["id"] for one in violations if one["impact"] in ("serious", "critical")]
    sheet.shot("robot-dry")

    let_drive(page, robot)
    page.wait_for_timeout(3000)
    sheet.shot("robot")
    page.get_by_test_id("stop").click()
    wait_until(page, lambda: not robot.moves)
    expect(page.get_by_test_id("mode")).to_contain_text("Dry run", timeout=PATIENCE_MS)
    let_drive(page, robot)
    page.keyboard.press("Escape")
    wait_until(page, lambda: not robot.moves)

    other = open_page(context, page.url)
    expect(other.get_by_test_id("why-not")).to_contain_text("another page commands", timeout=PATIENCE_MS)
    let_drive(page, robot)
    other.get_by_test_id("stop").click()
    wait_until(other, lambda: not robot.moves)
    let_drive(page, robot)
    page.close()
    wait_until(other, lambda: not robot.moves)
    expect(other.get_by_test_id("let-drive")).to_be_enabled(timeout=PATIENCE_MS)
    let_drive(other, robot)
    server.kill()
    wait_until(other, lambda: not robot.moves)
    context.close()
