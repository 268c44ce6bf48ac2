"""Drawings made by hand for one question each."""

import functools
import gzip
import math
import os

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from svgelements import Matrix

from pilotage.errors import FileError
from pilotage.interpretation import Role, interpret
from pilotage.io import open_map, open_world
from pilotage.io.svg import read_svg_sheet, tree
from pilotage.maps import Label, SchematicMap


def drawing(tmp_path, body, attributes='viewBox="0 0 100 100"'):
    path = tmp_path / "drawing.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
        'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" '
        f"{attributes}>{body}</svg>"
    )
    return open_map(path)


def in_file(sketch: SchematicMap):
    """Vertices of each stroke in the axes of the file, rounded."""
    return [sketch.file_from_sketch(stroke.vertices).round(6).tolist() for stroke in sketch.strokes]


LINE = '<line x1="1" y1="2" x2="3" y2="5" stroke="black"/>'
STROKE = 'stroke="black" fill="none"'
HIDDEN = (
    '<rect class="room" id="bath" width="30" height="20" fill="transparent"/><circle r="2" cx="9" cy="9"/>'
    '<rect class="room" id="room-hall" x="30" width="30" height="20" fill-opacity=".2"/>'
)
CHART = (
    f'<g id="axes_1">{{}}{LINE}<g id="patch_3"><path {STROKE} d="M 0 9 L 0 0 "/></g>'
    f'<g id="patch_4"><path {STROKE} d="M 1 9 L 1 0 L 5 0"/></g></g>'
)


@pytest.mark.parametrize(
    ("body", "attributes", "labels", "strokes"),
    [
        (LINE, 'aria-label="Our flat"', [], 1),  # what the whole drawing is called
        (f'<g aria-label="Plan">{LINE}{LINE}</g>', "", [], 2),
        (f'<rect width="9" height="9" {STROKE} aria-label="Kitchen"/>', "", ["Kitchen"], 1),
        (
            f'<g {STROKE} aria-label="Bad"><rect width="9" height="9"/><text x="2" y="4">Bath</text></g>',
            "",
            ["Bath"],
            1,
        ),
        (LINE + '<path aria-label="L T" d="M8 1V3H9ZM10 1H12V2Z"/>', "", ["L T"], 1),  # letters as outlines
        (  # as matplotlib writes them
            LINE + '<g id="text_1"><!-- L &amp; T --><g><path d="M8 1V3H9ZM9 1V2ZM10 1H12V2Z"/></g></g>',
            "",
            ["L & T"],
            1,
        ),
        (LINE + '<g id="text_1"><!-- Hall --><!----></g>', "", [], 1),
        (CHART.format('<g id="matplotlib.axis_1"/>'), "", [], 2),  # its frame is no wall
        (CHART.format(""), "", [], 3),
        (LINE + '<g id="desks"><!-- L T --><g><path d="M8 1V3H9ZM10 1H12V2Z"/></g></g>', "", [], 3),
        (f'<rect width="9" height="9" {STROKE}><title>Bath</title></rect>', "", ["Bath"], 1),
        (f'<g {STROKE}><title>Layer 1</title><rect width="9" height="9"/></g>', "", [], 1),
        (
            f'<rect width="9" height="9" {STROKE}><title>A</title></rect><text x="2" y="4">B</text>',
            "",
            ["B"],
            1,
        ),
        (f'<rect class="room" id="living_room" width="9" height="9" {STROKE}/>', "", ["living_room"], 1),
        (f'<g id="rooms"><rect class="room" id="rect304" width="9" height="9" {STROKE}/></g>', "", [], 1),
        (f'<rect id="kitchen" width="9" height="9" {STROKE}/>', "", [], 1),
        (f'<g id="Rooms"><rect id="T302" width="9" height="9" {STROKE}/></g>', "", ["T302"], 1),
        (f'<g id="Rooms"><rect id="path7" width="9" height="9" {STROKE}/></g>', "", [], 1),
        (
            f'<g id="rooms"><rect id="path7" inkscape:label="A 1" {STROKE} width="9" height="9"/></g>',
            "",
            ["A 1"],
            1,
        ),
        (LINE + '<rect class="room" id="office" width="9" height="9" fill-opacity="0"/>', "", ["office"], 1),
        (HIDDEN, "", ["room-hall", "bath"], 2),
        (
            HIDDEN + '<path d="M0 0H60V20H0ZM30 0V20" fill="none" stroke="#000"/>',
            "",
            ["room-hall", "bath"],
            3,
        ),
        (LINE + '<rect width="9" height="9" opacity="0"><title>Bath</title></rect>', "", ["Bath"], 1),
        (LINE + '<rect width="9" height="9" display="none"><title>Bath</title></rect>', "", [], 1),
    ],
)
def test_labels_are_words_or_what_a_shape_is_called(tmp_path, body, attributes, labels, strokes):
    sketch = drawing(tmp_path, body, attributes)
    assert [label.text for label in sketch.labels] == labels
    assert len(sketch.strokes) == strokes


