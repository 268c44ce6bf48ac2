"""Scan in, estimate out: a clustered particle filter over the places of a drawing."""

import math
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from pilotage.geometry import Array, Pose2, segments_of
from pilotage.localization.belief import Belief
from pilotage.localization.blocked_way import BlockedWay
from pilotage.localization.estimate import Estimate, summarize
from pilotage.localization.explanation import Explanation, explain
from pilotage.localization.global_search import SCANS
from pilotage.localization.keyframes import (
    Keyframe,
    append_blocked_way,
    append_keyframe,
    choose_keyframes,
)
from pilotage.localization.observation import Observation, observe
from pilotage.localization.other_buildings import OtherBuildings
from pilotage.localization.particle_filter import ParticleFilter
from pilotage.localization.prior import Prior, check_scale
from pilotage.localization.sensor_model import SensorModel, SensorSettings, SparseScan
from pilotage.localization.state import LocalizerState, fingerprint
from pilotage.localization.tracks import Tracks, TrackSettings
from pilotage.maps import Atlas, AtlasSettings, SchematicMap, build_atlas
from pilotage.perception import LaserScan, Odometry
from pilotage.scan_matching import ScanMatcher, ScanMatchingSettings
from pilotage.shape import Simplification, simplify_all

FIT_MEMORY = 10
"""Number of keyframes over which the fit is averaged: 5 m."""
BIRTH_COUNT = 2_000
"""Particles that a search gives birth to."""
SETTLED = 0.8
"""Probability from which on the place is settled: then a search of the whole drawing is rare and small."""
SETTLED_EVERY = 2.0
"""[m] of travel between two searches while the place is settled."""
SETTLED_PROPOSALS = 0.25
"""Share of the proposals that a search tries while the place is settled."""


