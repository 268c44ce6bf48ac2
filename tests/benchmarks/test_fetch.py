import hashlib
import urllib.request
from io import BytesIO

import pytest
from benchmarks.fetch import MANIFEST, Item, digest_of, fetched, main, read_manifest, state

from benchmarks import fetch

DIGEST = hashlib.sha256(b"abc").hexdigest()


def item(url="", sha256=DIGEST):
    return Item("logs/a.log", sha256, "somewhere", url)


def write(folder, content=b"abc"):
    (folder / "logs").mkdir()
    (folder / "logs" / "a.log").write_bytes(content)


def test_the_manifest_names_what_benchmarks_read():
    items = read_manifest(MANIFEST)

    assert len(items) == len({one.path for one in items})
    assert {"logs", "people-drawings", "people-sketches", "rooms", "shapes", "sketches"} == {
        one.path.split("/")[0] for one in items
    }
    for one in items:
        assert 64 == len(one.sha256)
        assert one.origin


def test_files_are_checked_by_digest(tmp_path):
    assert "missing; it comes from somewhere" == state(item(), tmp_path)
    write(tmp_path)
    assert "ok" == state(item(), tmp_path)
    assert state(item(sha256="0" * 64), tmp_path).startswith("differs")


def test_the_digest_of_a_folder_tells_contents_and_names(tmp_path):
    write(tmp_path)
    before = digest_of(tmp_path)
    (tmp_path / "logs" / "a.log").rename(tmp_path / "logs" / "b.log")
    renamed = digest_of(tmp_path)
    (tmp_path / "logs" / "b.log").write_bytes(b"abd")

    assert 3 == len({before, renamed, digest_of(tmp_path)})


def test_what_is_fetched_must_have_its_digest(tmp_path, monkeypatch):
    monkeypatch.setattr(urllib.request, "urlopen", lambda _url, **_how: BytesIO(b"abc"))

    assert "no https address" in fetched(item("ftp://a/a.log"), tmp_path)
    assert "other bytes" in fetched(item("https://a/a.log", "0" * 64), tmp_path)
    assert not (tmp_path / "logs" / "a.log").exists()
    assert "fetched" == fetched(item("https://a/a.log"), tmp_path)
    assert "ok" == state(item(), tmp_path)


def test_an_address_that_fails_is_told(tmp_path, monkeypatch):
    def fail(_url, timeout):
        raise OSError(f"no route in {timeout} s")

    monkeypatch.setattr(urllib.request, "urlopen", fail)

    assert "cannot be read (no route" in fetched(item("https://a/a.log"), tmp_path)


def test_missing_data_are_an_error(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(fetch, "DATA", tmp_path)

    with pytest.raises(SystemExit, match="are not as they should be"):
        main(["logs/aces", "--check"])
    assert (
        "logs/aces.log.gz: missing; it comes from https://github.com/acschaefer/ple"
        in capsys.readouterr().out
    )
