from importlib import import_module

import pytest
from benchmarks.lib import results
from benchmarks.lib.results import Measurement, save
from benchmarks.readme import README, NotMeasuredError, latest_commit, names_in, rewritten

MPEG7 = {"eq2": 0.789, "combination": 0.802}
SIMULATION = {"packed": {"times_real_time": 100.0, "ms_a_step": 0.1}}
TEXT = """before
<!-- measured: mpeg7 -->
old
<!-- end -->
after
<!-- measured: simulation -->
<!-- end -->
"""


def measurement(name, figures, commit="abc", date="2026-01-01"):
    machine = {"cpu": "some", "cores": 2, "python": "3.11"}
    return Measurement(name, f"python -m benchmarks {name}", commit, date, machine, figures)


def test_readme_says_what_the_results_say():
    text = README.read_text()

    assert rewritten(text) == text, "run python -m benchmarks readme"


def test_readme_shows_every_table_that_was_measured_and_no_other():
    measured = [path.stem for path in results.FOLDER.glob("*.json")]
    tables = {name for name in measured if hasattr(import_module(f"benchmarks.{name}"), "render")}

    assert tables == set(names_in(README.read_text()))


def test_a_table_that_was_never_measured_is_refused(tmp_path):
    save(measurement("mpeg7", MPEG7), tmp_path)

    with pytest.raises(NotMeasuredError, match="README shows simulation, which was never measured"):
        rewritten(TEXT, tmp_path)


def test_only_the_text_between_marks_is_replaced(tmp_path):
    save(measurement("mpeg7", MPEG7), tmp_path)
    save(measurement("simulation", SIMULATION), tmp_path)

    new = rewritten(TEXT, tmp_path)

    assert new.startswith("before\n<!-- measured: mpeg7 -->\n| MPEG-7")
    assert "| 78.9 % |" in new
    assert "*`python -m benchmarks mpeg7`, commit abc, 2026-01-01, some, 2 cores, Python 3.11.*\n" in new
    assert "old" not in new
    assert "| packed | 100 |" in new
    assert new == rewritten(new, tmp_path)


def test_a_table_of_other_code_is_marked(tmp_path):
    save(measurement("mpeg7", MPEG7), tmp_path)
    save(measurement("simulation", SIMULATION, "def", "2026-01-02"), tmp_path)

    assert 1 == rewritten(TEXT, tmp_path).count("**Other code than most tables (def).**")


def test_the_latest_commit_is_that_of_most_tables_of_the_last_day():
    found = [
        measurement("a", {}, "old"),
        measurement("b", {}, "new", "2026-01-02"),
        measurement("c", {}, "newer", "2026-01-02"),
        measurement("d", {}, "newer", "2026-01-02"),
    ]

    assert "newer" == latest_commit(found)
    assert "" == latest_commit([])
