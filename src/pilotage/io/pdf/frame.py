"""From the coordinates of a page's content to those of the page as it is shown: points, y up."""

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from pilotage.geometry import Affine2

if TYPE_CHECKING:
    import pypdfium2


def shown_from_content(page: "pypdfium2.PdfPage") -> Affine2:
    """Return the map that turns and crops a page as a viewer does: its lower left corner is the origin."""
    left, bottom, right, top = page.get_cropbox()
    turns = (int(page.get_rotation()) // 90) % 4  # clockwise
    linear = np.array([[1.0, 0.0], [0.0, 1.0]])
    for _ in range(turns):
        linear = np.array([[0.0, 1.0], [-1.0, 0.0]]) @ linear
    corners = np.array([[left, bottom], [right, top]]) @ linear.T
    return Affine2(linear, -corners.min(axis=0))


@lru_cache(maxsize=1024)
def affine(  # noqa: PLR0917  # the order of the six numbers in a file
    a: float, b: float, c: float, d: float, e: float, f: float
) -> Affine2:
    """Return the map of a PDF matrix: x' = a x + c y + e, y' = b x + d y + f."""
    return Affine2(np.array([[a, c], [b, d]]), np.array([e, f]))
