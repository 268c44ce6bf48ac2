"""Fit a drawing in a process beside a drive, so that no step waits for it."""

import os
import time
from collections.abc import Sequence
from dataclasses import dataclass

from pilotage.correction.correct import NothingBelievedError, correct_drawing
from pilotage.correction.corrected import CorrectedDrawing
from pilotage.correction.sighting import Sighting
from pilotage.maps import Atlas

POLITE = 10
"""Added to the niceness of the process: the robot goes first."""


@dataclass(frozen=True, eq=False)
class BackgroundCorrection:
    """What a process beside a drive found."""

    corrected: CorrectedDrawing | None  # None if the robot was not sure enough yet
    took: float  # [s] of the processor


def give_way() -> None:
    """Let all other processes go before this one."""
    if hasattr(os, "nice"):  # Windows has none
        os.nice(POLITE)


def fit_drawing(atlas: Atlas, sightings: Sequence[Sighting]) -> BackgroundCorrection:
    """Correct a drawing as far as the robot is sure, and measure what that costs."""
    began = time.process_time()
    try:
        corrected = correct_drawing(atlas, sightings)
    except NothingBelievedError:
        corrected = None
    return BackgroundCorrection(corrected, time.process_time() - began)
