import contextlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pilotage.errors import FileError
from pilotage.interpretation import Role
from pilotage.io import maps, open_map
from pilotage.io.hints import DrawingHints, read_hints, table_beside
from pilotage.io.raster import Shading

GOOD = """
page = 2
shading = "lines"
[layers]
A-FURN = "ignore"
[labels]
kitchen = [120, 80.5]
WC = [[40, 20], [200, 20]]
"""


@pytest.fixture
def table(tmp_path):
    def write(text):
        path = tmp_path / "plan.dxf.toml"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return write


def test_a_table_is_read(table):
    hints = read_hints(table(GOOD))

    assert {"A-FURN": Role.IGNORE} == hints.layers
    assert (("kitchen", (120.0, 80.5)), ("WC", (40.0, 20.0)), ("WC", (200.0, 20.0))) == hints.labels
    assert ("2", Shading.LINES) == (hints.page, hints.shading)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("layer = 1", "not 'layer'"),
        ("layers = 1", "layers must be a table"),
        ('[layers]\nA = "sofa"', "layer 'A' must be one of wall, door"),
        ("[labels]\nA = [1]", "label 'A' must stand at a point"),
        ("[labels]\nA = [1, nan]", "label 'A' must stand at a point"),
        (f"[labels]\nA = [1, {10**400}]", "label 'A' must stand at a point"),
        ("[labels]\nA = [1, true]", "label 'A' must stand at a point"),
        ("page = 1.5", "page must be a number or a name"),
        ('shading = "dim"', "shading must be one of"),
        ("[", "must be TOML"),
        (b"\xff\xfe", "must be UTF-8"),
    ],
)
def test_a_table_that_will_not_do_is_refused_with_the_rule(table, text, told):
    with pytest.raises(FileError, match=told.replace("[", r"\[")):
        read_hints(table(text))


@given(st.binary(max_size=200))
def test_whatever_a_table_holds_it_is_read_or_refused(tmp_path_factory, content):
    path = tmp_path_factory.mktemp("hints") / "x.toml"
    path.write_bytes(content)
    with contextlib.suppress(FileError):
        assert isinstance(read_hints(path), DrawingHints)


def test_the_command_line_wins_over_the_table(table):
    here = DrawingHints({"A-FURN": Role.WALL}, (("kitchen", (1.0, 2.0)),), "3", Shading.RECOGNIZED)
    both = here.over(read_hints(table(GOOD)))

    assert {"A-FURN": Role.WALL} == both.layers
    assert ("kitchen", (1.0, 2.0)) in both.labels
    assert 3 == len(both.labels)
    assert ("3", Shading.LINES) == (both.page, both.shading)


def test_the_page_in_a_name_does_not_hide_the_table(tmp_path):
    (tmp_path / "plan.pdf").touch()

    assert tmp_path / "plan.pdf.toml" == table_beside(tmp_path / "plan.pdf#2")
    assert tmp_path / "plan.pdf.toml" == table_beside(tmp_path / "plan.pdf")


def test_hints_can_be_given_in_python(tmp_path):
    path = tmp_path / "suite.svg"
    path.write_text(
        '<svg><rect width="100" height="50" stroke="black" fill="none"/><g id="odd">'
        '<path d="M50 0 V50" stroke="black"/></g></svg>'
    )
    sketch = open_map(path, layers={"odd": "ignore"}, labels={"hall": (20, 30)})

    assert 1 == len(sketch.strokes)
    assert [("hall", (20.0, -30.0))] == [(label.text, label.position) for label in sketch.labels]
    with pytest.raises(ValueError, match="must be one of"):
        open_map(path, layers={"odd": "sofa"})


def test_a_drawing_of_too_many_pieces_tells_which_layers_have_most(tmp_path, monkeypatch):
    monkeypatch.setattr(maps, "MOST_PIECES", 5)
    plan = tmp_path / "plan.svg"
    walls = "".join(f'<path d="M{x},0 V80"/>' for x in range(0, 80, 20))
    plan.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 80" fill="none" stroke="black">'
        f'<rect id="shell" width="60" height="80"/><g id="slats">{walls}</g></svg>'
    )

    with pytest.raises(FileError, match=r"found 8; .* \(most are named 'slats' \(8\), 'shell' \(4\)\)"):
        open_map(plan)
