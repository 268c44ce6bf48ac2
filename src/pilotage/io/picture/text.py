"""Find words in ink: islands of the size of letters, curled as no stroke of a plan is, side by side."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Mask = NDArray[np.bool_]

LETTER = 0.035
"""Letters are lower than this share of the diagonal of all that is drawn."""

WORD = 0.16
"""A joined-up word is not longer than this share."""

CURLED = 1.5
"""The middle line of a letter is this many times as long as the letter is large; that of a stroke is not."""

BOX = 0.93
"""What fills its box by this share, holes and all, is a piece of a wall, and no joined-up word."""

BESIDE = 0.8
"""Letters of a word stand within this many of their own sizes of each other."""

NARROW = 4.0
"""What is curled and stands alone is a word run together if it is lower than so many widths of the pen."""

SPECK = 0.004
"""An island smaller than this share of the diagonal, and than two widths of the pen, is dirt or a dot."""


@dataclass(frozen=True, eq=False)
class Words:
    """What is written, which a picture shows but does not tell."""

    mask: Mask  # (height, width) the ink of words, numbers and specks
    letters: NDArray[np.float64]  # (n, 2) middles of the letters of words, x and y, y down [pixels]


def find_words(ink: Mask, middle: Mask, pen_width: float) -> Words:
    """Find words, numbers and specks, given the ink and its middle lines, (height, width)."""
    from skimage.measure import label, regionprops

    rows, columns = np.nonzero(ink)
    if not len(rows):
        return Words(np.zeros_like(ink), np.empty((0, 2)))
    diagonal = float(np.hypot(np.ptp(rows), np.ptp(columns)))
    labels = label(ink, connectivity=2)
    islands = regionprops(labels)
    boxes = np.array([island.bbox for island in islands], dtype=np.float64)
    areas = np.array([island.area for island in islands], dtype=np.float64)
    lengths = np.bincount(labels[middle], minlength=len(islands) + 1)[1:]
    sides = boxes[:, 2:] - boxes[:, :2]
    size = sides.max(axis=1)
    curl = lengths / np.maximum(size - pen_width, 1.0)
    small = size <= LETTER * diagonal
    low = (sides.min(axis=1) <= LETTER * diagonal) & (size <= WORD * diagonal)
    joined_up = low & ~small & (curl > CURLED)
    for index in np.nonzero(joined_up)[0]:
        joined_up[index] = islands[index].area_filled < BOX * sides[index].prod()
    letters = (small & (curl > CURLED)) | joined_up
    lone = letters & small & (neighbors(boxes, letters) == 0) & (sides.min(axis=1) > NARROW * pen_width)
    words = letters & ~lone
    middles = (boxes[words, 1::-1] + boxes[words, :1:-1]) / 2.0
    tiny = small & ((areas < BOX * sides.prod(axis=1)) | (sides.min(axis=1) < 2.0 * pen_width))
    for _ in range(2):  # strokes and dots beside letters, and those beside them, as in "ill"
        words |= tiny & (neighbors(boxes, words) > 0)
    words |= size <= max(2.0 * pen_width, SPECK * diagonal)
    return Words(np.asarray(np.concatenate([[False], words])[labels]), middles)


def neighbors(boxes: NDArray[np.float64], letters: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Count the letters beside each box (n, 4 as top, left, bottom, right), as near as they are large."""
    counts = np.zeros(len(boxes), dtype=np.int64)
    for index in np.nonzero(letters)[0]:
        top, left, bottom, right = boxes[index]
        reach = BESIDE * min(bottom - top, right - left) + 1.0
        near = (
            (boxes[:, 0] < bottom + reach)
            & (boxes[:, 2] > top - reach)
            & (boxes[:, 1] < right + reach)
            & (boxes[:, 3] > left - reach)
        )
        near[index] = False
        counts += near
    return counts
