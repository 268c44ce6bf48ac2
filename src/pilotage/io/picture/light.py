"""Take uneven light, shadows and the colors of floors from a picture: what is left is what was drawn."""

import numpy as np
from numpy.typing import NDArray

PEN = 0.01
"""A pen stroke or a wall is narrower than twice this share of the picture's diagonal; wider are grounds."""

BLACK = 0.3
"""A wide area this dark, as a share of paper's light, is a wall however wide it is."""

SMOOTH = 0.7
"""Noise of a camera is smoothed over this many pixels."""

DARK_PAPER = 0.4
"""Darker than this share of the lightest there is, paper is a board, and drawn on in light."""

LEAST_LIGHT = 0.04
"""Shades below this are not told apart: the noise of a camera in the dark."""


def flatten(colors: NDArray[np.float32], *, is_photo: bool) -> NDArray[np.float32]:
    """Return colors as a share of those of the ground around, (height, width, 3): 1 is ground, 0 black.

    A ground is what is wider than a pen and lighter: paper in light or shadow, and the floor of a room. In a
    drawing by a program or scanner what is dark and wide is drawn, too; in a photo it may be a shadow.
    """
    from scipy.ndimage import gaussian_filter

    some = colors[::4, ::4]
    if float(np.median(some)) < DARK_PAPER * float(np.quantile(some, 0.995)):
        colors = 1.0 - colors
    radius = max(2, round(PEN * float(np.hypot(*colors.shape[:2]))))
    flat = np.moveaxis(np.empty((3, *colors.shape[:2]), dtype=np.float32), 0, 2)  # each channel in one piece
    for channel in range(3):
        if channel and np.array_equal(colors[..., channel], colors[..., channel - 1]):  # a gray picture
            flat[..., channel] = flat[..., channel - 1]
            continue
        shade = gaussian_filter(colors[..., channel], SMOOTH) if is_photo else colors[..., channel]
        ground = grounds(shade, radius)
        if not is_photo:
            paper = max(float(np.median(ground)), LEAST_LIGHT)
            ground = np.where(ground < BLACK * paper, paper, ground)
        flat[..., channel] = np.minimum((shade + LEAST_LIGHT) / (ground + LEAST_LIGHT), 1.0)
    return flat


def grounds(shade: NDArray[np.float32], radius: int) -> NDArray[np.float32]:
    """Close dark marks narrower than two radii [pixels] with the light around them."""
    from scipy.ndimage import maximum_filter, minimum_filter, uniform_filter

    size = 2 * radius + 1
    closed = minimum_filter(maximum_filter(shade, size), size)
    return np.asarray(np.maximum(uniform_filter(closed, radius | 1), shade))