@pytest.mark.parametrize(
    ("body", "vertices", "closed"),
    [
        (LINE, [[1, 2], [3, 5]], False),
        (f'<polyline points="0,0 10,0 10,5" {STROKE}/>', [[0, 0], [10, 0], [10, 5]], False),
        (f'<polygon points="0 0 10 0 10 5" {STROKE}/>', [[0, 0], [10, 0], [10, 5]], True),
        (f'<rect x="1" y="2" width="3" height="4" {STROKE}/>', [[1, 2], [4, 2], [4, 6], [1, 6]], True),
        (f'<path d="M1 1 h4 v3 l-4 0 z" {STROKE}/>', [[1, 1], [5, 1], [5, 4], [1, 4]], True),
        (f'<path d="m1,1 4,0 0,3" {STROKE}/>', [[1, 1], [5, 1], [5, 4]], False),
        (f'<path d="M0 0 L9 0 L9 9 L0 0" {STROKE}/>', [[0, 0], [9, 0], [9, 9]], True),
        (f'<polyline points="0,0 0,0 4,0 4,0" {STROKE}/>', [[0, 0], [4, 0]], False),
        ('<polygon points="0 0 10 0 10 5"/>', [[0, 0], [10, 0], [10, 5]], True),
        ('<polyline points="0 0 10 0 10 5" fill="gray"/>', [[0, 0], [10, 0], [10, 5]], True),
    ],
)
def test_every_shape_gives_its_outline(tmp_path, body, vertices, closed):
    sketch = drawing(tmp_path, body)

    assert [vertices] == in_file(sketch)
    assert closed == sketch.strokes[0].closed


@pytest.mark.parametrize(
    ("written", "metres"),
    [
        ("0.02", 0.02),
        ("1e-3", 0.001),
        ("0", None),
        ("-1", None),
        ("nan", None),
        ("inf", None),
        ("a lot", None),
    ],
)
def test_a_file_may_claim_its_scale_and_nonsense_claims_nothing(tmp_path, written, metres):
    sketch = drawing(tmp_path, LINE, f'viewBox="0 0 100 100" data-metres-per-unit="{written}"')

    assert metres == sketch.metres_per_unit
    assert drawing(tmp_path, LINE).metres_per_unit is None


def test_y_points_up_inside_and_down_in_the_file(tmp_path):
    sketch = drawing(tmp_path, LINE)

    assert [[1.0, -2.0], [3.0, -5.0]] == sketch.strokes[0].vertices.tolist()
    assert [[1.0, 2.0]] == sketch.file_from_sketch(np.array([[1.0, -2.0]])).tolist()
    assert [[1.0, -2.0]] == sketch.sketch_from_file(np.array([[1.0, 2.0]])).tolist()


