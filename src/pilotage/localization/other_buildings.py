"""How well drawings of other buildings explain what the robot sees: what "not in this building" predicts.

In some buildings nearly any drawing explains the scans, because corridors are alike; in others not even the
right one does so well. So evidence for a drawing means something only beside that for drawings of buildings
where the robot is not. Such a sheet is packed here: floor plans of two buildings that do not exist. A small
particle filter follows the robot on it as if it were there; it knows nothing of the user's drawing. Its
log-evidence is subtracted from that of the drawing.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from importlib.resources import files

import numpy as np

from pilotage.geometry import Polyline
from pilotage.localization.keyframes import Keyframe, append_keyframe
from pilotage.localization.observation import Observation
from pilotage.localization.particle_filter import ParticleFilter, Posterior
from pilotage.localization.prior import Prior
from pilotage.localization.sensor_model import SensorModel, SensorSettings
from pilotage.localization.tracks import TrackSettings
from pilotage.maps import Atlas, AtlasSettings, SchematicMap
from pilotage.maps.atlas import find_drawn_corners
from pilotage.maps.range_table import RangeTableSettings, build_range_table

SHEET = "other_buildings.csv"
"""Walls as x1, y1, x2, y2 [m]."""
CELLS = 200
"""Cells along the longer side of the sheet: half a metre."""
COUNTS = TrackSettings(first_count=15_000, max_count=3_000, min_count=3_000, moving=0.0005)
"""Particles before the first scan and after it: a tenth of those on the user's drawing. So few lose a place
at times, and the robot is nowhere on the sheet anyhow: it may be carried."""
EVERY = 1.0
"""[m] of travel between two searches of the sheet."""
PROPOSALS, BIRTHS = 1_500, 250
"""Places that a search of the sheet tries, and particles to which it gives birth."""


@dataclass(frozen=True, eq=False)
class ElsewhereState:
    """What the filter holds, as a value that can be kept."""

    posterior: Posterior
    window: tuple[Keyframe, ...]
    generator: Mapping[str, object]  # of its random numbers


class OtherBuildings:
    """Follows a robot on drawings of buildings where it is not; holds state from keyframe to keyframe."""

    def __init__(self, sensor: SensorSettings, seed: int = 0) -> None:
        self._rng = np.random.default_rng(seed)
        self._filter = ParticleFilter(
            SensorModel(sheet(), sensor), Prior(), COUNTS, PROPOSALS, BIRTHS, clustered=False
        )
        self._posterior = self._filter.first(None, self._rng)
        self._window: tuple[Keyframe, ...] = ()

    def compared(self, seen: Observation) -> Observation:
        """Follow the robot to a keyframe, and return it with how likely it is in another building."""
        window = append_keyframe(self._window, seen)
        effort = float(window[-1].travel - self._posterior.searched >= EVERY)
        posterior = self._filter.updated(self._posterior, window, seen.motion, self._rng, effort=effort)
        self._posterior, self._window = posterior, window
        return replace(seen, log_elsewhere=posterior.log_totals[-1][1])

    @property
    def state(self) -> ElsewhereState:
        """All that it holds; `go_on` takes it up again."""
        return ElsewhereState(self._posterior, self._window, self._rng.bit_generator.state)

    def go_on(self, state: ElsewhereState) -> None:
        """Go on from a state, as if it had never stopped."""
        self._posterior, self._window = state.posterior, state.window
        self._rng.bit_generator.state = dict(state.generator)


@cache
def sheet() -> Atlas:
    """Read the packed floor plans, once in a process; their scale is one unit a metre."""
    with files(__package__).joinpath(SHEET).open(encoding="utf-8") as file:
        walls = np.loadtxt(file, delimiter=",")
    plans = SchematicMap(tuple(Polyline(wall.reshape(2, 2)) for wall in walls))
    range_table = build_range_table(plans, RangeTableSettings(cells=CELLS))
    return Atlas(
        plans, range_table, None, find_drawn_corners(plans, None, AtlasSettings().detail), log_scale=0.0
    )
