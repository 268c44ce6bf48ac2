"""From a picture of a drawing to its marks: a photo of paper, a scan, a screenshot, a whiteboard.

In the order of the work: `photo` finds the paper and straightens it, `light` takes away shades and floors,
`ink` finds what was drawn and takes away ruled lines, `text` tells words apart, `trace` makes lines and areas
of the rest, lines along the `skeleton`. `sheet` puts them together.
"""

from pilotage.io.picture.sheet import sheet_of

__all__ = ["sheet_of"]
