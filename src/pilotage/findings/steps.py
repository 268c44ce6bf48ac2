"""Find what looks like stairs, and is taken for something that a robot drives around or over."""

from collections.abc import Iterator

import numpy as np
import shapely

from pilotage.findings.finding import Finding, Severity
from pilotage.findings.words import named
from pilotage.interpretation import Interpretation, Role
from pilotage.interpretation.steps import rows_of_steps
from pilotage.maps import CellGraph
from pilotage.maps.routing.forgotten_doors import door_width

WIDTHS = (0.6, 4.0)
"""Steps are so many doors wide: racks are narrower."""


def find_drivable_stairs(graph: CellGraph, interpretation: Interpretation | None) -> Iterator[Finding]:
    """Find rows of lines in a room that look like the steps of stairs and are taken for furniture."""
    if interpretation is None:
        return
    pairs = zip(interpretation.sheet.marks, interpretation.meanings, strict=True)
    rings = [line.ring for mark, meaning in pairs if meaning.role is Role.FURNITURE for line in mark.outlines]
    lines = np.vstack([np.empty((0, 2, 2)), *(np.stack([ring[:-1], ring[1:]], axis=1) for ring in rings)])
    least, most = np.array(WIDTHS) * door_width(graph)
    lengths = np.hypot(*(lines[:, 1] - lines[:, 0]).T)
    lines = lines[(lengths >= least) & (lengths <= most)]
    for row in rows_of_steps(lines):
        x, y = lines[row].mean(axis=(0, 1)).tolist()
        for cell in graph.cells:
            if cell.polygon.contains(shapely.Point(x, y)):
                yield Finding(
                    "drivable-stairs",
                    Severity.NOTE,
                    f"{len(row)} lines in {named(cell)} look like steps, and a robot may drive there",
                    "if they are stairs, put them on a layer named 'stairs', or say so: --layer NAME=stairs",
                    (x, y),
                    (cell.cell_id,),
                )
