"""A log opens, or one clear line says why it does not."""

import gzip

import numpy as np
import pytest

from pilotage.errors import FileError
from pilotage.io.logs import open_log
from shared_data import LOGS, needs_logs

LINE = "FLASER 3 1.0 2.0 3.0 0 0 0 0 0 0 7.5 host 7.5\n"


@pytest.mark.parametrize("pack", [bytes, gzip.compress])
def test_packed_or_plain_is_told_by_content_and_not_by_name(tmp_path, pack):
    path = tmp_path / "run"
    path.write_bytes(pack(LINE.encode() * 2))

    assert [7.5, 7.5] == [reading.scan.stamp for reading in open_log(path)]


@pytest.mark.parametrize(
    ("content", "rule"),
    [
        (b"", "empty"),
        (b" \n\n", "empty"),
        (b"x,y\n1,2\n", "no laser log"),
        (bytes(range(256)) * 20, "no laser log"),
        (b"ODOM 1 2 3 0 0 0 1.0 host 1.0\n", "no scan"),
        (b"FLASER 3 1.0 2.0\n", "line 1"),
        (gzip.compress(LINE.encode(), mtime=0)[:-12], "damaged"),
    ],
)
def test_a_file_without_scans_is_refused_in_one_line(tmp_path, content, rule):
    path = tmp_path / "run.log"
    path.write_bytes(content)

    with pytest.raises(FileError) as caught:
        open_log(path)

    assert rule in str(caught.value)
    assert str(caught.value).endswith(str(path))
    assert "\n" not in str(caught.value)


def test_a_missing_file_and_a_folder_are_refused(tmp_path):
    for path in (tmp_path / "nowhere.log", tmp_path):
        with pytest.raises(FileError):
            open_log(path)


def test_a_log_complains_about_what_was_left_out(tmp_path):
    path = tmp_path / "run.log"
    path.write_text(LINE + "FLASER 2 1.0\n" + LINE + "ODOM 1\n", encoding="ascii")
    log = open_log(path)

    assert len(log) == 2
    assert log.complaint.startswith("2 broken lines were passed over, the first is line 2:")


def test_a_sound_log_complains_about_nothing(tmp_path):
    path = tmp_path / "run.log"
    path.write_text(LINE, encoding="ascii")

    assert open_log(path).complaint == ""


@needs_logs
@pytest.mark.parametrize(
    ("name", "scans", "beams"), [("aces", 440, 180), ("csail", 406, 361), ("fhw", 488, 180)]
)
def test_real_logs_are_read_whole(name, scans, beams):
    log = open_log(LOGS / f"{name}.log.gz")

    assert scans == len(log)
    assert {beams} == {len(reading.scan) for reading in log}
    assert log.complaint == ""
    ranges = np.concatenate([reading.scan.ranges for reading in log])
    assert ranges[np.isfinite(ranges)].max() < 50.0