@pytest.mark.parametrize(
    ("body", "vertices"),
    [
        (f'<g transform="translate(10 20)">{LINE}</g>', [[11, 22], [13, 25]]),
        (f'<g transform="translate(10,0) scale(2)">{LINE}</g>', [[12, 4], [16, 10]]),
        (f'<g transform="scale(2)"><g transform="translate(10 0)">{LINE}</g></g>', [[22, 4], [26, 10]]),
        (f'<g transform="rotate(90)">{LINE}</g>', [[-2, 1], [-5, 3]]),
        (f'<g transform="matrix(0 1 1 0 0 0)">{LINE}</g>', [[2, 1], [5, 3]]),
        (f'<g style="transform: translate(1 1)">{LINE}</g>', [[2, 3], [4, 6]]),
        (f'<a href="x"><switch>{LINE}</switch></a>', [[1, 2], [3, 5]]),
        (f'<svg x="10" y="10" width="50" height="50" viewBox="0 0 5 5">{LINE}</svg>', [[20, 30], [40, 60]]),
        (f'<svg x="10" y="10">{LINE}</svg>', [[11, 12], [13, 15]]),
        (f'<defs><g id="w">{LINE}</g></defs><use href="#w" x="5" y="6"/>', [[6, 8], [8, 11]]),
        (f'<defs><g id="w">{LINE}</g></defs><use xlink:href="#w" transform="scale(3)"/>', [[3, 6], [9, 15]]),
        (
            f'<symbol id="w" viewBox="0 0 9 9">{LINE}</symbol><use href="#w" width="18" height="18" x="1"/>',
            [[3, 4], [7, 10]],
        ),
    ],
)
def test_strokes_are_found_wherever_they_sit_and_however_they_are_moved(tmp_path, body, vertices):
    assert [vertices] == in_file(drawing(tmp_path, body))


@pytest.mark.parametrize(
    "attributes",
    [
        'viewBox="0 0 100 100"',
        'viewBox="0 0 100 100" width="400mm" height="10in"',
        'viewBox="-50 -50 100 100" width="5" height="7" preserveAspectRatio="none"',
        'width="30cm" height="20cm"',
        "",
    ],
)
def test_coordinates_are_the_user_units_of_the_file_whatever_the_page(tmp_path, attributes):
    assert [[[1, 2], [3, 5]]] == in_file(drawing(tmp_path, LINE, attributes))


def test_lengths_in_any_unit_become_user_units(tmp_path):
    body = f'<rect x="1in" y="10%" width="25.4mm" height="5%" {STROKE}/>'

    assert [[[96, 10], [192, 10], [192, 15], [96, 15]]] == in_file(drawing(tmp_path, body))


def test_curves_stay_within_a_small_share_of_the_drawing(tmp_path):
    sketch = drawing(tmp_path, f'<circle cx="50" cy="50" r="20" {STROKE}/>')
    (circle,) = sketch.strokes
    middles = (circle.ring[:-1] + circle.ring[1:]) / 2.0

    assert circle.closed
    assert 0 < 20.0 - np.hypot(*(middles - (50.0, -50.0)).T).min() <= 0.0005 * sketch.diagonal * 1.01
    assert len(circle) < 100


