"""Colors as drawing programs write them."""

from collections.abc import Sequence

from pilotage.interpretation.paper import FAINT, difference
from pilotage.interpretation.sheet import WHITE, Color

NOTHING = frozenset(("", "none", "transparent", "inherit"))


def read_color(text: str, opacity: float = 1.0) -> Color | None:
    """Return a color as it looks on white paper; None if it is transparent or not understood.

    >>> read_color("#f00"), read_color("#00000080"), read_color("transparent")
    ((1.0, 0.0, 0.0), (0.4980392156862745, 0.4980392156862745, 0.4980392156862745), None)
    """
    from PIL import ImageColor

    name = text.strip().lower()
    if name.startswith("light-dark("):
        name = name.removeprefix("light-dark(").split(",")[0].strip()
    if name in NOTHING:
        return None
    try:
        red, green, blue, *alpha = ImageColor.getrgb(name)
    except ValueError:
        return None
    share = min(max(opacity, 0.0), 1.0) * (alpha[0] / 255.0 if alpha else 1.0)
    if share <= 0.0:
        return None
    return on_paper((red, green, blue), share)


def on_paper(rgb: Sequence[int], opacity: float) -> Color:
    """Return the color that red, green and blue from 0 to 255 have on white paper; opacity is from 0 to 1.

    >>> on_paper((255, 0, 0), 0.5)
    (1.0, 0.5, 0.5)
    """
    red, green, blue = (1.0 - opacity * (1.0 - value / 255.0) for value in rgb)
    return red, green, blue


def is_hint(rgb: Sequence[int], opacity: float) -> bool:
    """Tell whether paint in a color is so thin that it cannot be seen on paper: it hides nothing either.

    >>> is_hint((0, 0, 0), 0.05), is_hint((0, 0, 0), 0.2), is_hint((255, 255, 255), 1.0)
    (True, False, False)
    """
    return difference(on_paper(rgb, opacity), WHITE) < FAINT <= difference(on_paper(rgb, 1.0), WHITE)
