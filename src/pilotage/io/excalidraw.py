"""Read drawings of Excalidraw (https://excalidraw.com) in the coordinates of their scene."""

import math
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from pilotage.errors import FileError
from pilotage.geometry import Array
from pilotage.interpretation.names import thing_called
from pilotage.interpretation.sheet import WHITE, Pen, Sheet, Text
from pilotage.io.colors import read_color
from pilotage.io.curves import arc, bezier
from pilotage.io.json_files import Json, items, number, objects, points, read_json, words
from pilotage.io.sheet_builder import SheetBuilder, outline_through

LARGEST_RADIUS, RADIUS_SHARE = 32.0, 0.25
"""Radius of a rounded corner, as a share of the shorter side; at most the first where it adapts."""

LOOP = 8.0
"""A line whose ends are closer than this is a loop that can be filled."""

PEN_SHARE = 4.25
"""Width of a freehand line in stroke widths: Excalidraw draws it thicker than other lines."""

CAPITAL = 0.7
"""Height of a capital, as a share of the size of a font."""

PICTURES = {
    "image": "embedded pictures",
    "embeddable": "embedded web pages",
    "iframe": "embedded web pages",
}


def read_excalidraw(path: Path) -> Sheet:
    """Read an `.excalidraw` file.

    Raises FileError if it is missing or damaged, or shows no line.
    """
    scene = read_json(path, "an Excalidraw drawing")
    if not isinstance(scene.get("elements"), list):
        raise FileError("an Excalidraw drawing must have a list of elements", path)
    elements = [element for element in objects(scene["elements"]) if element.get("isDeleted") is not True]
    builder = SheetBuilder(path, y_down=True)
    frames = {words(element.get("id")): words(element.get("name")) for element in elements}
    groups: dict[str, int] = {}
    labels = {words(element.get("containerId")): words(element.get("text")) for element in elements}
    for element in elements:
        holder = words(element.get("containerId")) or words(element.get("id"))
        with builder.surviving("damaged elements"):
            read_element(element, builder, frames, groups, thing_called(labels.get(holder, "")))
    state = scene.get("appState")
    ground = words(state.get("viewBackgroundColor")) if isinstance(state, dict) else ""
    return builder.build(background=read_color(ground) or WHITE)


def read_element(
    element: Json, builder: SheetBuilder, frames: dict[str, str], groups: dict[str, int], called: str
) -> None:
    """Add one element to a sheet; `called` is its label if that says what it is."""
    kind = words(element.get("type"))
    if kind in PICTURES:
        builder.leave_out(PICTURES[kind])
        return
    opacity = number(element.get("opacity"), 100.0) / 100.0
    ids = [words(group) for group in reversed(items(element.get("groupIds")))]
    numbers = tuple(
        groups[name] if name in groups else groups.setdefault(name, builder.new_group()) for name in ids
    )
    told = element.get("customData")
    role = words(told.get("role")) if isinstance(told, dict) else ""  # as the drawing table writes it
    role = "ignore" if role == "measure" else role
    has_head = kind == "arrow" and any(
        element.get(end, usual) for end, usual in (("startArrowhead", None), ("endArrowhead", "arrow"))
    )
    names = (frames.get(words(element.get("frameId")), ""), "arrow" if has_head else "", called, role)
    source = f"{kind} {words(element.get('id'))}".strip()
    if kind == "text":
        if opacity > 0.0:
            for text in read_texts(element, names, numbers, source):
                builder.add_text(text)
        return
    if kind not in OUTLINES:
        return
    outline, closed = OUTLINES[kind](element)
    line = read_color(words(element.get("strokeColor")), opacity)
    width = number(element.get("strokeWidth"), 1.0) * (PEN_SHARE if kind == "freedraw" else 1.0)
    fill = read_color(words(element.get("backgroundColor")), opacity)
    is_loop = fill is not None and bool(np.hypot(*(outline[-1] - outline[0])) <= LOOP)
    polyline = outline_through(turned(outline, element), closed=closed or is_loop)
    builder.add_mark(
        [polyline],
        pen=None
        if line is None
        else Pen(line, width, words(element.get("strokeStyle")) in ("dashed", "dotted")),
        fill=fill if polyline is not None and polyline.closed else None,
        names=names,
        groups=numbers,
        source=source,
    )


