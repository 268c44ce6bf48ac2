"""The pages of a draw.io file, packed or plain."""

import base64
import binascii
import urllib.parse
import zlib
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree as ET

from pilotage.errors import FileError
from pilotage.io.files import check_regular, read_bytes

LARGEST = 50_000_000
"""The largest file and the largest page that are read, unpacked [bytes]."""

MODEL = "mxGraphModel"


@dataclass(frozen=True, slots=True)
class Diagram:
    """A page: its name, and its model as XML or packed."""

    name: str
    element: ET.Element


def read_diagrams(path: Path) -> list[Diagram]:
    """List the pages of a file.

    Raises FileError if it is missing or damaged, or has no page.
    """
    check_regular(path)
    content = read_bytes(path, LARGEST)
    root = parse(content, path)
    if root.tag == MODEL:
        return [Diagram("", root)]
    pages = [Diagram(page.get("name", ""), page) for page in root.iter("diagram")]
    if not pages:
        raise FileError("a draw.io file needs at least one page, found none", path)
    return pages


def read_model(diagram: Diagram, path: Path) -> ET.Element:
    """Return the model of a page, unpacked.

    Raises FileError if it is damaged or too large.
    """
    if diagram.element.tag == MODEL:
        return diagram.element
    plain = diagram.element.find(MODEL)
    if plain is not None:
        return plain
    model = parse(unpack((diagram.element.text or "").strip(), path), path)
    if model.tag != MODEL:
        raise FileError(f"a page of a draw.io file must hold a drawing, found <{model.tag[:40]}>", path)
    return model


def unpack(text: str, path: Path) -> bytes:
    """Unpack a page: Base64 of deflated text in which letters are escaped as in addresses."""
    try:
        inflater = zlib.decompressobj(-zlib.MAX_WBITS)
        inflated = inflater.decompress(base64.b64decode(text), LARGEST + 1)
    except (binascii.Error, ValueError, zlib.error) as error:
        raise FileError("a page of a draw.io file cannot be unpacked, it is damaged", path) from error
    if len(inflated) > LARGEST:
        raise FileError(f"a page of a draw.io file must have at most {LARGEST // 1_000_000} MB", path)
    return urllib.parse.unquote_to_bytes(inflated)


def parse(content: bytes, path: Path) -> ET.Element:
    """Read XML; entities that grow without bound are refused by the parser."""
    try:
        return ET.fromstring(content)  # noqa: S314  # expat fetches nothing and limits the growth of entities
    except (ET.ParseError, ValueError, LookupError) as error:
        raise FileError(f"a draw.io file cannot be read ({str(error)[:100]})", path) from error
