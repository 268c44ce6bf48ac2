"""The drawing as the robot of a drive or a log found it, as SVG in metres."""

from collections.abc import Sequence

from pilotage.correction import NothingBelievedError, Sighting, correct_drawing
from pilotage.errors import PilotageError
from pilotage.io.corrected import svg_text
from pilotage.maps import Atlas


class NotSureError(PilotageError):
    """The robot was hardly ever sure of its place."""


def corrected_svg(atlas: Atlas, sightings: Sequence[Sighting]) -> str:
    """Bend a drawing to where its walls were seen; NotSureError if the robot was hardly ever sure."""
    try:
        return svg_text(correct_drawing(atlas, sightings))
    except NothingBelievedError as error:
        raise NotSureError("the drawing cannot be corrected yet: the robot must be sure for 5 m") from error
