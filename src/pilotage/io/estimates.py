"""Write estimates as JSON Lines, one object a scan, in the drawing's own units and axes."""

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TextIO

from pilotage.geometry import Affine2
from pilotage.io.files import replacing
from pilotage.localization import Estimate
from pilotage.maps import SchematicMap

DIGITS = 9
"""Significant digits of all numbers but stamps: drawings may be a millimetre wide or a mile."""


def estimate_record(estimate: Estimate, sketch: SchematicMap) -> dict[str, object]:
    """Return an estimate as a line of the file holds it.

    `x` and `y` are in the axes of the drawing's file (for SVG y down); `heading` is counter-clockwise on the
    page from its x axis [rad]; `scale` is in drawing units per metre.
    """
    return {
        "stamp": estimate.stamp,
        "status": estimate.status.value,
        "place": estimate.place,
        "cell": estimate.cell_id,
        **place_record(estimate.sketch_from_base, sketch),
        "probability": rounded(estimate.probability),
        "fit": rounded(estimate.fit),
        "evidence": rounded(estimate.log_evidence),
        "hypotheses": [
            {
                "cell": hypothesis.cell_id,
                **place_record(hypothesis.sketch_from_base, sketch),
                "probability": rounded(hypothesis.probability),
            }
            for hypothesis in estimate.hypotheses
        ],
    }


def place_record(sketch_from_base: Affine2, sketch: SchematicMap) -> dict[str, float]:
    """Return a place and a scale in the axes of the drawing's file."""
    pose = sketch.file_axes.pose_from_sketch(sketch_from_base.pose)
    return {
        "x": rounded(pose.x),
        "y": rounded(pose.y),
        "heading": rounded(pose.theta),
        "scale": rounded(sketch_from_base.scale),
    }


def rounded(value: float) -> float:
    """Keep the digits that may mean something.

    >>> rounded(0.1 + 0.2), rounded(123456.7890123)
    (0.3, 123456.789)
    """
    return float(f"{value:.{DIGITS}g}")


@contextmanager
def estimates_file(path: Path | str, sketch: SchematicMap) -> Iterator[Callable[[Estimate], None]]:
    """Open a file for estimates; it is complete when the block ends, and absent if the block fails.

    If the block is interrupted, the estimates so far are kept as `name.partial.suffix`.
    """
    with replacing(path, keeps_partial=True) as beside, beside.open("w", encoding="utf-8") as file:
        yield lambda estimate: write_estimate(file, estimate, sketch)


def write_estimate(file: TextIO, estimate: Estimate, sketch: SchematicMap) -> None:
    """Write one line."""
    file.write(json.dumps(estimate_record(estimate, sketch), allow_nan=False) + "\n")
