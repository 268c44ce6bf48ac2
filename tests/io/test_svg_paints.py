"""Paints of SVG that are no plain colors: gradients, patterns, variables, and dashes that are none."""

import pytest

from pilotage.io.svg.sheet import read_svg_sheet

SERVERS = """<defs>
<linearGradient id="dusk"><stop stop-color="#000"/><stop offset="1" style="stop-color:#fff"/></linearGradient>
<radialGradient id="again" href="#dusk"/>
<pattern id="wood"><g><rect width="9" height="9" class="ground"/></g>
<path d="M0 0H9" fill="#000"/></pattern>
<pattern id="hatch"><path d="M0 0L9 9" stroke="#102030" fill="none"/></pattern>
<pattern id="boards"><path d="M0 6H12M-1,1 l2-2" stroke="#C0B0A0"/><line y2="6" stroke="#000"/></pattern>
<linearGradient id="glint"><stop stop-color="#fff"/><stop stop-opacity="0"/></linearGradient>
<radialGradient id="lamp"><stop stop-color="#fc2" stop-opacity=".6"/>
<stop offset="1" stop-opacity="0"/></radialGradient>
<pattern id="grid" width="10" height="10" patternUnits="userSpaceOnUse"><path d="M10 0H0V10" fill="none"
stroke="#ddd" stroke-width=".5"/></pattern>
<pattern id="round" href="#round"/><linearGradient id="bare"/>
</defs><style>:root { --pale: #EEDDCC; --floor: var(--pale) } .ground { fill: var(--floor) }</style>"""


def marks(tmp_path, body):
    path = tmp_path / "drawing.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{SERVERS}{body}</svg>')
    return read_svg_sheet(path).marks


def channels(color):
    return tuple(round(255 * channel) for channel in color)


@pytest.mark.parametrize(
    ("paint", "color"),
    [
        ("url(#dusk)", (128, 128, 128)),
        ("url('#again')", (128, 128, 128)),
        ("url(#wood)", (238, 221, 204)),
        ("url(#hatch)", (16, 32, 48)),
        ("url(#boards)", (192, 176, 160)),
        ("url(#nowhere) #0000ff", (0, 0, 255)),
        ("url(#round) #0000ff", (0, 0, 255)),
        ("url(#nowhere)", (0, 0, 0)),
        ("url(#bare)", (0, 0, 0)),
        ("url(#glint)", (0, 0, 0)),
        ("var(--floor)", (238, 221, 204)),
        ("var(--unknown, var(--pale))", (238, 221, 204)),
        ("color-mix(in srgb, var(--pale) 88%, black)", (238, 221, 204)),
    ],
)
def test_one_color_stands_for_a_paint(tmp_path, paint, color):
    for place in (
        f'<rect width="9" height="9" fill="{paint}"/>',
        f'<g fill="{paint}"><path d="M0 0H9V9"/></g>',
    ):
        (mark,) = marks(tmp_path, place)
        assert channels(mark.fill) == color
    (mark,) = marks(tmp_path, f'<path fill="none" stroke="{paint}" d="M0 0H9V9"/>')
    assert channels(mark.pen.color) == color


def test_the_light_of_a_lamp_is_no_fill(tmp_path):
    assert marks(tmp_path, '<circle r="9" fill="url(#lamp)"/>') == ()


def test_squared_paper_is_no_fill(tmp_path):
    assert marks(tmp_path, '<rect width="90" height="90" fill="url(#grid)"/>') == ()
    (mark,) = marks(tmp_path, '<rect width="90" height="90" fill="url(#grid)" stroke="#000"/>')
    assert mark.fill is None


@pytest.mark.parametrize(
    ("dashes", "dashed"), [("3 5", True), ("0", False), ("2000", False), ("60 9", False)]
)
def test_a_dash_as_long_as_its_line_is_none(tmp_path, dashes, dashed):
    (mark,) = marks(tmp_path, f'<path d="M0 0H20" stroke="black" stroke-dasharray="{dashes}"/>')
    assert mark.pen.dashed is dashed


def test_a_line_has_no_area_to_fill_though_it_inherits_a_fill(tmp_path):
    for line in ('<line x2="9"/>', '<path d="M0 0H9"/>'):
        (mark,) = marks(tmp_path, f'<g stroke="#fff" stroke-opacity="0.2">{line}</g>')
        assert mark.fill is None
        assert channels(mark.pen.color) == (255, 255, 255)
        assert marks(tmp_path, line) == ()


@pytest.mark.parametrize(
    ("attributes", "color"),
    [
        ('style="width: 100%; background: rgb(26, 26, 31)"', (26, 26, 31)),
        ('style="background-color: light-dark(#102030, #fff); background: #fff"', (16, 32, 48)),
        ('class="night"', (32, 64, 96)),
        ('style="background: linear-gradient(#111, #222)"', (255, 255, 255)),
        ('style="background: transparent"', (255, 255, 255)),
        ("", (255, 255, 255)),
    ],
)
def test_the_page_has_the_background_that_its_style_tells(tmp_path, attributes, color):
    path = tmp_path / "drawing.svg"
    style = "<style>:root { --ink: #204060 } .night { background: var(--ink) }</style>"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" {attributes}>{style}</svg>')

    assert channels(read_svg_sheet(path).background) == color


def test_faint_paint_is_read_if_there_is_no_other(tmp_path):
    faint = '<rect width="9" height="9" fill-opacity=".25"/>'

    (alone,) = marks(tmp_path, faint)
    (beside,) = marks(tmp_path, faint + '<rect width="9" height="9" fill="#f00"/>')

    assert channels(alone.fill) == (191, 191, 191)
    assert channels(beside.fill) == (255, 0, 0)


def test_a_line_that_is_nearly_transparent_is_none_and_erases_no_wall(tmp_path):
    wall, grid = '<path d="M0 5H9" stroke="#000"/>', '<path d="M0 5H9" stroke="#999" stroke-opacity="{}"/>'

    assert 1 == len(marks(tmp_path, wall + grid.format(0.2)))
    assert 2 == len(marks(tmp_path, wall + grid.format(0.4)))