def turned(outline: Array, element: Json) -> Array:
    """Carry an outline (n, 2) from its element's corner to the page, turned about its middle, y up."""
    corner = np.array([number(element.get("x")), number(element.get("y"))])
    middle = (outline.min(axis=0) + outline.max(axis=0)) / 2.0
    placed = corner + middle + rotated(outline - middle, number(element.get("angle")))
    return np.asarray(placed * (1.0, -1.0))


def rotated(offsets: Array, angle: float) -> Array:
    """Turn offsets (n, 2), clockwise on the page, where y points down."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.asarray(offsets @ np.array([[cosine, sine], [-sine, cosine]]))


def rectangle(element: Json) -> tuple[Array, bool]:
    """Outline a rectangle, its corners rounded if they are."""
    width, height = number(element.get("width")), number(element.get("height"))
    roundness = element.get("roundness")
    if not isinstance(roundness, dict):
        return np.array([[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]]), True
    shorter = min(abs(width), abs(height))
    adapts = number(roundness.get("type")) == 3
    wanted = number(roundness.get("value"), LARGEST_RADIUS)
    radius = min(RADIUS_SHARE * shorter, wanted) if adapts else RADIUS_SHARE * shorter
    corners = [
        (width, 0.0, -1, 1, -90),
        (width, height, -1, -1, 0),
        (0.0, height, 1, -1, 90),
        (0.0, 0.0, 1, 1, 180),
    ]
    arcs = [
        arc((x + across * radius, y + down * radius), (radius, radius), math.radians(start), math.pi / 2)
        for x, y, across, down, start in corners
    ]
    return np.vstack(arcs), True


def diamond(element: Json) -> tuple[Array, bool]:
    """Outline a diamond."""
    width, height = number(element.get("width")), number(element.get("height"))
    return np.array([[width / 2, 0.0], [width, height / 2], [width / 2, height], [0.0, height / 2]]), True


def ellipse(element: Json) -> tuple[Array, bool]:
    """Outline an ellipse."""
    width, height = number(element.get("width")), number(element.get("height"))
    return arc((width / 2, height / 2), (width / 2, height / 2), 0.0, 2.0 * math.pi), True


def line(element: Json) -> tuple[Array, bool]:
    """Outline a line or an arrow, a smooth curve through its points if it is round."""
    vertices = np.array(points(element.get("points")), dtype=np.float64).reshape(-1, 2)
    smooth = isinstance(element.get("roundness"), dict) and len(vertices) > 2
    return (through(vertices) if smooth else vertices), element.get("polygon") is True


def freehand(element: Json) -> tuple[Array, bool]:
    """Outline a freehand line."""
    return np.array(points(element.get("points")), dtype=np.float64).reshape(-1, 2), False


OUTLINES: dict[str, Callable[[Json], tuple[Array, bool]]] = {
    "rectangle": rectangle,
    "diamond": diamond,
    "ellipse": ellipse,
    "line": line,
    "arrow": line,
    "freedraw": freehand,
}


def through(vertices: Array) -> Array:
    """Return a Catmull-Rom spline through points (n, 2), cut into chords."""
    padded = np.vstack([vertices[:1], vertices, vertices[-1:]])
    if np.array_equal(vertices[0], vertices[-1]):
        padded[0], padded[-1] = vertices[-2], vertices[1]
    curves = [
        bezier([start, start + (end - before) / 6.0, end - (after - start) / 6.0, end])
        for before, start, end, after in zip(padded, padded[1:], padded[2:], padded[3:], strict=False)
    ]
    return np.vstack([vertices[:1], *curves])


def read_texts(element: Json, names: tuple[str, ...], groups: tuple[int, ...], source: str) -> Iterator[Text]:
    """Read words, line by line; words in a shape have a place of their own, too."""
    lines = words(element.get("text")).split("\n")
    size, angle = number(element.get("fontSize"), 20.0), number(element.get("angle"))
    width, height = number(element.get("width")), number(element.get("height"))
    corner = np.array([number(element.get("x")), number(element.get("y"))])
    for k, text in enumerate(lines):
        offset = np.array([[0.0, (k + 0.5 - len(lines) / 2.0) * height / len(lines)]])
        x, y = corner + (width / 2.0, height / 2.0) + rotated(offset, angle)[0]
        yield Text(text, (float(x), float(-y)), CAPITAL * size, -angle, names, groups, source)
