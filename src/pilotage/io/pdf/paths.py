"""Paths of a PDF page: outlines, colors, clips, and the layer that holds them."""

import ctypes
from collections.abc import Callable
from typing import Any

import numpy as np
import pypdfium2.raw as pdfium

from pilotage.geometry import Affine2, Array
from pilotage.interpretation.sheet import Color
from pilotage.io.colors import is_hint, on_paper
from pilotage.io.curves import bezier
from pilotage.io.pdf.frame import affine

LONGEST_NAME = 200
"""Letters of a layer's name."""

Handle = Any  # a pointer of the library


def matrix_of(handle: Handle) -> Affine2:
    """Return the map from an object's coordinates to those of the page or form that holds it."""
    matrix = pdfium.FS_MATRIX()
    pdfium.FPDFPageObj_GetMatrix(handle, matrix)
    return affine(matrix.a, matrix.b, matrix.c, matrix.d, matrix.e, matrix.f)


def subpaths_of(count: int, segment_at: Callable[[int], Handle]) -> list[tuple[Array, bool]]:
    """Cut a path of the library into chords: the points (n, 2) of each subpath, and whether it is closed."""
    found: list[tuple[Array, bool]] = []
    points: list[tuple[float, float]] = []
    control: list[tuple[float, float]] = []
    x, y = ctypes.c_float(), ctypes.c_float()

    def finish(*, closed: bool) -> None:
        if len(points) > 1:
            found.append((np.array(points), closed))

    for k in range(count):
        segment = segment_at(k)
        kind = pdfium.FPDFPathSegment_GetType(segment)
        if not pdfium.FPDFPathSegment_GetPoint(segment, x, y):
            continue
        point = (x.value, y.value)
        if kind == pdfium.FPDF_SEGMENT_MOVETO:
            finish(closed=False)
            points = [point]
        elif kind == pdfium.FPDF_SEGMENT_BEZIERTO:
            control.append(point)
            if len(control) == 3:
                points.extend(map(tuple, bezier([points[-1] if points else control[0], *control])))
                control = []
        else:
            points.append(point)
        if pdfium.FPDFPathSegment_GetClose(segment):
            finish(closed=True)
            points = points[:1]
    finish(closed=False)
    return found


def path_of(handle: Handle) -> list[tuple[Array, bool]]:
    """Return the subpaths of an object in its own coordinates."""
    count = pdfium.FPDFPath_CountSegments(handle)
    return subpaths_of(count, lambda k: pdfium.FPDFPath_GetPathSegment(handle, k))


def clips_of(handle: Handle) -> list[list[tuple[Array, bool]]]:
    """Return the paths that an object is cut to, one after the other, in coordinates of the page or form."""
    clip = pdfium.FPDFPageObj_GetClipPath(handle)
    count = pdfium.FPDFClipPath_CountPaths(clip) if clip else 0

    def clip_path(path: int) -> list[tuple[Array, bool]]:
        segments = pdfium.FPDFClipPath_CountPathSegments(clip, path)
        return subpaths_of(segments, lambda k: pdfium.FPDFClipPath_GetPathSegment(clip, path, k))

    return [clip_path(path) for path in range(max(count, 0))]


def paint_of(handle: Handle) -> tuple[Color | None, Color | None, bool]:
    """Return the colors of area and line, and whether the area follows the winding rule."""
    mode, stroked = ctypes.c_int(), ctypes.c_int()
    pdfium.FPDFPath_GetDrawMode(handle, mode, stroked)
    fill = color_of(handle, pdfium.FPDFPageObj_GetFillColor) if mode.value else None
    line = color_of(handle, pdfium.FPDFPageObj_GetStrokeColor) if stroked.value else None
    return fill, line, mode.value == pdfium.FPDF_FILLMODE_WINDING


def color_of(handle: Handle, read: Callable[..., int]) -> Color | None:
    """Return a color as it looks on white paper; None if it is transparent, or nearly so."""
    red, green, blue, alpha = ctypes.c_uint(), ctypes.c_uint(), ctypes.c_uint(), ctypes.c_uint()
    if not read(handle, red, green, blue, alpha) or alpha.value == 0:
        return None
    rgb, opacity = (red.value, green.value, blue.value), alpha.value / 255.0
    return None if is_hint(rgb, opacity) else on_paper(rgb, opacity)


def stroke_of(handle: Handle) -> tuple[float, bool]:
    """Return the width of an object's line in its own coordinates, and whether it is dashed."""
    width = ctypes.c_float()
    pdfium.FPDFPageObj_GetStrokeWidth(handle, width)
    return float(width.value), pdfium.FPDFPageObj_GetDashCount(handle) > 0


def layers_of(handle: Handle) -> tuple[str, ...]:
    """Return the names of the layers that hold an object, as CAD programs write them."""
    names = []
    for k in range(pdfium.FPDFPageObj_CountMarks(handle)):
        mark = pdfium.FPDFPageObj_GetMark(handle, k)
        buffer = (ctypes.c_ushort * LONGEST_NAME)()
        size = ctypes.c_ulong()
        if pdfium.FPDFPageObjMark_GetParamStringValue(mark, b"Name", buffer, ctypes.sizeof(buffer), size):
            text = bytes(buffer)[: min(size.value, ctypes.sizeof(buffer))].decode("utf-16-le", "ignore")
            names.append(text.rstrip("\0"))
    return tuple(names)