@given(
    control=st.lists(st.tuples(st.integers(0, 100), st.integers(0, 100)), min_size=4, max_size=4, unique=True)
)
@settings(deadline=None, max_examples=40)
def test_a_cubic_curve_is_followed_closely(tmp_path_factory, control):
    tmp_path = tmp_path_factory.mktemp("curve")
    numbers = " ".join(f"{x},{y}" for x, y in control[1:])
    sketch = drawing(tmp_path, f'<path d="M{control[0][0]},{control[0][1]} C{numbers}" {STROKE}/>')
    t = np.linspace(0.0, 1.0, 200)[:, np.newaxis]
    a, b, c, d = (np.array(point, dtype=float) * (1.0, -1.0) for point in control)
    curve = (1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d

    assert max(distance_to(sketch.segments, point) for point in curve) <= 0.0005 * 142.0


def distance_to(segments, point):
    start, end = segments[:, :2], segments[:, 2:]
    along = end - start
    share = np.clip(np.sum((point - start) * along, axis=1) / np.sum(along**2, axis=1), 0.0, 1.0)
    return float(np.hypot(*(start + share[:, np.newaxis] * along - point).T).min())


TRANSFORMS = st.lists(
    st.one_of(
        st.tuples(st.just("translate({} {})"), st.floats(-50, 50), st.floats(-50, 50)),
        st.tuples(st.just("rotate({} {} 7)"), st.floats(-180, 180), st.floats(-9, 9)),
        st.tuples(st.just("scale({} {})"), st.floats(0.1, 4), st.floats(0.1, 4)),
        st.tuples(st.just("skewX({}) skewY({})"), st.floats(-40, 40), st.floats(-40, 40)),
    ),
    min_size=1,
    max_size=4,
)


@given(
    transforms=TRANSFORMS,
    points=st.lists(
        st.tuples(st.integers(-99, 99), st.integers(-99, 99)), min_size=2, max_size=6, unique=True
    ),
)
@settings(deadline=None, max_examples=60)
def test_a_transform_around_a_group_moves_every_point(tmp_path_factory, transforms, points):
    tmp_path = tmp_path_factory.mktemp("moved")
    words = [form.format(*numbers) for form, *numbers in transforms]
    text = " ".join(f"{x},{y}" for x, y in points)
    line = f'<polyline points="{text}" {STROKE}/>'
    nested = "".join(f'<g transform="{word}">' for word in words) + line + "</g>" * len(words)
    matrix = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    for word in words:
        m = Matrix(word)
        matrix = matrix @ np.array([[m.a, m.c, m.e], [m.b, m.d, m.f], [0.0, 0.0, 1.0]])
    expected = (np.column_stack([points, np.ones(len(points))]) @ matrix.T)[:, :2]
    (stroke,) = drawing(tmp_path, nested).strokes

    np.testing.assert_allclose(stroke.vertices, expected * (1.0, -1.0), atol=1e-6)


@pytest.mark.parametrize(
    "hidden",
    [
        '<g display="none">{}</g>',
        '<g style="display:none">{}</g>',
        '<g visibility="hidden">{}</g>',
        '<g opacity="0"><g opacity="1">{}</g></g>',
        "<defs>{}</defs>",
        "<clipPath>{}</clipPath>",
        "<marker>{}</marker>",
        "<symbol>{}</symbol>",
        "<mask>{}</mask>",
        '<g id="ignore">{}</g>',
        '<g class="grid ignored">{}</g>',
        '<g id="furniture"><g>{}</g></g>',
        '<g inkscape:groupmode="layer" inkscape:label="Room labels">{}</g>',
        '<g id="roomLabels">{}</g>',
        '<g class="start">{}</g>',
        "<!-- {} -->",
    ],
)
def test_what_is_hidden_or_says_that_it_is_no_wall_is_none(tmp_path, hidden):
    other = '<line x1="7" y1="7" x2="9" y2="9" stroke="red"/>'

    assert [[[7, 7], [9, 9]]] == in_file(drawing(tmp_path, hidden.format(LINE) + other))


@pytest.mark.parametrize(
    "style",
    [
        'stroke="none"',
        'stroke="black" stroke-width="0"',
        'stroke="black" stroke-opacity="0"',
        'stroke="transparent"',
        'style="stroke: rgba(0,0,0,0)"',
        'class="faint"',
        'fill="black"',
    ],
)
def test_lines_that_cannot_be_seen_are_no_walls(tmp_path, style):
    sheet = "<style>.faint { stroke: none }</style>"
    line = f'<line x1="1" y1="1" x2="5" y2="9" {style}/>'

    assert [[[1, 2], [3, 5]]] == in_file(drawing(tmp_path, sheet + line + LINE))


@pytest.mark.parametrize(
    "sheet",
    [
        "line { stroke: black }",
        "/* walls */ .wall { stroke: black; } .other { stroke: none }",
        "#w { stroke: #333 !important }",
        "g.walls > line { stroke: black } line { stroke: none }",
        "svg .walls line { stroke: url(#gradient) }",
        "* { stroke: black } @media print { line { stroke: none } }",
        "line { stroke: currentColor }",
        "[data-kind] { stroke: black } line { stroke: none }",
        "line[data-kind^=inner] { stroke: black }",
        '.wall[data-kind$="wall"][id*=w] { stroke: black } .wall { stroke: none }',
        "[data-kind~=wall] { stroke: black } [data-kind=wall], [data-kind|=inner], [fill] { stroke: none }",
    ],
)
def test_style_sheets_are_followed(tmp_path, sheet):
    line = '<line id="w" class="wall" data-kind="inner wall" x2="4" y2="4"/>'
    body = f'<style>{sheet}</style><g class="walls">{line}</g>'

    assert [[[0, 0], [4, 4]]] == in_file(drawing(tmp_path, body))


def test_a_sheet_of_paper_behind_the_drawing_is_no_wall(tmp_path):
    page = '<rect width="100%" height="100%" fill="#fdf6e3"/>'
    white = '<path d="M0 0 H50 V50 H0 Z" fill="white"/>'

    assert [[[1, 2], [3, 5]]] == in_file(drawing(tmp_path, page + white + LINE))


@pytest.mark.parametrize("attributes", ['viewBox="0 0 100 100"', 'width="100mm" height="100mm"'])
def test_paper_is_no_wall_even_if_a_stroke_runs_off_it(tmp_path, attributes):
    page = '<rect x="-1" y="-1" width="400" height="400" fill="beige"/>'
    line = '<line x1="-9" y1="2" x2="3" y2="5" stroke="black"/>'

    assert [[[-9, 2], [3, 5]]] == in_file(drawing(tmp_path, page + line, attributes))


def test_a_filled_building_on_a_page_of_unknown_size_is_a_wall(tmp_path):
    building = '<rect x="-500" y="-500" width="900" height="900" fill="gray"/>'

    assert 2 == len(drawing(tmp_path, building + LINE, "").strokes)


@pytest.mark.parametrize(
    "body",
    [
        f'<circle cx="5" cy="5" {STROKE}/>',
        f'<ellipse cx="5" cy="5" rx="3" {STROKE}/>',
        f'<rect x="5" y="5" width="3" {STROKE}/>',
        f'<rect width="-5" height="3" {STROKE}/>',
        f'<path d="M0 0 M5 5" {STROKE}/>',
        f'<path d="M5 5 Z" {STROKE}/>',
        f"<path {STROKE}/>",
        f'<polyline points="" {STROKE}/>',
        f'<g transform="scale(0)"><circle cx="5" cy="5" r="3" {STROKE}/></g>',
        f'<g transform="scale(0)"><path d="M0 0 A 5 3 10 0 1 8 8" {STROKE}/></g>',
        '<use href="#nowhere"/>',
        '<use href="other.svg#w"/>',
    ],
)
def test_what_has_no_size_is_passed_over(tmp_path, body):
    assert [[[1, 2], [3, 5]]] == in_file(drawing(tmp_path, body + LINE))


def test_a_stroked_frame_and_a_filled_building_are_walls(tmp_path):
    frame = f'<rect width="100" height="100" {STROKE}/>'
    building = '<rect x="0" y="0" width="50" height="50" fill="gray"/>'

    assert 2 == len(drawing(tmp_path, frame + LINE).strokes)
    assert 2 == len(drawing(tmp_path, building + LINE).strokes)


def test_texts_name_rooms_at_their_middle(tmp_path):
    body = (
        LINE + '<text x="10" y="20" text-anchor="middle">Kitchen</text>'
        '<g id="labels" transform="translate(5 5)" font-size="10">'
        '<text><tspan x="0" y="30">long</tspan> <tspan>hall</tspan></text></g>'
        '<text class="ignore" x="1" y="1">scale 1:100</text><text> </text>'
    )

    assert (Label("Kitchen", (10.0, -20.0)), Label("long hall", (27.5, -35.0))) == drawing(
        tmp_path, body
    ).labels


def test_flowed_text_of_inkscape_names_rooms_from_the_top_of_its_region_on(tmp_path):
    region = '<flowRegion><rect x="10" y="20" width="80" height="60"/></flowRegion>'
    left = f'<flowRoot font-size="10">{region}<flowPara>Hall</flowPara><flowPara>east</flowPara></flowRoot>'
    middle = f'<flowRoot font-size="10" text-anchor="middle">{region}<flowPara>Hall</flowPara></flowRoot>'
    nowhere = "<flowRoot><flowPara>Hall</flowPara></flowRoot>"
    label = drawing(tmp_path, LINE + middle).labels[0]

    assert ["Hall east"] == [one.text for one in drawing(tmp_path, LINE + left).labels]
    assert ("Hall", (50.0, -25.0)) == (label.text, label.position)
    assert () == drawing(tmp_path, LINE + nowhere).labels
    assert 1 == len(drawing(tmp_path, LINE + left).strokes)


@pytest.mark.parametrize(
    ("ids", "names"),
    [
        (("LAB-BIOMEDIC", "430"), ["LAB-BIOMEDIC", "430"]),
        (("Rectangle 28", "path3719"), []),  # programs call shapes so
        (("hall", "rect7"), []),  # one name alone is that of the drawing
        (("hall", "sofa"), []),
    ],
)
def test_without_words_areas_are_called_by_their_ids(tmp_path, ids, names):
    rooms = "".join(
        f'<rect id="{name}" x="{50 * place}" width="50" height="90" {STROKE}/>'
        for place, name in enumerate(ids)
    )

    sketch = drawing(tmp_path, f'<rect id="plan" width="100" height="90" {STROKE}/>{rooms}')

    assert sorted(names) == sorted(label.text for label in sketch.labels)


def test_html_in_a_drawing_names_rooms_at_the_middle_of_its_box(tmp_path):
    html = '<div xmlns="http://www.w3.org/1999/xhtml"><p>Living</p><p>room</p></div>'
    foreign = f'<foreignObject x="10" y="20" width="80" height="60" font-size="10">{html}</foreignObject>'
    label = drawing(tmp_path, LINE + foreign).labels[0]

    assert ("Living room", (50.0, -50.0)) == (label.text, label.position)


def test_start_and_goal_are_the_centers_of_what_is_so_named(tmp_path):
    body = (
        LINE + '<circle id="start" cx="10" cy="20" r="3"/>'
        '<g class="goal" transform="translate(10 0)"><path d="M0 0 L4 4 M0 4 L4 0" stroke="red"/></g>'
    )
    sketch = drawing(tmp_path, body)

    assert (10.0, -20.0) == sketch.start
    assert (12.0, -2.0) == sketch.goal
    assert 1 == len(sketch.strokes)


def test_a_word_can_mark_the_start(tmp_path):
    sketch = drawing(tmp_path, LINE + '<text id="start" x="10" y="20" text-anchor="middle">S</text>')

    assert (10.0, -20.0) == sketch.start
    assert () == sketch.labels


@pytest.mark.parametrize(
    ("content", "rule"),
    [
        ("", "empty|well-formed"),
        ("hello", "well-formed"),
        ("<svg><g></svg>", "well-formed"),
        ("<html></html>", "a web page cannot be read"),
        ("<svg/>", "at least one visible stroke"),
        ('<svg><line x1="1" y1="1" x2="1" y2="1" stroke="black"/></svg>', "at least one visible stroke"),
        ('<svg><text x="1" y="1">hall</text></svg>', "at least one visible stroke"),
        ('<svg><image href="plan.png" width="9" height="9"/></svg>', "at least one visible stroke"),
        ('<svg><rect width="nine" height="9" stroke="black"/></svg>', "cannot be read"),
        ('<svg><path d="M 0 0 L 5" stroke="black"/></svg>', "cannot be read"),
        ('<svg><path d="M0 0 L 1e999 5" stroke="black"/></svg>', "cannot be read"),
        ('<svg><g transform="rotate(x)"><path d="M0 0L5 5" stroke="black"/></g></svg>', "cannot be read"),
        ('<svg viewBox="0 0 9 x"><path d="M0 0L5 5" stroke="black"/></svg>', "cannot be read"),
        ('<svg><g id="a"><use href="#a"/></g></svg>', "at least one visible stroke"),
    ],
)
def test_a_file_that_is_no_drawing_is_refused_in_one_line(tmp_path, content, rule):
    path = tmp_path / "broken.svg"
    path.write_text(content)

    with pytest.raises(FileError, match=rule) as caught:
        open_map(path)

    assert str(caught.value).endswith(str(path))
    assert "\n" not in str(caught.value)


def test_a_missing_file_and_a_folder_are_refused(tmp_path):
    with pytest.raises(FileError, match="no such file"):
        open_map(tmp_path / "nowhere.svg")
    with pytest.raises(FileError, match="found a folder"):
        open_map(tmp_path)


def test_a_packed_drawing_is_read_as_well(tmp_path):
    path = tmp_path / "drawing.svgz"
    path.write_bytes(gzip.compress(f"<svg>{LINE}</svg>".encode()))

    assert 1 == len(open_map(str(path)).strokes)


def test_groups_nested_deeper_than_the_stack_are_read(tmp_path):
    depth = 3000

    assert 1 == len(drawing(tmp_path, "<g>" * depth + LINE + "</g>" * depth).strokes)


def test_a_rotated_label_keeps_to_its_line(tmp_path):
    body = LINE + '<text transform="rotate(-90)" x="-10" y="4" font-size="2">ab</text>'
    (label,) = drawing(tmp_path, body).labels

    assert math.isclose(4.0, label.position[0])
    assert math.isclose(-9.0, label.position[1])


BAD_SHAPES = (
    '<path d="M0 0 h" stroke="red"/>',
    '<path d="M0 0 C 1 1" stroke="red"/>',
    '<path d="M0 0 A 1e308 1 0 0 1 5 5" stroke="red"/>',
    '<path d="M0 0 Q 1e308 1e308 1 1" stroke="red"/>',
    '<rect x="-1e308" width="1e308" height="1e308"/><rect width="9" height="9"/>',
    '<line x2="1e308" y2="5" stroke="red"/>',
)
BAD_MARKINGS = (  # worlds have no labels and no goals
    '<rect width="9" height="9" stroke="red"/><text x="1e308" y="0">far</text>',
    '<circle class="goal" r="1" transform="scale(1e99)"/><path d="M0 0h9v9" stroke="red"/>',
)


@pytest.mark.parametrize(
    ("read", "body"),
    [(read, body) for read in (open_map, open_world) for body in BAD_SHAPES]
    + [(open_map, body) for body in BAD_MARKINGS],
)
def test_values_that_are_cut_short_or_too_large_are_refused_with_the_path(tmp_path, read, body):
    path = tmp_path / "drawing.svg"
    path.write_text(f"<svg>{body}</svg>")

    with pytest.raises(FileError, match="holds a value that cannot be read") as caught:
        read(path)

    assert str(path) in str(caught.value)


@pytest.mark.parametrize("name", ["pipe.svg", "pipe.png", "pipe.yaml", "map.yaml"])
def test_a_pipe_is_refused_and_not_waited_for(tmp_path, name):
    os.mkfifo(tmp_path / name.replace("map.yaml", "pipe.png"))
    if name == "map.yaml":
        (tmp_path / name).write_text("image: pipe.png\nresolution: 0.1\norigin: [0, 0, 0]\n")

    with pytest.raises(FileError, match="a regular file is expected"):
        open_map(tmp_path / name)


def test_a_few_elements_that_repeat_each_other_without_end_are_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(tree, "MAX_ELEMENTS", 1000)
    layers = "".join(f'<g id="g{k}">' + f'<use href="#g{k - 1}"/>' * 10 + "</g>" for k in range(1, 8))
    path = tmp_path / "bomb.svg"
    path.write_text(f'<svg><defs><g id="g0"/>{layers}</defs><use href="#g7"/></svg>')

    with pytest.raises(FileError, match="more than 1000 elements"):
        open_map(path)


def test_a_symbol_hands_its_style_down_and_is_shown_where_it_is_used(tmp_path):
    symbol = '<symbol id="w" display="none" fill="none" stroke="red"><rect width="9" height="9"/></symbol>'
    path = tmp_path / "plan.svg"
    path.write_text(f'<svg viewBox="0 0 99 99">{symbol}<use href="#w"/></svg>')
    (mark,) = read_svg_sheet(path).marks
    assert mark.fill is None
    assert mark.pen is not None
    assert mark.pen.color == (1, 0, 0)


def test_of_two_elements_with_one_id_the_first_is_used(tmp_path):
    twins = '<defs><path id="w" d="M0 0H9"/><path id="w" d="M0 0V5"/></defs>'
    path = tmp_path / "plan.svg"
    path.write_text(f'<svg viewBox="0 0 99 99">{twins}<use href="#w" stroke="black"/></svg>')
    (mark,) = read_svg_sheet(path).marks
    assert mark.outlines[0].vertices.tolist() == [[0, 0], [9, 0]]


@pytest.mark.parametrize(
    ("inner", "area"), [("M1 1H9V9H1Z", 100.0), ("M1 1V9H9V1Z", 36.0), ("M8 0H12V10H8Z", 120.0)]
)
@pytest.mark.parametrize(("rule", "share"), [("", 1.0), ('fill-rule="evenodd"', 0.0)])
def test_paths_are_filled_by_the_rule_that_they_name(tmp_path, inner, area, rule, share):
    path = tmp_path / "plan.svg"
    path.write_text(f'<svg viewBox="0 0 99 99"><path d="M0 0H10V10H0Z{inner}" {rule}/></svg>')
    twice = {"M1 1H9V9H1Z": 64.0, "M1 1V9H9V1Z": 0.0, "M8 0H12V10H8Z": 20.0}[inner]

    found = interpret(read_svg_sheet(path)).sketch
    rings = [shapely.Polygon(stroke.vertices) for stroke in found.strokes]
    filled = functools.reduce(shapely.symmetric_difference, rings)

    assert shapely.area(filled) == pytest.approx(area - (1.0 - share) * twice)


@pytest.mark.parametrize(
    ("body", "roles"),
    [
        ('<rect id="toilet" class="room" {0}/>', (Role.WALL,)),
        ('<rect class="hp-room" id="cabinet" {0}/>', (Role.WALL,)),
        ('<g id="rooms"><rect id="shower" {0}/></g>', (Role.WALL,)),
        ('<rect id="bedRoom2" {0}/>', (Role.WALL,)),
        ('<g id="bath-room"><rect id="toilet" {0}/></g>', (Role.FURNITURE,)),
        ('<g class="room"><rect {0}/><g id="bed"><rect {1}/></g></g>', (Role.WALL, Role.FURNITURE)),
        ('<rect id="table" class="room" {0}/>', (Role.FURNITURE,)),
        ('<rect id="bed-kids-room" {0}/>', (Role.FURNITURE,)),
    ],
)
def test_rooms_are_called_by_things_and_things_by_rooms(tmp_path, body, roles):
    boxes = [f'x="{x}" y="20" width="30" height="30" fill="none" stroke="#000"' for x in (20, 25)]
    house = '<path d="M0 0H100V100H0Z" fill="none" stroke="#000"/>'
    drawing(tmp_path, house + body.format(*boxes))

    meanings = interpret(read_svg_sheet(tmp_path / "drawing.svg")).meanings

    assert roles == tuple(meaning.role for meaning in meanings[1:])
