"""The elastic drawing: a drawing is bent to where the robot saw its walls, in metres."""

from pilotage.correction.background import BackgroundCorrection, fit_drawing, give_way
from pilotage.correction.correct import BELIEVED, NothingBelievedError, correct_drawing
from pilotage.correction.corrected import CorrectedDrawing, Passage, PassageState
from pilotage.correction.sighting import Sighting, append_sighting

__all__ = [
    "BELIEVED",
    "BackgroundCorrection",
    "CorrectedDrawing",
    "NothingBelievedError",
    "Passage",
    "PassageState",
    "Sighting",
    "append_sighting",
    "correct_drawing",
    "fit_drawing",
    "give_way",
]
