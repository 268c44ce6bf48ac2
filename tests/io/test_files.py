"""Files are written whole or not at all."""

import gzip
import os
import stat

import pytest

from pilotage.errors import FileError
from pilotage.io.files import read_bytes, replacing, write_text


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


def interrupt(target, text, *, keeps_partial):
    with replacing(target, keeps_partial=keeps_partial) as beside:
        beside.write_text(text)
        raise KeyboardInterrupt


def test_what_is_interrupted_is_kept_under_a_name_that_says_so(tmp_path):
    for _ in range(2):
        with pytest.raises(KeyboardInterrupt) as caught:
            interrupt(tmp_path / "out.jsonl", "1\n2\n", keeps_partial=True)

    assert {"out.partial.jsonl", "out.partial2.jsonl"} == {path.name for path in tmp_path.iterdir()}
    assert "1\n2\n" == (tmp_path / "out.partial.jsonl").read_text()
    assert caught.value.__notes__ == [f"what was written so far is kept in {tmp_path / 'out.partial2.jsonl'}"]


@pytest.mark.parametrize("text", ["", "half"])
def test_nothing_is_kept_of_an_interruption_unasked_or_of_nothing(tmp_path, text):
    with pytest.raises(KeyboardInterrupt):
        interrupt(tmp_path / "out.png", text, keeps_partial=not text)

    assert [] == list(tmp_path.iterdir())


def test_a_link_stays_and_the_file_it_points_to_is_replaced(tmp_path):
    (tmp_path / "real.txt").write_text("old")
    (tmp_path / "link.txt").symlink_to("real.txt")
    write_text(tmp_path / "link.txt", "new")

    assert (tmp_path / "link.txt").is_symlink()
    assert "new" == (tmp_path / "real.txt").read_text()


def test_a_pipe_is_never_replaced(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)

    with pytest.raises(FileError, match=r"only regular files are replaced.*pipe"):
        write_text(pipe, "lost")

    assert pipe.is_fifo()
    assert [pipe] == list(tmp_path.iterdir())


def test_a_device_is_never_replaced(tmp_path):
    null = tmp_path / "null"
    try:
        os.mknod(null, 0o666 | stat.S_IFCHR, os.makedev(1, 3))
    except PermissionError:
        pytest.skip("devices can be made by root only")
    (tmp_path / "link").symlink_to(null)

    for path in (null, tmp_path / "link"):
        with pytest.raises(FileError, match="only regular files are replaced"):
            write_text(path, "x")

    assert null.is_char_device()
    assert (tmp_path / "link").is_symlink()


def test_what_a_killed_run_left_is_deleted_once_it_is_old_and_no_other_file(tmp_path):
    left = {
        name: tmp_path / name
        for name in (".out.txt.abcd1234.unfinished", ".out.txt.young123.unfinished", ".out.txt.notes")
    }
    for name, path in left.items():
        path.write_text("")
        if "young" not in name:
            os.utime(path, (0, 0))
    write_text(tmp_path / "out.txt", "")

    assert {".out.txt.young123.unfinished", ".out.txt.notes", "out.txt"} == {
        path.name for path in tmp_path.iterdir()
    }


def test_a_file_that_is_being_written_is_not_deleted_however_old_it_is(tmp_path):
    target = tmp_path / "out.txt"
    with replacing(target) as beside:
        beside.write_text("first")
        os.utime(beside, (0, 0))
        write_text(target, "second")

    assert "first" == target.read_text()


def test_names_as_long_as_file_systems_allow_are_written(tmp_path):
    name = "é" * 123 + ".jsonl"
    write_text(tmp_path / name, "x")

    assert [name] == [path.name for path in tmp_path.iterdir()]


@pytest.mark.parametrize(
    ("name", "rule"), [("a\0b", "cannot be opened"), ("nowhere", "no such file"), (".", "cannot be opened")]
)
def test_what_cannot_be_read_is_refused(tmp_path, name, rule):
    with pytest.raises(FileError, match=rule):
        read_bytes(f"{tmp_path}/{name}")


def test_devices_are_not_read():
    with pytest.raises(FileError, match="found a device"):
        read_bytes("/dev/zero")


def test_a_small_file_that_unpacks_to_a_huge_one_is_refused(tmp_path):
    (tmp_path / "bomb.gz").write_bytes(gzip.compress(bytes(2_000_000)))

    with pytest.raises(FileError, match="larger than 1 MB"):
        read_bytes(tmp_path / "bomb.gz", 1_000_000)
