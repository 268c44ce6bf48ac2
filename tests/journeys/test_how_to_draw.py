"""The pictures of "How to draw" show what the program really understands."""

import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import pytest

from pilotage.findings import report, worst
from pilotage.io.maps import open_drawing

ROOT = Path(__file__).resolve().parents[2]


def load():
    path = ROOT / "examples" / "make_how_to_draw.py"
    spec = spec_from_file_location("make_how_to_draw", path)
    module = module_from_spec(spec)
    sys.modules[spec.name] = module  # dataclasses look their module up
    spec.loader.exec_module(module)
    return module


EXAMPLES = load().EXAMPLES


def understood(body, folder):
    path = folder / "example.svg"
    path.write_text(f'<svg viewBox="-60 -60 820 300">{body}</svg>')
    drawing = open_drawing(path)
    return report(drawing.sketch, drawing.interpretation)


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda example: example.name)
def test_right_is_understood_and_wrong_is_not(example, tmp_path):
    right, wrong = (understood(body, tmp_path) for body in (example.right, example.wrong))

    assert (3, 2) == (len(right.graph.cells), len(right.graph.gateways))
    assert worst(right.findings) is None
    assert wrong.graph is None or wrong.findings != right.findings or len(wrong.graph.cells) != 3


def test_all_pictures_are_shown_on_the_page():
    page = (ROOT / "docs" / "use" / "how-to-draw.md").read_text()

    for example in EXAMPLES:
        assert f"../images/draw/{example.name}.png" in page
        assert (ROOT / "docs" / "images" / "draw" / f"{example.name}.png").is_file()
