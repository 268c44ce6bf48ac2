"""Words in figures are shown as they are, and do not fail."""

import pytest

from pilotage.figures.style import new_figure, save


@pytest.mark.parametrize("words", ["a\udcff.svg", r"$\nonsense$", "a $ b"])
@pytest.mark.parametrize("suffix", [".png", ".svg", ".pdf"])
def test_a_name_of_any_letters_can_be_a_title(tmp_path, words, suffix):
    figure = new_figure(3.0, 2.0)
    figure.text(0.1, 0.5, words, parse_math=False)
    save(figure, tmp_path / f"figure{suffix}")

    assert (tmp_path / f"figure{suffix}").stat().st_size > 0
