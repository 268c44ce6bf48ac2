"""Drawing a building in the browser, and what the page understands of it."""

import re
from pathlib import Path

import pytest
from PIL import Image, ImageDraw
from playwright.sync_api import Route, expect

import pilotage
from web_page import PATIENCE_MS, Sheet, wait_until
from web_table import FLAT, TWO_ROOMS

pytestmark = pytest.mark.slow


@pytest.fixture
def sheet(new_sheet: Sheet) -> Sheet:
    """A new sheet; loading the page takes longer than most of these tests."""
    return new_sheet


def saved(sheet: Sheet, folder: Path) -> Path:
    """Wait until the drawing is saved; return its file."""
    sheet.page.wait_for_timeout(100)  # a change is told to the page's own state first
    expect(sheet.page.get_by_test_id("save-state")).to_have_text("saved", timeout=PATIENCE_MS)
    return folder / sheet.page.get_by_label("Name of the drawing").input_value()


def test_what_is_drawn_is_read_by_pilotage_as_shown_and_opens_again_as_it_was(
    sheet: Sheet, folder: Path
) -> None:
    sheet.draw_flat()
    sheet.page.mouse.move(430, 330)

    expect(sheet.page.get_by_test_id("hover")).to_contain_text("kitchen")
    sheet.shot("draw")
    sketch = pilotage.open_map(saved(sheet, folder))
    assert {"kitchen", "bath"} == {label.text for label in sketch.labels}
    before = saved(sheet, folder).read_text()
    sheet.page.reload()

    expect(sheet.summary).to_contain_text("4 cells, 3 openings", timeout=PATIENCE_MS)
    assert before == saved(sheet, folder).read_text()


def test_a_closed_room_is_pointed_out_and_mended_by_one_click(sheet: Sheet) -> None:
    sheet.focus()
    sheet.box(300, 150, 600, 450)
    sheet.box(600, 150, 900, 450)
    sheet.box(300, 450, 900, 620)
    sheet.doors((600, 300))

    expect(sheet.summary).to_contain_text("finding", timeout=PATIENCE_MS)
    badge = sheet.page.get_by_role("button", name=re.compile("Finding .* door"))
    badge.first.click()
    sheet.shot("finding")
    sheet.page.get_by_role("dialog", name="Finding").get_by_role("button", name=re.compile("door")).click()
    expect(sheet.summary).to_contain_text("2 openings", timeout=PATIENCE_MS)
    expect(badge).to_have_count(0)


def test_a_door_is_moved_and_widened_by_dragging_it(sheet: Sheet) -> None:
    sheet.focus()
    sheet.box(300, 150, 600, 450)
    sheet.box(600, 150, 900, 450)
    sheet.doors((600, 300))
    expect(sheet.summary).to_contain_text("1 opening", timeout=PATIENCE_MS)
    line = sheet.page.locator(".overlay line").first
    first = sorted(float(line.get_attribute(name) or 0) for name in ("y1", "y2"))
    sheet.tool("Door")
    sheet.drag((600, 300), (600, 360))

    middle = sum(first) / 2 + 60
    for _ in range(100):
        ends = sorted(float(line.get_attribute(name) or 0) for name in ("y1", "y2"))
        if sum(ends) / 2 > middle - 5:
            break
        sheet.page.wait_for_timeout(50)
    assert sum(ends) / 2 == pytest.approx(middle, abs=5)


def test_a_tool_of_the_editor_lays_down_the_door_tool(sheet: Sheet) -> None:
    page = sheet.page
    sheet.focus()
    sheet.box(300, 150, 600, 450)
    expect(sheet.summary).to_contain_text("1 cell,", timeout=PATIENCE_MS)
    sheet.tool("Door")
    page.locator("label[title^=Rectangle]").click()
    sheet.drag((600, 150), (900, 450))

    expect(sheet.summary).to_contain_text("2 cells,", timeout=PATIENCE_MS)
    door = page.get_by_role("button", name="Door")
    expect(door).to_have_attribute("aria-pressed", "false")
    sheet.tool("Door")
    page.locator("label[title^=Selection]").click()
    expect(door).to_have_attribute("aria-pressed", "false")


def test_a_door_is_undone_while_the_door_tool_is_held_and_letters_choose_other_tools(sheet: Sheet) -> None:
    page = sheet.page
    sheet.focus()
    sheet.box(300, 150, 600, 450)
    sheet.box(600, 150, 900, 450)
    sheet.tool("Door")
    page.mouse.click(600, 300)
    expect(sheet.summary).to_contain_text("2 cells, 1 opening", timeout=PATIENCE_MS)
    page.keyboard.press("Control+z")

    expect(sheet.summary).to_contain_text("2 cells, 0 openings", timeout=PATIENCE_MS)
    page.keyboard.press("r")
    sheet.drag((300, 450), (600, 600))
    expect(sheet.summary).to_contain_text("3 cells,", timeout=PATIENCE_MS)


