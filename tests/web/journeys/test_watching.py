"""Recordings that are watched in the browser: a laser log, and the journal of a drive."""

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from pilotage.worlds import LOG
from web_page import PATIENCE_MS, Sheet

pytestmark = pytest.mark.slow


def clock(page: Page) -> float:
    """Return the moment that is shown [s]."""
    page.get_by_test_id("timeline").wait_for(timeout=2 * PATIENCE_MS)
    return float(page.get_by_test_id("timeline").input_value())


def wait_for(page: Page, is_right: Callable[[float], bool]) -> None:
    """Wait until a moment [s] is shown of which something holds."""
    for _ in range(4 * PATIENCE_MS // 100):  # a drive is slow on a machine that does other things too
        if is_right(clock(page)):
            return
        page.wait_for_timeout(100)
    raise AssertionError(f"{clock(page)} s is shown")


def test_a_log_is_dropped_on_a_drawing_and_watched_at_any_speed(sheet: Sheet) -> None:
    page = sheet.page
    page.get_by_role("button", name="office, quick").click()
    expect(sheet.summary).to_contain_text(re.compile("[1-9] cells"), timeout=PATIENCE_MS)
    page.get_by_test_id("file-input").set_input_files(LOG)
    expect(page.get_by_test_id("go")).to_have_text("Watch", timeout=PATIENCE_MS)
    page.get_by_role("combobox", name="Speed").select_option("20")
    page.get_by_test_id("go").click()

    expect(page.get_by_test_id("probability")).to_be_visible(timeout=2 * PATIENCE_MS)
    expect(page.get_by_test_id("world")).to_have_count(0)
    expect(page.get_by_role("group", name="Play fate")).to_have_count(0)
    wait_for(page, lambda t: t > 5.0)
    page.get_by_role("button", name="Pause").click()
    sheet.shot("log")
    page.get_by_test_id("timeline").fill("1")
    expect(page.get_by_role("button", name="Now")).to_be_enabled(timeout=PATIENCE_MS)
    wait_for(page, lambda t: t <= 1.0)
    page.get_by_role("button", name="Now").click()
    page.get_by_role("button", name="Go on").click()
    wait_for(page, lambda t: t > 6.0)


def test_the_journal_of_a_drive_is_taken_and_watched_from_any_moment_on(sheet: Sheet, tmp_path: Path) -> None:
    page = sheet.page
    page.get_by_role("button", name="office, careful").click()
    expect(sheet.summary).to_contain_text(re.compile("[1-9] cells"), timeout=PATIENCE_MS)
    journal = tmp_path / "journal.jsonl"
    lines = drive_through_the_office(page, journal)
    page.get_by_role("button", name="Back to the drawing").click()
    page.get_by_test_id("file-input").set_input_files(journal)
    page.get_by_role("combobox", name="Driven in").select_option("packed:office")
    page.get_by_role("combobox", name="Speed").select_option("1")
    page.get_by_test_id("go").click()
    expect(page.get_by_test_id("world")).to_be_visible(timeout=PATIENCE_MS)
    page.get_by_role("button", name="Pause").click()
    late = lines[-20]
    page.get_by_test_id("timeline").fill(str(late["stamp"]))

    expect(sheet.status).to_contain_text(late["place"], timeout=PATIENCE_MS)
    x, y = (float(one) for one in (page.get_by_test_id("world").get_attribute("data-robot") or "").split(","))
    assert [late["truth"]["x"], -late["truth"]["y"]] == pytest.approx([x, y], abs=0.2)
    sheet.shot("journal")
    page.get_by_role("button", name="Go on").click()
    sheet.ended("over")
    page.get_by_test_id("timeline").fill("1")
    expect(sheet.status).to_have_attribute("data-outcome", "", timeout=PATIENCE_MS)
    wait_for(page, lambda t: t < late["stamp"])


def drive_through_the_office(page: Page, path: Path) -> list[dict]:
    """Drive for 12 s of the robot's time, and keep the journal of it."""
    page.get_by_role("button", name="Drive", exact=True).click()
    page.get_by_role("combobox", name="World").select_option("packed:office")
    page.get_by_role("combobox", name="Goal").select_option("Ana")
    page.get_by_role("combobox", name="Speed").select_option("50")
    page.get_by_test_id("go").click()
    wait_for(page, lambda t: t > 12.0)
    page.get_by_role("button", name="Pause").click()
    with page.expect_download(timeout=PATIENCE_MS) as kept:
        page.get_by_role("button", name="Journal", exact=True).click()
    kept.value.save_as(path)
    return [json.loads(line) for line in path.read_text().splitlines()]
