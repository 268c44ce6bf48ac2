"""Mend DXF files of small programs, before the library sees them: it refuses some that CAD programs open."""

import re
from itertools import chain, pairwise

Tag = tuple[bytes, bytes]
"""A group code and its value, each a line of the file."""

MARKERS = {
    b"LWPOLYLINE": b"AcDbPolyline",
    b"MTEXT": b"AcDbMText",
    b"SPLINE": b"AcDbSpline",
    b"HATCH": b"AcDbHatch",
}
"""Entities that need a marker of their class, and the marker."""

VERSION = re.compile(rb"\$ACADVER\s+1\s+AC\d+")
SAID = b"$ACADVER\n1\nAC1015"
HEADER = b"0\nSECTION\n2\nHEADER\n9\n" + SAID + b"\n0\nENDSEC\n"
"""The first version that needs all markers, and a header that says it."""

COMMON = frozenset((b"5", b"6", b"8", b"62", b"370", b"420"))
"""Group codes that all entities have, and that stand before the marker."""

HANDLE = re.compile(
    rb"^([ \t]*0[ \t\r]*\n[ \t]*\d?[A-Z][A-Z0-9_]*[ \t\r]*\n)[ \t]*5[ \t\r]*\n[ \t]*([0-9A-Fa-f]+)[ \t\r]*\n",
    re.MULTILINE,
)
"""The beginning of an entity, and its handle."""

OBJECTS = re.compile(
    rb"^[ \t]*0[ \t\r]*\n[ \t]*SECTION[ \t\r]*\n[ \t]*2[ \t\r]*\n[ \t]*OBJECTS", re.MULTILINE
)
END = b"ENDSEC"
"""The beginning of the section of what is not drawn, and the end of any section."""

LAST_SHORT = 0xFFFF
"""The last letter that `\\U+XXXX` can write."""


def mended(content: bytes) -> bytes:
    """Write words in ASCII, part what has the same handle, and mark the classes of entities."""
    return with_markers(with_own_handles(in_ascii(content)))


def in_ascii(content: bytes) -> bytes:
    r"""Escape the letters of a file in UTF-8, which not all that write it say; others stay as they are.

    >>> in_ascii("Küche".encode()), in_ascii("Küche".encode("cp1252"))
    (b'K\\U+00FCche', b'K\xfcche')
    """
    if content.isascii():
        return content
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content
    beyond = {letter for letter in set(text) if not letter.isascii()}
    escapes = {ord(letter): f"\\U+{ord(letter):04X}" for letter in beyond if ord(letter) <= LAST_SHORT}
    return text.translate(escapes).encode("ascii", "replace")


def with_own_handles(content: bytes) -> bytes:
    """Leave a handle to the first entity that has it: of several, the library would keep but one."""
    seen = {b"0"}

    def once(found: re.Match[bytes]) -> bytes:
        handle = found[2].upper()
        is_taken = handle in seen
        seen.add(handle)
        return found[1] if is_taken else found[0]

    return HANDLE.sub(once, content)


def is_cut_off(content: bytes) -> bool:
    """Tell whether a file ends within a section, as one that was not copied to its end."""
    return content.rfind(END) < content.rfind(b"SECTION")


def without_objects(content: bytes) -> bytes:
    """Cut out what is not drawn: sheets of paper, groups and styles, which a damaged file can do without."""
    found = OBJECTS.search(content)
    end = content.find(END, found.end()) if found is not None else -1
    return (
        content[: found.start()] + content[end + len(END) :].lstrip()
        if found is not None and end > 0
        else content
    )


def with_markers(content: bytes) -> bytes:
    """Mark the classes of entities in a file without any marker."""
    if b"AcDb" in content or not any(kind in content for kind in MARKERS):
        return content
    said, count = VERSION.subn(SAID, content, count=1)
    lines = (said if count else HEADER + content).splitlines()
    tags = list(zip(lines[::2], lines[1::2], strict=False))
    starts = [k for k, (code, _) in enumerate(tags) if code.strip() == b"0"]
    entities = (marked(tags[start:end]) for start, end in pairwise([*starts, len(tags)]))
    return b"\n".join(chain.from_iterable(chain.from_iterable(entities))) + b"\n"


def marked(entity: list[Tag]) -> list[Tag]:
    """Mark the class of one entity, if it needs it."""
    head, *rest = entity
    marker = MARKERS.get(head[1].strip().upper())
    if marker is None:
        return entity
    common = [tag for tag in rest if tag[0].strip() in COMMON]
    own = [tag for tag in rest if tag[0].strip() not in COMMON]
    return [head, (b"100", b"AcDbEntity"), *common, (b"100", marker), *own]