def test_who_chooses_a_style_can_draw_at_once(sheet: Sheet, folder: Path) -> None:
    sheet.focus()
    sheet.box(300, 150, 600, 450)
    sheet.page.mouse.click(700, 600)
    expect(sheet.summary).to_contain_text("1 cell,", timeout=PATIENCE_MS)
    sheet.tool("Door")
    sheet.tool("furniture")
    sheet.drag((350, 250), (450, 300))

    assert 'class="furniture"' in saved(sheet, folder).read_text()
    expect(sheet.summary).to_contain_text("1 cell,")


def test_zones_are_drawn_and_shown_as_they_are_understood(sheet: Sheet, folder: Path) -> None:
    page = sheet.page
    sheet.draw_flat()
    sheet.tool("keep-out")
    sheet.drag((620, 180), (720, 230))
    sheet.tool("slow")
    sheet.drag((330, 420), (470, 560))
    sheet.tool("one-way")
    sheet.drag((530, 280), (610, 280))

    for zone in ("keep-out", "slow", "one-way"):
        expect(page.locator(f"[data-zone={zone}]")).to_have_count(1, timeout=PATIENCE_MS)
    expect(sheet.summary).to_contain_text("4 cells, 3 openings")
    sheet.shot("zones")
    zones = pilotage.open_map(saved(sheet, folder)).zones
    assert [1, 1, 1] == [len(lines) for lines in zones.lines]


def test_two_clicks_show_the_route_between_them(sheet: Sheet) -> None:
    sheet.draw_flat()
    sheet.tool("Route")
    sheet.page.mouse.click(700, 250)
    sheet.page.mouse.click(800, 560)

    expect(sheet.page.get_by_test_id("route")).to_be_attached(timeout=PATIENCE_MS)
    sheet.shot("route")


def test_the_start_of_a_drawing_is_that_of_a_world(sheet: Sheet, folder: Path) -> None:
    sheet.focus()
    sheet.box(300, 150, 600, 450)
    sheet.tool("Start")
    sheet.drag((400, 300), (400, 200))

    world = saved(sheet, folder)
    assert 'data-heading="90"' in world.read_text()  # degrees, as docs/worlds.md has them


