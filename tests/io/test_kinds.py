"""Which reader a file is given to."""

import gzip
import io
import zipfile

import pytest

from pilotage.errors import FileError
from pilotage.io.kinds import Kind, recognize
from pilotage.io.sheets import read_sheet, split_page


def archive(name):
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as packed:
        packed.writestr(name, "{}")
    return stream.getvalue()


@pytest.mark.parametrize(
    ("name", "content", "kind"),
    [
        ("a.svg", b"<svg/>", Kind.SVG),
        ("a.xml", b'<?xml version="1.0"?><!-- <osm> --><svg:svg/>', Kind.SVG),
        ("a.svgz", gzip.compress(b"<svg/>", mtime=0), Kind.SVG),
        ("photo.svg", b"\x89PNG\r\n\x1a\n", Kind.PICTURE),
        ("plan.txt", b"%PDF-1.7", Kind.PDF),
        ("plan", b"  0\nSECTION\n", Kind.DXF),
        ("a.xml", b"<mxfile/>", Kind.DRAWIO),
        ("a.json", b'{"type": "excalidraw"}', Kind.EXCALIDRAW),
        ("a.json", b'{"type": "FeatureCollection"}', Kind.GEOJSON),
        ("a.json", b'[{"type": "Feature"}]', Kind.GEOJSON),
        ("a.geojsonl", b'\x1e{"type": "Feature"}\n', Kind.GEOJSON),
        ("a.osm", b"<osm version='0.6'/>", Kind.OSM),
        ("a.zip", archive("venue/unit.geojson"), Kind.IMDF),
        ("map.yaml", b"image: a.png", Kind.MAP_SERVER),
    ],
)
def test_content_tells_the_kind_and_the_name_where_it_does_not(tmp_path, name, content, kind):
    path = tmp_path / name
    path.write_bytes(content)

    assert kind is recognize(path)


@pytest.mark.parametrize(
    ("name", "content", "told"),
    [
        ("a.dwg", b"AC1032", "save it as DXF"),
        ("a.eps", b"%!PS-Adobe", "save it as PDF or SVG"),
        ("a.png", b"%!PS-Adobe", "save it as PDF or SVG"),
        ("a.heic", b"\0\0\0\x18ftypheic", "save it as JPEG"),
        ("a.docx", archive("[Content_Types].xml"), "office document"),
        ("a.zip", archive("b.txt"), "unpack it"),
        ("a.excalidraw.md", b"---\n\nexcalidraw-plugin: parsed\n---\n", "as SVG or .excalidraw"),
        ("a.skp", b"\xff\xfe\xffSketchUp", "floor plan of it as DXF"),
        ("house.step", b"ISO-10303-21;", "floor plan of it as DXF"),
        ("a.gml", b"<core:IndoorFeatures/>", "save it as GeoJSON"),
        (
            "a.json",
            b'{"type": "Topology", "objects": {"a": {"type": "GeometryCollection"}}}',
            "save it as GeoJSON",
        ),
        ("a.json", b'{"elements": [{"type": "node", "id": 1}]}', "download it as XML"),
        ("a.json", b'{"walls": [], "rooms": []}', "export it as SVG, DXF or GeoJSON"),
        ("a.tldr", b'{"tldrawFileFormatVersion": 1}', "export it as SVG or PDF"),
        ("Home.xml", b"<home version='6000'/>", "Plan, Export to SVG format"),
        ("office.world", b"<?xml version='1.0'?><sdf version='1.6'/>", "the map that nav2 saves"),
        ("a.xyz", b"whatever", "readable are SVG, PDF, DXF"),
        ("a.txt", b"", "empty"),
    ],
)
def test_what_cannot_be_read_is_told_with_what_to_do(tmp_path, name, content, told):
    path = tmp_path / name
    path.write_bytes(content)

    with pytest.raises(FileError) as caught:
        recognize(path)
    assert told in str(caught.value)


def test_a_page_may_follow_the_name_unless_a_file_is_called_so(tmp_path):
    odd = tmp_path / "plan#2"
    odd.touch()

    assert (tmp_path / "plan.pdf", "2") == split_page(tmp_path / "plan.pdf#2")
    assert (odd, None) == split_page(odd)
    assert (tmp_path / "plan.pdf#2", "3") == split_page(tmp_path / "plan.pdf#2", "3")


def test_a_file_without_pages_has_no_page_two(tmp_path):
    path = tmp_path / "a.svg"
    path.write_text("<svg/>")

    with pytest.raises(FileError, match="has no pages"):
        read_sheet(path, "2")
