"""The table's table says what was measured, and what was not."""

from benchmarks.table import render

FIGURES = {
    "ready_s": 0.4,
    "cells_s": [0.22, 0.3],
    "fps": 10.5,
    "frame_ms": 1.7,
    "load": {"drives": 3, "slowest_s": 0.02, "dropped": 1},
    "browser": None,
    "build_mb": 0.64,
}


def test_the_drives_that_ran_are_counted():
    text = render(FIGURES)

    assert "| 3 drives at once: dropped drives | 1 |" in text
    assert "8 drives" not in text


def test_what_needs_a_browser_is_told_or_said_to_be_missing():
    browser = {"ready_s": 1.6, "cells_s": [0.35, 0.71], "fps": 14.2}
    without, within = render(FIGURES), render({**FIGURES, "browser": browser})

    assert 3 == without.count("| not measured |")
    assert "not measured" not in within
    assert "| 0.35 s, 0.71 s |" in within
    assert "| in the browser: frames a second | 14 |" in within