def test_a_measure_gives_the_sizes_of_rooms(sheet: Sheet, folder: Path) -> None:
    sheet.draw_flat()
    sheet.tool("Measure")
    sheet.drag((300, 640), (900, 640))
    sheet.page.get_by_label("Length in metres").fill("12")
    sheet.page.get_by_role("button", name="This is 12 m").click()
    sheet.page.mouse.move(430, 330)

    expect(sheet.page.get_by_test_id("hover")).to_contain_text("about 24 m2", timeout=PATIENCE_MS)
    for _ in range(PATIENCE_MS // 100):
        if 'data-metres-per-unit="0.02000"' in (text := saved(sheet, folder).read_text()):
            break
    assert 'data-metres-per-unit="0.02000"' in text


def test_a_style_is_for_what_is_selected_or_else_for_the_next_mark(sheet: Sheet, folder: Path) -> None:
    sheet.focus()
    sheet.page.keyboard.press("r")
    sheet.drag((300, 200), (600, 400))
    sheet.page.keyboard.press("1")
    sheet.page.mouse.click(300, 300)
    sheet.tool("furniture")
    expect(sheet.page.get_by_text("the selected mark is now furniture")).to_be_visible(timeout=PATIENCE_MS)
    assert 1 == saved(sheet, folder).read_text().count('class="furniture"')
    sheet.page.keyboard.press("r")
    sheet.tool("ignore")
    assert 1 == saved(sheet, folder).read_text().count('class="furniture"')


def test_a_room_is_drawn_by_keyboard_alone(sheet: Sheet) -> None:
    sheet.page.get_by_role("button", name="Line", exact=True).focus()
    sheet.page.keyboard.press("Enter")
    for key in ("ArrowRight", "ArrowDown", "ArrowLeft", "ArrowUp"):
        for press in ("Enter", *4 * (f"Shift+{key}",), "Enter"):
            sheet.page.keyboard.press(press)

    expect(sheet.summary).to_contain_text("1 cell,", timeout=PATIENCE_MS)


def test_a_cad_plan_is_opened(sheet: Sheet, tmp_path: Path) -> None:
    plan = tmp_path / "plan.dxf"
    plan.write_text(TWO_ROOMS)
    held: list[Route] = []

    def hold(route: Route) -> None:
        held.append(route)

    sheet.page.route("**/api/uploads*", hold, times=1)
    sheet.page.get_by_test_id("file-input").set_input_files(plan)

    expect(sheet.page.get_by_role("alert")).to_contain_text("reading plan.dxf ...", timeout=PATIENCE_MS)
    wait_until(sheet.page, lambda: bool(held))
    held[0].continue_()
    expect(sheet.page.get_by_role("alert")).to_contain_text("taken for walls", timeout=PATIENCE_MS)
    expect(sheet.summary).to_contain_text("2 cells, 1 opening", timeout=PATIENCE_MS)
    sheet.shot("dxf")


def test_the_scale_of_a_file_is_kept_when_it_is_changed_and_saved(
    sheet: Sheet, folder: Path, tmp_path: Path
) -> None:
    plan = tmp_path / "flat.svg"
    plan.write_text(FLAT.replace("<svg", '<svg data-metres-per-unit="0.05"'))
    sheet.page.get_by_test_id("file-input").set_input_files(plan)
    expect(sheet.summary).to_contain_text("4 cells", timeout=PATIENCE_MS)
    sheet.page.mouse.move(500, 300)
    expect(sheet.page.get_by_test_id("hover")).to_contain_text("m2", timeout=PATIENCE_MS)
    sheet.tool("Goal")
    sheet.page.mouse.click(500, 300)

    sketch = pilotage.open_map(saved(sheet, folder))
    assert sketch.metres_per_unit is not None
    left, _, right, _ = sketch.bounds
    assert 180 * 0.05 == pytest.approx((right - left) * sketch.metres_per_unit, rel=0.01)


def test_a_photo_lies_under_what_was_traced_from_it(sheet: Sheet, tmp_path: Path) -> None:
    photo = tmp_path / "photo.jpg"
    picture = Image.new("RGB", (900, 600), "#f4f1ea")
    pen = ImageDraw.Draw(picture)
    pen.rectangle((80, 80, 820, 520), outline="#333333", width=6)
    pen.line((450, 80, 450, 260), fill="#333333", width=6)
    pen.line((450, 350, 450, 520), fill="#333333", width=6)
    picture.save(photo)
    sheet.page.get_by_test_id("file-input").set_input_files(photo)

    expect(sheet.summary).to_contain_text("2 cells, 1 opening", timeout=PATIENCE_MS)
    sheet.shot("photo")


def test_a_hostile_file_is_refused_in_words(sheet: Sheet, tmp_path: Path) -> None:
    hostile = tmp_path / "hostile.svg"
    hostile.write_text(
        '<!DOCTYPE svg [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">]>'
        '<svg xmlns="http://www.w3.org/2000/svg"><script>document.title="taken"</script><text>&b;</text></svg>'
    )
    sheet.page.get_by_test_id("file-input").set_input_files(hostile)

    expect(sheet.page.get_by_role("alert")).to_be_visible(timeout=PATIENCE_MS)
    sheet.shot("hostile")
    assert "taken" not in sheet.page.title()


def test_a_name_that_is_taken_or_leads_elsewhere_is_refused_in_words(sheet: Sheet, folder: Path) -> None:
    sheet.focus()
    sheet.box(300, 150, 600, 450)
    path = saved(sheet, folder)
    (folder / "taken.svg").write_text("<svg/>")
    field = sheet.page.get_by_label("Name of the drawing")
    for name, words in (("taken", "there is a drawing taken.svg already"), ("../out", "cannot be called")):
        field.fill(name)
        field.press("Enter")
        expect(sheet.page.get_by_role("alert")).to_contain_text(words, timeout=PATIENCE_MS)
        expect(field).to_have_value(path.name)

    assert "<svg/>" == (folder / "taken.svg").read_text()
    field.fill("free")
    field.press("Enter")
    expect(field).to_have_value("free.svg", timeout=PATIENCE_MS)


def test_two_tabs_do_not_lose_each_others_work(sheet: Sheet, folder: Path) -> None:
    sheet.focus()
    sheet.box(300, 150, 600, 450)
    name = saved(sheet, folder).name
    other = Sheet(sheet.page.context.new_page())
    other.page.goto(sheet.page.url)
    expect(other.page.get_by_label("Name of the drawing")).to_have_value(name, timeout=PATIENCE_MS)
    sheet.page.bring_to_front()
    sheet.box(600, 150, 900, 450)
    saved(sheet, folder)
    sheet.page.wait_for_timeout(1500)
    other.page.bring_to_front()
    other.focus()
    other.box(400, 500, 700, 600)

    question = other.page.get_by_role("dialog", name="This drawing was changed elsewhere")
    expect(question).to_be_visible(timeout=PATIENCE_MS)
    other.shot("conflict")
    question.get_by_role("button", name="Keep mine as a copy", exact=True).click()
    assert name != saved(other, folder).name


def test_who_asks_for_the_other_version_keeps_the_own_one(sheet: Sheet, folder: Path) -> None:
    sheet.focus()
    sheet.box(300, 150, 600, 450)
    path = saved(sheet, folder)
    path.write_text(path.read_text().replace("</svg>", "<!-- by another program --></svg>"))
    before = set(folder.iterdir())
    sheet.box(600, 150, 900, 450)
    question = sheet.page.get_by_role("dialog", name="This drawing was changed elsewhere")
    question.get_by_role("button", name="show the other version").click(timeout=PATIENCE_MS)

    expect(sheet.summary).to_contain_text("1 cell,", timeout=PATIENCE_MS)
    (mine,) = set(folder.iterdir()) - before
    assert len(pilotage.open_map(mine).strokes) > 1
    assert "by another program" in path.read_text()
