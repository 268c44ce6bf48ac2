import numpy as np
import pytest
from benchmarks.kidnap import Attempt, Outcome
from benchmarks.lib import protocols
from benchmarks.lib.data import BUILDINGS, DATA, drawings
from benchmarks.lib.protocols import Followed, Task, follow_all, store, stored
from benchmarks.lib.results import means_of_groups

from benchmarks import calibration, kidnap, localization, mismatch, soak
from pilotage.evaluation.episodes import Trace

needs_data = pytest.mark.skipif(not DATA.is_dir(), reason="the shared data are not here")


def trace(*, right=True, mismatch=False, probability=0.95, n=50):
    return Trace(
        np.arange(float(n)),
        np.full(n, probability),
        np.full(n, right),
        np.full(n, fill_value=True),
        np.full(n, mismatch),
        np.zeros(n),
        np.linspace(1.0, 2.0, n),
    )


def followed(building="csail", hand="quick", drawing="", **how):
    return Followed(Task(building, hand, 2, drawing), (trace(**how), trace(**how)), 0.5)


def test_traces_are_kept_and_read_again(tmp_path):
    one = followed()
    store(tmp_path / one.task.file, one)

    again = stored(tmp_path / one.task.file, one.task)

    assert again.task == one.task
    assert again.traces[1].to_lists() == one.traces[1].to_lists()
    assert stored(tmp_path / "nothing.json", one.task) is None


def test_traces_of_the_same_commit_are_not_made_twice(tmp_path, monkeypatch):
    monkeypatch.setattr(protocols, "STORE", tmp_path)
    monkeypatch.setattr(protocols, "commit_of", lambda _root: "abc")
    one = followed()
    store(tmp_path / "abc" / one.task.file, one)

    found = list(follow_all([one.task], 1, reuse=True))

    assert [one.task] == [each.task for each in found]


def test_the_row_of_a_drawing_holds_all_figures():
    row = localization.summarize(followed())

    assert 1.0 == row["room_end"] == row["room_last10"]
    assert 0.0 == row["metres_to_fix"] == row["confident_wrong"]
    assert row["ms_median"] < row["settled_ms_median"] < row["settled_ms_p95"] < row["ms_p95"] + 0.01
    assert row["lost_ms_median"] is None
    assert 0.5 == row["atlas_s"]
    assert localization.line("csail", "quick", row)


def test_localization_is_rendered():
    rows = {"csail": {"quick": localization.summarize(followed())}}
    figures = {**rows, **means_of_groups(rows, ["csail", "fhw"], ["quick"])}

    assert "| `quick` | 1 | 100 % | - | 100 % | 0 m | 0.0 % | 2, 2 | - |" in localization.render(figures)


def test_calibration_is_told_and_rendered(capsys):
    figures = calibration.calibrated("all", [followed(), followed(right=False)])
    figures["by_hand"] = {"quick": calibration.calibrated("quick", [followed()])}

    assert abs(0.45 - figures["ece"]) < 1e-9
    assert 0.5 == figures["auroc"]
    assert figures["by_hand"]["quick"]["auroc"] is None
    assert "| all | 4 | 0.450 [" in calibration.render(figures)
    assert "0.450" in capsys.readouterr().out


def test_kidnaps_are_summed_up(capsys):
    attempt = Attempt("csail", "draftsman", 0, 10)
    outcomes = [Outcome(attempt, 5.0, 8.0), Outcome(attempt, 7.0, np.inf), Outcome(attempt, 6.0, 10.0)]

    row = kidnap.row_of("all", outcomes)

    assert [6.0, 6.8] == [round(value, 9) for value in row["m_to_doubt"]]
    assert 10.0 == row["m_to_right"]
    assert 1 == row["never_right"]
    assert 0 == row["never_doubted"]
    figures = {**row, "buildings": {"csail/draftsman": row}, "false_alarms": 1, "unkidnapped_m": 950.0}
    assert "| all | 3 | 6.0 m, 6.8 m | 10.0 m | 1 |" in kidnap.render(figures)
    assert None is kidnap.row_of("none", [])["m_to_right"]
    assert "csail" not in capsys.readouterr().out


def test_mismatches_are_summed_up(capsys):
    wrong = [followed(drawing="aces", mismatch=True), followed("fhw", drawing="aces")]

    figures = mismatch.summarize(wrong, [followed(mismatch=False)], ["quick"])

    assert 0.5 == figures["noticed"]
    assert 0.0 == figures["false_alarm"] == figures["false_alarm_scans"]
    assert {"csail on aces/quick": 1.0, "fhw on aces/quick": 0.0} == figures["by_drawing"]
    assert "| `quick` | 4 | 50 % [" in mismatch.render(figures)
    assert "noticed" in capsys.readouterr().out


def test_memory_that_grows_is_a_failure(capsys):
    how = {"max_growth": 10.0, "goals": 3, "collisions": 0, "ms_a_step": 5.0}

    assert "failed" not in soak.figures_of([200.0, 205.0], **how)
    assert "memory grew by 15.0 MB" in soak.figures_of([200.0, 215.0, 210.0], **how)["failed"]
    assert "memory is at 205 MB" in soak.render(soak.figures_of([200.0, 205.0], **how))
    assert soak.resident_mb() > 1.0
    assert "memory grew" in capsys.readouterr().out


@needs_data
def test_all_drawings_are_found():
    assert 18 == len(drawings(list(BUILDINGS), ["draftsman", "quick", "schematic"]))
    assert [("belgioioso", "plan")] == drawings(list(BUILDINGS), ["plan"])
