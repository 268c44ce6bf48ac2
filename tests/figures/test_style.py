"""Words in figures are shown as they are, and do not fail."""

import pytest
from matplotlib.text import Text

from pilotage.figures.style import installed_fonts, new_figure, save, show_literally


@pytest.mark.parametrize("words", ["a\udcff.svg", r"$\nonsense$", "a $ b"])
@pytest.mark.parametrize("suffix", [".png", ".svg", ".pdf"])
def test_a_name_of_any_letters_can_be_a_title(tmp_path, words, suffix):
    figure = new_figure(3.0, 2.0)
    figure.text(0.1, 0.5, words, parse_math=False)
    save(figure, tmp_path / f"figure{suffix}")

    assert (tmp_path / f"figure{suffix}").stat().st_size > 0


def test_words_in_other_scripts_may_use_all_fonts_of_the_system():
    latin, chinese = Text(text="hall"), Text(text="\u4f1a\u8b70\u5ba4")
    usual = latin.get_fontfamily()
    show_literally(latin)
    show_literally(chinese)

    assert latin.get_fontfamily() == usual
    assert chinese.get_fontfamily() == installed_fonts()
    assert installed_fonts()[0] == "DejaVu Sans"
