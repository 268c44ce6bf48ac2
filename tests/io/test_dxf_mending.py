"""DXF files that small programs write, which the library alone refuses or garbles."""

import ezdxf
import pytest

from pilotage.errors import FileError
from pilotage.io.dxf import read_dxf

SMALL = """0
SECTION
2
HEADER
9
$ACADVER
1
AC1009
0
ENDSEC
0
SECTION
2
ENTITIES
0
LWPOLYLINE
8
WALLS
90
3
70
1
62
1
10
0
20
0
10
4
20
0
10
4
20
3
0
LINE
8
WALLS
10
0
20
1
11
4
21
1
0
MTEXT
8
ROOMS
10
2
20
1
40
0.3
71
5
1
Küche
0
ENDSEC
0
EOF
"""
"""As small programs write it: no markers of classes, and words in UTF-8 without a code page."""


@pytest.mark.parametrize("version", ["AC1009", "AC1015", "AC1021", ""])
def test_small_programs_need_not_mark_the_classes_of_entities(tmp_path, version):
    path = tmp_path / "plan.dxf"
    content = SMALL.replace("AC1009", version) if version else SMALL.replace("9\n$ACADVER\n1\nAC1009\n", "")
    path.write_bytes(content.encode().replace(b"\n", b"\r\n"))

    sheet = read_dxf(path)

    outline, line = sheet.marks
    assert outline.outlines[0].closed
    assert "WALLS" in outline.names
    assert outline.pen is not None
    assert outline.pen.color == (1, 0, 0)
    assert [[0, 1], [4, 1]] == line.outlines[0].vertices.tolist()
    assert ["Küche"] == [text.text for text in sheet.texts]


@pytest.mark.parametrize(
    ("encoding", "page"), [("utf-8", ""), ("utf-8", "ANSI_1252"), ("cp1252", "ANSI_1252")]
)
def test_words_in_utf_8_are_read_whatever_the_code_page(tmp_path, encoding, page):
    document = ezdxf.new("R2010")
    document.modelspace().add_line((0, 0), (4, 0), dxfattribs={"layer": "0"})
    document.modelspace().add_text("Kueche", dxfattribs={"insert": (1, 1)})
    path = tmp_path / "plan.dxf"
    document.saveas(path)
    said = f"  9\n$DWGCODEPAGE\n  3\n{page}\n" if page else ""
    text = path.read_text().replace("  9\n$DWGCODEPAGE\n  3\nANSI_1252\n", said)
    path.write_bytes(text.replace("AC1024", "AC1015").replace("Kueche", "Küche").encode(encoding))

    assert ["Küche"] == [text.text for text in read_dxf(path).texts]


@pytest.mark.parametrize("handle", ["0", "1", "1F"])
def test_entities_of_the_same_handle_are_all_read(tmp_path, handle):
    path = tmp_path / "plan.dxf"
    content = SMALL
    for kind in ("LWPOLYLINE", "LINE", "MTEXT"):
        content = content.replace(f"\n{kind}\n", f"\n{kind}\n5\n{handle}\n")
    path.write_text(content, encoding="utf-8")

    sheet = read_dxf(path)

    assert [2, 1] == [len(sheet.marks), len(sheet.texts)]


@pytest.mark.parametrize("taken", ["block_records", "layers"])
def test_a_drawing_is_read_though_a_layout_has_the_handle_of_something_else(tmp_path, taken):
    document = ezdxf.new("R2010")
    space = document.modelspace()
    space.add_line((0, 0), (4, 0))
    other = space.layout_key if taken == "block_records" else document.layers.get("0").dxf.handle
    path = tmp_path / "plan.dxf"
    document.saveas(path)
    own = f"\n{space.dxf_layout.dxf.handle}\n"
    path.write_text(
        path.read_text().replace(f"  5{own}", f"  5\n{other}\n").replace(f"350{own}", f"350\n{other}\n")
    )

    (line,) = read_dxf(path).marks

    assert [[0, 0], [4, 0]] == line.outlines[0].vertices.tolist()


@pytest.mark.parametrize("share", [0.3, 0.5, 0.9])
def test_a_file_that_ends_in_the_middle_is_said_to(tmp_path, share):
    path = tmp_path / "plan.dxf"
    path.write_text(SMALL[: int(share * len(SMALL))], encoding="utf-8")

    with pytest.raises(FileError, match="ends in the middle"):
        read_dxf(path)
