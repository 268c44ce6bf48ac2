"""Drives that are watched in the browser, and what a person does to them."""

import re

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, expect

from web_page import PATIENCE_MS, Sheet

pytestmark = pytest.mark.slow

SERIOUS = ("serious", "critical")


def set_goal(sheet: Sheet, x: float, y: float) -> None:
    """Put the flag here."""
    sheet.tool("Goal")
    sheet.page.mouse.click(x, y)


def pick_up(sheet: Sheet) -> tuple[float, float]:
    """Return where on the screen the robot is, in a drive that stands."""
    sheet.page.get_by_role("button", name="Pause").click()
    expect(sheet.page.get_by_role("button", name="Go on")).to_be_visible()
    x, y = (
        float(part)
        for part in (sheet.page.get_by_test_id("world").get_attribute("data-robot") or "").split(",")
    )
    return sheet.in_world(x, y)


def test_a_robot_reaches_the_goal_on_a_drawing_made_real(sheet: Sheet) -> None:
    sheet.draw_flat()
    set_goal(sheet, 800, 240)
    sheet.drive(speed=10)
    sheet.page.wait_for_timeout(800)
    sheet.shot("drive")
    sheet.ended("reached")
    sheet.shot("reached")

    timeline = sheet.page.get_by_test_id("timeline")
    timeline.fill("1")
    expect(sheet.page.get_by_role("button", name="Now")).to_be_enabled(timeout=PATIENCE_MS)
    sheet.shot("scrub")
    with sheet.page.expect_download(timeout=8 * PATIENCE_MS) as video:
        sheet.page.get_by_role("button", name="Video", exact=True).click()
    content = video.value.path().read_bytes()
    assert content[4:8] == b"ftyp" or content.startswith(b"\x1a\x45\xdf\xa3")  # MP4 or WebM
    assert len(content) > 50_000
    expect(sheet.page.get_by_role("button", name="Now")).to_be_disabled(timeout=PATIENCE_MS)


def test_a_kidnapped_robot_doubts_and_finds_itself_again(sheet: Sheet) -> None:
    sheet.page.get_by_role("button", name="office, careful").click()
    expect(sheet.summary).to_contain_text(re.compile("[1-9] cells"), timeout=PATIENCE_MS)
    sheet.page.get_by_role("button", name="Drive", exact=True).click()
    sheet.page.get_by_role("combobox", name="World").select_option("packed:office")
    sheet.page.get_by_role("combobox", name="Goal").select_option("workshop")
    sheet.page.get_by_role("combobox", name="Speed").select_option("10")
    sheet.page.get_by_test_id("go").click()
    expect(sheet.marks).to_contain_text("believes", timeout=2 * PATIENCE_MS)
    robot = pick_up(sheet)
    world = sheet.page.get_by_test_id("world").bounding_box()
    assert world is not None
    elsewhere = (world["x"] + 0.6 * world["width"], world["y"] + 0.3 * world["height"])
    sheet.drag(robot, elsewhere)
    expect(sheet.marks).to_contain_text(re.compile("carried|moved|kidnap"), timeout=PATIENCE_MS)
    sheet.shot("kidnap")
    sheet.page.get_by_role("button", name="Go on").click()

    expect(sheet.page.locator(".status.lost, .status.mismatch")).to_be_visible(timeout=2 * PATIENCE_MS)
    sheet.shot("doubt")
    expect(sheet.page.locator(".status.located")).to_be_visible(timeout=4 * PATIENCE_MS)
    sheet.shot("recovered")


def test_a_closed_door_is_told_and_a_reload_goes_on_with_the_drive(sheet: Sheet) -> None:
    page = sheet.page
    page.get_by_role("button", name="office, careful").click()
    expect(sheet.summary).to_contain_text(re.compile("[1-9] cells"), timeout=PATIENCE_MS)
    page.get_by_role("button", name="Drive", exact=True).click()
    page.get_by_role("combobox", name="World").select_option("packed:office")
    page.get_by_role("combobox", name="Goal").select_option("workshop")
    page.get_by_test_id("go").click()
    expect(page.get_by_test_id("probability")).to_be_visible(timeout=PATIENCE_MS)
    page.get_by_role("button", name="Door", exact=True).click()
    x, y = (
        float(part) for part in (page.get_by_test_id("world").get_attribute("data-door") or "").split(",")
    )
    page.mouse.click(*sheet.in_world(x, y))

    expect(sheet.marks).to_contain_text("door", timeout=PATIENCE_MS)
    sheet.shot("door")
    page.reload()
    expect(page.get_by_test_id("probability")).to_be_visible(timeout=PATIENCE_MS)
    expect(sheet.marks).to_contain_text("door", timeout=PATIENCE_MS)
    page.get_by_role("button", name="Back to the drawing").click()
    expect(sheet.summary).to_contain_text(re.compile("[1-9] cells"), timeout=PATIENCE_MS)


def test_nothing_seriously_bars_people_who_see_or_move_differently(page: Page, sheet: Sheet) -> None:
    faults = []
    sheet.draw_flat()
    set_goal(sheet, 800, 240)
    faults += serious(page)
    sheet.drive(speed=20)
    page.get_by_role("button", name="Pause").click()
    faults += serious(page)

    assert [] == faults


def serious(page: Page) -> list[str]:
    """List what axe-core finds that is serious or worse."""
    found = Axe().run(page).response["violations"]
    return [
        f"{one['id']}: {node['html'][:160]}"
        for one in found
        if one["impact"] in SERIOUS
        for node in one["nodes"]
    ]
