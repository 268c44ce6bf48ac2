"""Drives that are watched in the browser, and what a person does to them."""

import re
from itertools import pairwise
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Locator, Page, expect

from web_page import PATIENCE_MS, Sheet, on_a_phone

pytestmark = pytest.mark.slow

SERIOUS = ("serious", "critical")


def set_goal(sheet: Sheet, x: float, y: float) -> None:
    """Put the flag here."""
    sheet.tool("Goal")
    sheet.page.mouse.click(x, y)


def in_the_world(sheet: Sheet, what: str) -> list[tuple[float, float]]:
    """Return where the robot or the doors are in the world [m]."""
    told = sheet.page.get_by_test_id("world").get_attribute(f"data-{what}") or ""
    return [(float(x), float(y)) for x, y in (one.split(",") for one in told.split())]


def pause(sheet: Sheet) -> None:
    """Let the drive stand."""
    sheet.page.get_by_role("button", name="Pause").click()
    expect(sheet.page.get_by_role("button", name="Go on")).to_be_visible()


def way_until(sheet: Sheet, outcome: str) -> list[tuple[float, float]]:
    """Watch the drive to its end, and return the way of the robot through the world [m]."""
    way = []
    for _ in range(80 * PATIENCE_MS // 1000):
        way += in_the_world(sheet, "robot")
        if sheet.status.get_attribute("data-outcome"):
            break
        sheet.page.wait_for_timeout(100)
    sheet.ended(outcome)
    return way


def test_a_robot_reaches_the_goal_on_a_drawing_made_real(sheet: Sheet) -> None:
    sheet.draw_flat()
    set_goal(sheet, 800, 240)
    sheet.drive(speed=10)
    sheet.page.wait_for_timeout(800)
    sheet.shot("drive")
    sheet.ended("reached")
    found = sheet.page.get_by_test_id("believed")
    expect(found).to_have_attribute("data-corrected", re.compile(r"0\.[6-9]|1"), timeout=2 * PATIENCE_MS)
    sheet.shot("reached")
    sheet.page.get_by_role("checkbox", name=re.compile("drawing as found: .* seen")).uncheck()
    expect(found).to_have_attribute("data-corrected", "")

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
    pause(sheet)
    robot = sheet.in_world(*in_the_world(sheet, "robot")[0])
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


def test_a_door_closed_in_mid_drive_leads_to_a_detour_and_a_reload_goes_on(sheet: Sheet) -> None:
    page = sheet.page
    sheet.focus()
    sheet.box(300, 150, 600, 620)
    sheet.box(600, 150, 900, 620)
    sheet.doors((600, 240), (600, 530))
    expect(sheet.summary).to_contain_text("2 cells, 2 openings", timeout=PATIENCE_MS)
    set_goal(sheet, 830, 230)
    sheet.tool("Start")
    sheet.drag((360, 230), (420, 230))
    page.get_by_role("button", name="Drive", exact=True).click()
    page.get_by_label("tell the robot where it starts").check()
    sheet.drive(speed=1, severity=0.0)
    pause(sheet)
    near, far = sorted(in_the_world(sheet, "doors"), key=lambda door: door[1])
    page.get_by_role("button", name="Door", exact=True).click()
    page.mouse.click(*sheet.in_world(*near))
    expect(sheet.marks).to_contain_text("a door was closed", timeout=PATIENCE_MS)
    page.reload()
    expect(page.get_by_test_id("probability")).to_be_visible(timeout=PATIENCE_MS)
    expect(sheet.marks).to_contain_text("a door was closed", timeout=PATIENCE_MS)
    page.get_by_role("combobox", name="Speed").select_option("20")
    page.get_by_role("button", name="Go on").click()
    way = way_until(sheet, "reached")

    sheet.shot("detour")
    assert way[0][0] < near[0]
    assert way[-1][0] > near[0]
    after, before = next((a, b) for a, b in pairwise(reversed(way)) if b[0] <= near[0] < a[0])
    crossing = before[1] + (near[0] - before[0]) / (after[0] - before[0]) * (after[1] - before[1])
    assert abs(crossing - far[1]) < abs(crossing - near[1])
    page.get_by_role("button", name="Back to the drawing").click()
    expect(sheet.summary).to_contain_text("2 cells, 2 openings", timeout=PATIENCE_MS)


def test_a_drive_begins_again_in_the_same_building_after_a_reload(sheet: Sheet, folder: Path) -> None:
    page = sheet.page
    sheet.draw_flat()
    page.get_by_role("button", name="Drive", exact=True).click()
    set_goal(sheet, 1100, 700)
    page.get_by_test_id("go").click()
    expect(page.get_by_role("alert")).to_contain_text("goal", timeout=PATIENCE_MS)
    expect(page.get_by_role("button", name="Pause")).to_be_hidden()
    page.get_by_label("Seed").fill("7")
    page.get_by_role("combobox", name="Goal").select_option("bath")
    sheet.drive(speed=1, severity=0.9)
    doors = in_the_world(sheet, "doors")
    page.reload()
    expect(page.get_by_test_id("probability")).to_be_visible(timeout=PATIENCE_MS)
    before = page.url
    page.get_by_role("button", name="Restart").click()
    expect(page).not_to_have_url(before, timeout=PATIENCE_MS)
    expect(page.get_by_test_id("probability")).to_be_visible(timeout=PATIENCE_MS)

    assert doors == in_the_world(sheet, "doors")
    address = page.url
    page.get_by_role("button", name="Draw", exact=True).click()
    expect(sheet.summary).to_contain_text("4 cells", timeout=PATIENCE_MS)
    page.get_by_role("button", name="Back to the drive").click()
    expect(page.get_by_test_id("probability")).to_be_visible(timeout=PATIENCE_MS)
    assert page.url == address
    page.get_by_role("button", name="Box", exact=True).click()
    page.mouse.click(*sheet.in_world(*in_the_world(sheet, "robot")[0]))
    refusal = page.get_by_text("a box cannot stand where the robot is")
    expect(refusal).to_be_visible(timeout=PATIENCE_MS)
    expect(refusal).to_be_hidden(timeout=PATIENCE_MS)
    (folder / "broken.svg").write_text("<svg")
    open_from_menu(page, "broken.svg")
    expect(page.get_by_role("alert")).to_contain_text("must be well-formed XML", timeout=PATIENCE_MS)
    expect(page.get_by_test_id("probability")).to_be_visible()
    open_from_menu(page, "home, careful")
    expect(sheet.summary).to_contain_text("9 cells", timeout=PATIENCE_MS)
    sheet.shot("opened-in-a-drive")


def open_from_menu(page: Page, name: str) -> None:
    page.get_by_role("button", name="File").click()
    page.get_by_role("button", name=name).click()


def test_a_drive_is_ordered_paused_and_interfered_with_by_keyboard_alone(sheet: Sheet) -> None:
    page = sheet.page
    tab_to(page.get_by_role("button", name="office, careful"))
    page.keyboard.press("Enter")
    expect(sheet.summary).to_contain_text(re.compile("[1-9] cells"), timeout=PATIENCE_MS)
    tab_to(page.get_by_role("toolbar", name="Tools of the drawing table").get_by_role("button", name="Goal"))
    page.keyboard.press("Enter")
    for key in ("ArrowLeft", "Shift+ArrowLeft", "Enter"):
        page.keyboard.press(key)
    tab_to(page.get_by_role("button", name="Drive", exact=True))
    page.keyboard.press("Enter")
    expect(page.get_by_test_id("go")).to_be_enabled()
    tab_to(page.get_by_label("How wrong the drawing is"))
    page.keyboard.press("Home")
    tab_to(page.get_by_test_id("go"))
    page.keyboard.press("Enter")
    expect(page.get_by_test_id("probability")).to_be_visible(timeout=2 * PATIENCE_MS)
    tab_to(page.get_by_role("button", name="Pause"))
    page.keyboard.press("Enter")

    expect(page.get_by_role("button", name="Go on")).to_be_focused(timeout=PATIENCE_MS)
    page.wait_for_timeout(500)
    before = page.get_by_test_id("timeline").input_value()
    page.wait_for_timeout(1000)
    assert before == page.get_by_test_id("timeline").input_value()
    play_fate_by_keyboard(sheet)


def play_fate_by_keyboard(sheet: Sheet) -> None:
    """Close a door, carry the robot, put things in its way and send it elsewhere."""
    page = sheet.page
    said = page.get_by_test_id("said")
    choose_fate(page, "Door")
    expect(said).to_have_text("open door: here")
    page.keyboard.press("Enter")
    expect(said).to_have_text("a door was closed", timeout=PATIENCE_MS)
    choose_fate(page, "Carry")
    world = page.get_by_test_id("world")
    told = world.get_attribute("data-robot") or ""
    before = in_the_world(sheet, "robot")[0]
    page.keyboard.press("ArrowUp")
    page.keyboard.press("Shift+ArrowLeft")
    expect(said).to_have_text(re.compile(r"robot: .* m right, .* m below"))
    sheet.shot("keyboard")
    page.keyboard.press("Enter")
    expect(said).to_contain_text("carried", timeout=PATIENCE_MS)
    expect(world).not_to_have_attribute("data-robot", told, timeout=PATIENCE_MS)
    after = in_the_world(sheet, "robot")[0]
    assert after[0] < before[0]
    assert after[1] < before[1]
    for fate, way, words in (("Box", "Shift+ArrowRight", "box"), ("Person", "ArrowUp", "walks")):
        choose_fate(page, fate)
        page.keyboard.press(way)
        page.keyboard.press("Enter")
        expect(said).to_contain_text(words, timeout=PATIENCE_MS)
    choose_fate(page, "New goal")
    expect(page.get_by_test_id("believed")).to_be_focused()
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("Enter")
    expect(said).to_contain_text("the goal is now", timeout=PATIENCE_MS)
    expect(page.get_by_role("button", name="New goal")).to_be_focused()


def choose_fate(page: Page, name: str) -> None:
    """Press a button of fate by keyboard, from wherever the keyboard is."""
    page.keyboard.press("Escape")
    tab_to(page.get_by_role("group", name="Play fate").get_by_role("button", name=name, exact=True))
    page.keyboard.press("Enter")


def tab_to(wanted: Locator) -> None:
    """Press Tab until this has the keyboard."""
    for _ in range(120):
        if wanted.evaluate("one => one === document.activeElement"):
            return
        wanted.page.keyboard.press("Tab")
    raise AssertionError(f"Tab does not lead to {wanted}")


def test_a_drawing_and_its_drive_fit_a_phone(browser: Browser, address: str) -> None:
    sheet = on_a_phone(browser, address)
    page = sheet.page
    sheet.shot("phone")
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    page.touchscreen.tap(195, 400)
    expect(page.get_by_test_id("hover")).to_contain_text("opens to", timeout=PATIENCE_MS)
    page.get_by_role("button", name="Drive", exact=True).tap()
    page.get_by_role("combobox", name="Goal").select_option("Ana")
    page.get_by_test_id("go").tap()
    expect(page.get_by_test_id("probability")).to_be_visible(timeout=2 * PATIENCE_MS)
    sheet.shot("phone-drive")

    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    for plan in ("believed", "world"):
        box = page.get_by_test_id(plan).bounding_box()
        assert box is not None
        assert min(box["width"], box["height"]) > 100
    page.get_by_role("button", name="Pause").tap()
    expect(page.get_by_role("button", name="Go on")).to_be_visible(timeout=PATIENCE_MS)
    page.context.close()


def test_the_invitation_is_read_whole_on_a_phone(browser: Browser, address: str) -> None:
    page = browser.new_page(viewport={"width": 390, "height": 760}, has_touch=True)
    page.goto(address)
    title = page.get_by_role("heading", name="Draw a building").bounding_box()
    tools = page.get_by_role("toolbar", name="Tools of the drawing table").bounding_box()
    page.close()

    assert title is not None
    assert tools is not None
    assert tools["y"] + tools["height"] <= title["y"]


def test_nothing_seriously_bars_people_who_see_or_move_differently(page: Page, sheet: Sheet) -> None:
    faults = []
    sheet.draw_flat()
    set_goal(sheet, 800, 240)
    faults += serious(page)
    sheet.drive(speed=20)
    page.get_by_role("button", name="Pause").click()
    page.get_by_role("button", name="Box", exact=True).click()
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
