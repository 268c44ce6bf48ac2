"""Files are written whole or not at all."""

import pytest

from pilotage.errors import FileError
from pilotage.io.files import replacing, write_text


def test_a_file_appears_whole_and_nothing_is_left_beside_it(tmp_path):
    write_text(tmp_path / "new" / "out.txt", "äöü\n")

    assert "äöü\n" == (tmp_path / "new" / "out.txt").read_text(encoding="utf-8")
    assert ["out.txt"] == [path.name for path in (tmp_path / "new").iterdir()]


def test_a_failure_leaves_the_old_file_as_it_was(tmp_path):
    target = tmp_path / "out.txt"
    target.write_text("old")

    with pytest.raises(UnicodeEncodeError), replacing(target) as beside:
        beside.write_text("half, then ä", encoding="ascii")

    assert "old" == target.read_text()
    assert ["out.txt"] == [path.name for path in tmp_path.iterdir()]


def test_a_folder_that_is_a_file_is_refused(tmp_path):
    (tmp_path / "file").write_text("")

    with pytest.raises(FileError, match="cannot be written"):
        write_text(tmp_path / "file" / "out.txt", "x")


def test_new_files_have_the_permissions_of_new_files(tmp_path):
    write_text(tmp_path / "ours", "")
    (tmp_path / "plain").write_text("")

    assert (tmp_path / "plain").stat().st_mode == (tmp_path / "ours").stat().st_mode
