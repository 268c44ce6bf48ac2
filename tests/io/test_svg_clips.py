"""What a `clipPath` of SVG leaves of shapes."""

import numpy as np
import pytest

from pilotage.errors import FileError
from pilotage.io.svg.sheet import read_svg_sheet

CLIPS = """<defs>
<clipPath id="left"><rect width="50" height="100" fill="none"/></clipPath>
<clipPath id="low" transform="translate(0 60)"><path d="M0 0H100V40H0z" clip-rule="evenodd"/></clipPath>
<clipPath id="two"><rect width="20" height="100"/><rect x="60" width="20" height="100"/></clipPath>
<clipPath id="used"><use href="#box"/></clipPath><rect id="box" width="30" height="100"/>
<clipPath id="own" clipPathUnits="objectBoundingBox"><rect width=".5" height="1"/></clipPath>
<clipPath id="page"><rect width="100" height="100"/></clipPath>
<clipPath id="words"><text>hall</text></clipPath><clipPath id="itself"><use href="#itself"/></clipPath>
</defs><style>.cut { clip-path: url(#left) }</style>"""
LINE = 'fill="none" stroke="#000" d="M10 80H90"'


def marks(tmp_path, body):
    path = tmp_path / "drawing.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{CLIPS}{body}</svg>')
    return read_svg_sheet(path).marks


def spans(found):
    return sorted(
        tuple(np.round(outline.vertices[:, 0], 6)[[0, -1]].tolist())
        for mark in found
        for outline in mark.outlines
    )


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (f'<path {LINE} clip-path="url(#left)"/>', [(10, 50)]),
        (f"<path {LINE} style=\"clip-path:url('#left')\"/>", [(10, 50)]),
        (f'<path {LINE} class="cut"/>', [(10, 50)]),
        (f'<g clip-path="url(#left)"><path {LINE}/></g>', [(10, 50)]),
        (f'<g clip-path="url(#left)"><path {LINE} clip-path="url(#two)"/></g>', [(10, 20)]),
        (f'<path {LINE} clip-path="url(#two)"/>', [(10, 20), (60, 80)]),
        (f'<path {LINE} clip-path="url(#used)"/>', [(10, 30)]),
        (f'<path {LINE} clip-path="url(#low)"/>', [(10, 90)]),
        (f'<path {LINE} transform="translate(20 0)" clip-path="url(#left)"/>', [(30, 70)]),
        (f'<path {LINE} clip-path="url(#own)"/>', [(10, 90)]),  # not read: nothing is left out
        (f'<path {LINE} clip-path="url(#words)"/>', [(10, 90)]),
        (f'<path {LINE} clip-path="url(#itself)"/>', [(10, 90)]),
        (f'<path {LINE} clip-path="url(#nowhere)"/>', [(10, 90)]),
        (f'<path {LINE} clip-path="none"/>', [(10, 90)]),
        (f'<path {LINE} transform="translate(50 0)" clip-path="url(#left)"/>', [(60, 100)]),
        (f'<g clip-path="url(#page)"><path {LINE} transform="translate(50 0)"/></g>', [(60, 140)]),
    ],
)
def test_a_line_is_cut_to_its_clip(tmp_path, body, expected):
    assert spans(marks(tmp_path, body)) == expected


def test_what_lies_outside_its_clip_is_not_there(tmp_path):
    (mark,) = marks(tmp_path, f'<path {LINE}/><rect x="60" width="9" height="9" clip-path="url(#left)"/>')
    assert mark.pen is not None


@pytest.mark.parametrize(("y", "expected"), [(100.3, (0, 50)), (100.6, (0, 0))])
def test_a_line_along_the_border_of_its_clip_is_there_if_any_of_it_is_seen(tmp_path, y, expected):
    (mark,) = marks(tmp_path, f'<path fill="none" stroke="#000" d="M0 50V{y}H50" clip-path="url(#left)"/>')
    assert spans([mark]) == [expected]


def test_the_edge_of_a_cut_area_has_no_line(tmp_path):
    body = '<rect x="20" y="20" width="60" height="60" stroke="#000" fill="#ccc" clip-path="url(#left)"/>'
    area, line = marks(tmp_path, body)
    assert area.pen is None
    assert area.fill is not None
    assert line.fill is None
    assert not line.outlines[0].closed
    assert np.ptp(area.outlines[0].vertices[:, 0]) == pytest.approx(30.0)


def test_clips_within_bounds_only(tmp_path, monkeypatch):
    monkeypatch.setattr("pilotage.io.svg.tree.MAX_ELEMENTS", 100)
    clips = "".join(f'<clipPath id="c{k}"><use href="#box"/></clipPath>' for k in range(60))
    body = "".join(f'<path {LINE} clip-path="url(#c{k})"/>' for k in range(60))
    with pytest.raises(FileError, match="more than 100 elements"):
        marks(tmp_path, f"<defs>{clips}</defs>{body}")
