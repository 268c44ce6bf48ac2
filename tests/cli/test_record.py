"""`pilotage record` writes logs and journals as messages."""

import json

from benchmarks.lib.bag_making import decoded

from pilotage import worlds


def test_a_journal_becomes_messages(pilotage, tmp_path):
    place = {"cell": "a", "x": 100.0, "y": 60.0, "heading": 1.0, "scale": 20.0, "probability": 0.8}
    lines = [{"stamp": k, "status": "located", **place, "hypotheses": [place]} for k in range(3)]
    journal, output = tmp_path / "journal.jsonl", tmp_path / "out.mcap"
    journal.write_text("".join(json.dumps(line) + "\n" for line in lines), encoding="utf-8")
    outcome = pilotage("record", worlds.OFFICE.careful, journal, "-o", output, "--scale", "20")

    assert 0 == outcome.code
    poses = [one.pose.pose.position.x for _, _, one in decoded(output, "/pilotage/pose")]
    assert [5.0, 5.0, 5.0] == poses
    assert "journal.jsonl: the drawing has no place called a; is this its journal?" in outcome.err


def test_what_is_no_journal_or_no_name_for_an_output_is_refused_in_one_line(pilotage, tmp_path):
    bad = tmp_path / "bad.jsonl"
    bad.write_text('{"stamp": 1}\n', encoding="utf-8")
    for words, rule in (
        ((bad, "-o", tmp_path / "out.mcap"), "line 1 must be an estimate"),
        ((bad, "-o", tmp_path / "out.bag"), "must end in .mcap"),
        ((bad, "-o", tmp_path / "out.mcap", "--start", "1,2,0"), "--start is for laser logs"),
    ):
        outcome = pilotage("record", worlds.OFFICE.careful, *words)
        assert 1 == outcome.code
        assert rule in outcome.err
        assert 1 == outcome.err.count("\n")
