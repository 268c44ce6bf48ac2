from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from pilotage.web.folder import ChangedError, Folder, NameRefusedError, tag_of


@pytest.mark.parametrize(
    "name",
    [
        "../secret.svg",
        "a/../../secret.svg",
        "/etc/x.svg",
        "..\\secret.svg",
        ".hidden.svg",
        "a/.b/c.svg",
        "a.txt",
    ],
)
def test_a_name_that_leads_elsewhere_or_is_no_drawing_is_refused(folder: Path, name: str) -> None:
    with pytest.raises(NameRefusedError):
        Folder(folder).read(name)


def test_a_link_out_of_the_folder_is_neither_listed_nor_read_nor_written(folder: Path) -> None:
    (folder / "link.svg").symlink_to(folder.parent / "secret.svg")
    (folder / "out").symlink_to(folder.parent)

    assert [] == Folder(folder).names()
    for name in ("link.svg", "out/secret.svg", "out/new.svg"):
        with pytest.raises(NameRefusedError):
            Folder(folder).write(name, b"<svg/>", None)
    assert "<svg>secret</svg>" == (folder.parent / "secret.svg").read_text()


def test_a_table_beside_a_drawing_is_read_if_it_is_in_the_folder(folder: Path) -> None:
    (folder / "flat.svg.toml").write_bytes(b"page = 1")
    (folder / "link.svg.toml").symlink_to(folder.parent / "secret.svg")

    assert [b"page = 1", b"", b""] == [Folder(folder).hints(f"{one}.svg") for one in ("flat", "link", "none")]


@given(st.text(max_size=40))
@settings(max_examples=50, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_no_name_leads_out_of_the_folder(folder: Path, name: str) -> None:
    try:
        found = Folder(folder).path(name + ".svg")
    except NameRefusedError:
        return

    assert found.is_relative_to(folder.resolve())


def test_a_drawing_is_replaced_only_by_who_knows_its_version(folder: Path) -> None:
    drawings = Folder(folder)
    first = drawings.write("rooms/flat.svg", b"one", None)

    with pytest.raises(ChangedError):
        drawings.write("rooms/flat.svg", b"two", None)
    with pytest.raises(ChangedError) as refused:
        drawings.write("rooms/flat.svg", b"two", tag_of(b"zero"))
    assert first == refused.value.tag
    assert tag_of(b"two") == drawings.write("rooms/flat.svg", b"two", first)
    assert (b"two", tag_of(b"two")) == drawings.read("rooms/flat.svg")
    assert ["rooms/flat.svg"] == drawings.names()


def test_a_free_name_is_free(folder: Path) -> None:
    (folder / "plan.svg").touch()

    assert "plan-2.svg" == Folder(folder).free_name("plan")
    assert "drawing.svg" == Folder(folder).free_name("../..")
