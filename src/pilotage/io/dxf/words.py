"""Words of a DXF file: TEXT, ATTRIB and MTEXT, one Text a line."""

import math
from collections.abc import Iterator

from ezdxf.entities import MText
from ezdxf.entities import Text as DxfText
from ezdxf.math import OCS, Vec3

from pilotage.interpretation.sheet import Text

LETTER_WIDTH = 0.8
"""Mean width of a letter, as a share of the height of a capital."""

LINE_STEP = 1.66
"""Distance of two base lines in heights of a capital, as CAD programs set them."""


def read_words(
    entity: DxfText | MText, names: tuple[str, ...], groups: tuple[int, ...], source: str
) -> Iterator[Text]:
    """Read the words of an entity, line by line."""
    if isinstance(entity, MText):
        yield from read_mtext(entity, names, groups, source)
    else:
        yield read_text(entity, names, groups, source)


def read_text(entity: DxfText, names: tuple[str, ...], groups: tuple[int, ...], source: str) -> Text:
    """Read words on one line; attributes of blocks are of this kind, too."""
    words = entity.plain_text()
    height = float(entity.dxf.get("height", 0.0))
    width = LETTER_WIDTH * height * float(entity.dxf.get("width", 1.0)) * len(words)
    horizontal, vertical = int(entity.dxf.get("halign", 0)), int(entity.dxf.get("valign", 0))
    first, second = Vec3(entity.dxf.get("insert", Vec3())), entity.dxf.get("align_point")
    turn = math.radians(float(entity.dxf.get("rotation", 0.0)))
    if second is not None and horizontal in (3, 5):  # fitted between two points
        anchor = first.lerp(Vec3(second))
        across = 0.0
        turn = (Vec3(second) - first).angle
    else:
        aligned = second is not None and (horizontal, vertical) != (0, 0)
        anchor = Vec3(second) if aligned else first
        across = {0: 0.5, 2: -0.5}.get(horizontal, 0.0) * width
    up = 0.0 if horizontal == 4 else {3: -0.5, 2: 0.0}.get(vertical, 0.5) * height
    along, upright = Vec3.from_angle(turn), Vec3.from_angle(turn + math.pi / 2)
    middle = anchor + along * across + upright * up
    middle, along = in_world(entity.ocs(), middle), in_world(entity.ocs(), along)
    return Text(words, (middle.x, middle.y), height, along.angle, names, groups, source)


def read_mtext(entity: MText, names: tuple[str, ...], groups: tuple[int, ...], source: str) -> Iterator[Text]:
    """Read a paragraph, line by line."""
    lines = entity.plain_text(split=True)
    height = float(entity.dxf.get("char_height", 0.0))
    step = LINE_STEP * height * float(entity.dxf.get("line_spacing_factor", 1.0))
    attachment = int(entity.dxf.get("attachment_point", 1)) - 1  # row by row from the upper left
    row, column = divmod(min(max(attachment, 0), 8), 3)
    turn = math.radians(entity.get_rotation())
    along, down = Vec3.from_angle(turn), Vec3.from_angle(turn - math.pi / 2)
    frame = float(entity.dxf.get("width", 0.0)) or math.inf
    first = height / 2 - row / 2 * (height + step * (len(lines) - 1))
    anchor = Vec3(entity.dxf.get("insert", Vec3()))
    for k, line in enumerate(lines):
        across = (0.5 - 0.5 * column) * min(LETTER_WIDTH * height * len(line), frame)
        middle = anchor + along * across + down * (first + k * step)
        yield Text(line, (middle.x, middle.y), height, turn, names, groups, source)


def in_world(ocs: OCS, point: Vec3) -> Vec3:
    """Carry a point from the coordinates of a mirrored or tilted object to those of the drawing."""
    return Vec3(ocs.to_wcs(point)) if ocs.transform else point
