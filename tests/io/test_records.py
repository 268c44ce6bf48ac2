import json

import pytest

from pilotage.errors import FileError
from pilotage.io.records import is_records, read_records

LINE = {"stamp": 0, "scale": 20.0, "hypotheses": [{"cell": "c1"}]}


def written(folder, *lines):
    path = folder / "estimates.jsonl"
    path.write_text("".join(line + "\n" for line in lines))
    return path


def test_lines_of_ours_are_read_in_order(tmp_path):
    lines = [LINE, {**LINE, "stamp": 1.5}]
    path = written(tmp_path, *map(json.dumps, lines))

    assert is_records(path)
    assert lines == read_records(path)


@pytest.mark.parametrize(
    ("line", "rule"),
    [
        ("{", "line 2 must be a JSON object"),
        ('{"a": ' + "[" * 100_000, "line 2 must not be nested so deeply"),
        ("[]", "line 2 must be an estimate"),
        (json.dumps({**LINE, "scale": "20"}), "line 2 must be an estimate"),
        (json.dumps({**LINE, "scale": 0.0}), "line 2 must be an estimate"),
        (json.dumps({**LINE, "stamp": None}), "line 2 must be an estimate"),
        (json.dumps({**LINE, "hypotheses": []}), "line 2 must be an estimate"),
        (json.dumps({**LINE, "hypotheses": 3}), "line 2 must be an estimate"),
    ],
)
def test_a_line_of_others_is_refused_with_its_number(tmp_path, line, rule):
    with pytest.raises(FileError, match=rule):
        read_records(written(tmp_path, json.dumps(LINE), line))