@dataclass(frozen=True, slots=True)
class LocalizerSettings:
    """The settings of all stages, and when a scan becomes a keyframe."""

    atlas: AtlasSettings = field(default_factory=AtlasSettings)
    scan_matching: ScanMatchingSettings = field(default_factory=ScanMatchingSettings)
    prior: Prior = field(default_factory=Prior)
    sensor: SensorSettings = field(default_factory=SensorSettings)
    tracks: TrackSettings = field(default_factory=TrackSettings)
    proposals: int = 12_000  # places that a search of the whole drawing tries
    step: float = 0.5  # [m] of motion after which a scan becomes a keyframe
    turn: float = math.radians(20.0)  # [rad] of a turn after which a scan becomes a keyframe

    def __post_init__(self) -> None:
        """Reject invalid settings."""
        for name in ("step", "turn"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be > 0, got {getattr(self, name)}")
        if not self.proposals >= 100:
            raise ValueError(f"proposals must be >= 100, got {self.proposals}")

    def is_keyframe_due(self, motion: Pose2) -> bool:
        """Tell whether the robot has moved far enough since the last keyframe."""
        return math.hypot(motion.x, motion.y) >= self.step or abs(motion.theta) >= self.turn


class Localizer:
    """Finds where on a drawing a robot is, scan by scan; the one place that holds state.

    Takes a drawing, or an atlas that was built of one before. `start`, if it is known, is x, y and, if that
    is known too, the heading [rad], in the drawing's own units and axes; `scale` is in drawing units per
    metre. Without them the robot may be anywhere, at any heading, and the drawing of any scale. Raises
    ValueError if an argument is invalid, and ScaleError if no building is as large as a scale says.
    """

    def __init__(
        self,
        drawing: SchematicMap | Atlas,
        settings: LocalizerSettings | None = None,
        *,
        seed: int = 0,
        start: tuple[float, float] | tuple[float, float, float] | None = None,
        scale: float | None = None,
    ) -> None:
        self.settings = settings if settings is not None else LocalizerSettings()
        if start is not None and not (len(start) in {2, 3} and all(map(math.isfinite, start))):
            raise ValueError(f"start must be x, y and a heading, all finite, got {start}")
        self.atlas = drawing if isinstance(drawing, Atlas) else build_atlas(drawing, self.settings.atlas)
        self._prior, self._scale = self.settings.prior, scale
        if scale is not None:
            check_scale(scale, self.atlas.sketch.diagonal)
            self.atlas = replace(self.atlas, log_scale=math.log(scale))
            self._prior = replace(self._prior, log_scale=self._prior.given_log_scale)
        self._rng = np.random.default_rng(seed)
        self._model = SensorModel(self.atlas, self.settings.sensor)
        self._filter = ParticleFilter(
            self._model, self._prior, self.settings.tracks, self.settings.proposals, BIRTH_COUNT
        )
        self.scan_matcher = ScanMatcher(self.settings.scan_matching)
        self._belief = Belief(self._filter.first(start, self._rng))

    @classmethod
    def resumed(
        cls,
        drawing: SchematicMap | Atlas,
        state: LocalizerState,
        settings: LocalizerSettings | None = None,
        *,
        scale: float | None = None,
        stood: bool = False,
    ) -> "Localizer":
        """Go on from the `state` of a localizer on the same drawing, as if it had never stopped.

        The settings must be those of before; so is the `scale`, if none is given. With `stood` the robot is
        taken not to have moved since, whatever odometry says. What is resumed is a belief as any other, and
        is given up if what is seen speaks against it. Raises OtherDrawingError if the state is of another
        drawing.
        """
        state.check_drawing(drawing.sketch if isinstance(drawing, Atlas) else drawing)
        scale = state.scale if scale is None else scale
        localizer = cls(drawing, settings, start=(0.0, 0.0), scale=scale)  # few particles, and replaced
        localizer._belief = state.belief
        vars(localizer.scan_matcher).update(state.scan_matcher)
        localizer.other_buildings.go_on(state.elsewhere)
        localizer._rng.bit_generator.state = dict(state.generator)
        if stood:
            localizer.scan_matcher.stood_still()
        return localizer

    @property
    def state(self) -> LocalizerState:
        """All that was learned so far; `resumed` goes on from it."""
        matcher = {name: value for name, value in vars(self.scan_matcher).items() if name != "settings"}
        return LocalizerState(
            fingerprint(self.atlas.sketch),
            self._belief,
            matcher,
            self.other_buildings.state,
            self._rng.bit_generator.state,
            self._scale,
        )

    @cached_property
    def other_buildings(self) -> OtherBuildings:
        """What drawings of other buildings make of the way; not needed if observations tell it already."""
        return OtherBuildings(self.settings.sensor)

    @property
    def estimate(self) -> Estimate:
        """The last estimate; ValueError before the first update."""
        if self._belief.estimate is None:
            raise ValueError("an estimate needs at least one scan, got none")
        return self._belief.estimate

    @property
    def tracks(self) -> Tracks:
        """The places where the robot may be."""
        return self._belief.posterior.tracks

    @property
    def log_evidence(self) -> float:
        """The log-evidence of this drawing over that of other buildings, since the first scan [nats]."""
        return self._belief.log_evidence

    def sample(self, count: int) -> Array:
        """Pick states of equally probable particles, for planning over all tracks, (6, count)."""
        return self.tracks.particles.picked(count)

    def explain(self) -> Explanation:
        """Tell which drawn walls speak for the best place of now, and which against.

        ValueError before the first update.
        """
        estimate = self._belief.at_keyframe
        if estimate is None:
            raise ValueError("an explanation needs at least one scan, got none")
        least = Simplification(self.settings.atlas.detail * self.atlas.sketch.diagonal)
        walls = segments_of(simplify_all(self.atlas.sketch.strokes, least))
        keyframes = choose_keyframes(self._belief.window, SCANS)
        return explain(estimate.place, estimate.sketch_from_base, keyframes, walls, self._model)

    def update(self, scan: LaserScan, odometry: Odometry) -> Estimate:
        """Take one scan in, give one estimate out."""
        seen = self.scan_matcher.update(scan, odometry)  # 2.1, 2.2, 3.3: the robot's side, knows no drawing
        motion = self._belief.motion @ seen.last_from_base
        is_due = seen.was_carried or self.settings.is_keyframe_due(motion)
        if self._belief.at_keyframe is None or is_due:
            keyframe = observe(scan, seen.shapes, motion, was_carried=seen.was_carried)
            return self.add_keyframe(self.other_buildings.compared(keyframe))
        self._belief = self._belief.moved(motion, scan.stamp, self.atlas)
        return self.estimate

    def add_keyframe(self, seen: Observation) -> Estimate:
        """Propagate and reweight all tracks, let new ones be born, and sum up.

        `update` calls it. Who compares one log with many drawings may give them the same observations.
        """
        belief = self._belief
        window = append_keyframe(belief.window, seen)
        effort = search_effort(belief, window)
        posterior = self._filter.updated(belief.posterior, window, seen.motion, self._rng, effort=effort)
        fits = (*belief.fits, *self._fits(posterior.tracks, seen.scan))[-FIT_MEMORY:]
        fit = sum(fits) / len(fits) if posterior.tracks.tracks else 0.0
        belief = replace(
            belief,
            posterior=posterior,
            log_elsewhere=belief.log_elsewhere + seen.log_elsewhere,
            window=window,
            fits=fits,
            motion=Pose2.identity(),
        )
        self._belief = self._summed_up(belief, fit, seen.stamp)
        return self.estimate

    def add_blocked_way(self, way: BlockedWay) -> None:
        """Weigh all tracks by a way that the robot found blocked, in its frame at the last update.

        A way that was found blocked before, over the last metres, is not counted again. Raises ValueError
        before the first update.
        """
        belief, last = self._belief, self._belief.at_keyframe
        if last is None:
            raise ValueError("a blocked way needs a scan before it, got none")
        window = append_blocked_way(belief.window, way.moved(belief.motion))
        if window is belief.window:
            return
        posterior = self._filter.with_blocked_way(belief.posterior, window, self._rng)
        stamp = self.estimate.stamp
        belief = replace(belief, posterior=posterior, window=window)
        belief = self._summed_up(belief, last.fit, last.stamp)
        self._belief = belief.moved(belief.motion, stamp, self.atlas)

    def _summed_up(self, belief: Belief, fit: float, stamp: float) -> Belief:
        """Estimate the place at the newest keyframe."""
        tracks, is_mismatch = belief.posterior.tracks, belief.is_mismatch
        estimate = summarize(tracks, fit, stamp, belief.log_evidence, self.atlas, is_mismatch=is_mismatch)
        return replace(belief, at_keyframe=estimate, estimate=estimate)

    def _fits(self, tracks: Tracks, scan: SparseScan) -> tuple[float, ...]:
        """Measure the fit of a scan at the leading track, if there is one."""
        if not tracks.tracks:
            return ()
        leading = tracks.tracks[0].particles
        return (self._model.fit(leading.states[:, int(leading.log_weights.argmax())], scan),)


def search_effort(belief: Belief, window: tuple[Keyframe, ...]) -> float:
    """Return the share of the proposals that a search tries at the newest keyframe; 0 for no search.

    There is none at the first keyframe: its particles were drawn just before. Then all are tried at every
    keyframe until the place is settled.
    """
    if belief.at_keyframe is None:
        return 0.0
    if belief.at_keyframe.probability < SETTLED:
        return 1.0
    is_due = window[-1].travel - belief.posterior.searched >= SETTLED_EVERY
    return SETTLED_PROPOSALS if is_due else 0.0
