"""Write the corrected drawing: what `localize` and `navigate` share."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from pilotage.cli.terminal import busy, say
from pilotage.errors import PilotageError

if TYPE_CHECKING:
    from pilotage.correction import CorrectedDrawing, Sighting
    from pilotage.maps import Atlas


def write_corrections(atlas: "Atlas", sightings: "Sequence[Sighting]", paths: Sequence[Path]) -> None:
    """Correct a drawing, write it to all paths, and say what was found.

    Raises PilotageError, and writes nothing, if the localizer was hardly ever sure of its place.
    """
    from pilotage.correction import NothingBelievedError, correct_drawing
    from pilotage.io.corrected import write_corrected

    with busy("Correcting the drawing"):
        try:
            corrected = correct_drawing(atlas, sightings)
        except NothingBelievedError as error:
            raise PilotageError(f"no corrected drawing is written: {error}") from error
        for path in paths:
            write_corrected(corrected, path)
    say(told(corrected))


def told(corrected: "CorrectedDrawing") -> str:
    """Say in a line what was found."""
    from pilotage.correction import PassageState

    states = [passage.state for passage in corrected.passages]
    left, bottom, right, top = corrected.sketch.bounds
    return (
        f"Corrected: {right - left:.1f} x {top - bottom:.1f} m, {corrected.scale:.3g} units of the drawing a"
        f" metre; {corrected.seen_share:.0%} of the walls seen; of {len(states)} gateways"
        f" {states.count(PassageState.OPEN)} found open, {states.count(PassageState.CLOSED)} closed."
    )
