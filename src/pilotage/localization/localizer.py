"""Scan in, estimate out: a clustered particle filter over the places of a drawing."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from pilotage.geometry import Array, Pose2, segments_of
from pilotage.localization.blocked_way import BlockedWay, log_ratio_of_ways
from pilotage.localization.estimate import Estimate, summarize
from pilotage.localization.explanation import Explanation, explain
from pilotage.localization.global_search import SCANS, global_search
from pilotage.localization.keyframes import (
    Keyframe,
    append_blocked_way,
    append_keyframe,
    choose_keyframes,
)
from pilotage.localization.motion_model import propagate
from pilotage.localization.observation import Observation, observe
from pilotage.localization.particles import Particles, join
from pilotage.localization.prior import Prior, check_scale, draw_anywhere, draw_near
from pilotage.localization.sensor_model import SensorModel, SensorSettings, SparseScan
from pilotage.localization.state import LocalizerState, fingerprint
from pilotage.localization.tracks import Track, Tracks, TrackSettings, cluster, leave, normalized, rare
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
MIN_CARRIED = 0.05
"""[m] of travel since a search that counts at least: a robot that only turns may have been carried, too."""
FIXED = ("settings", "atlas", "scan_matcher", "_prior", "_scale", "_rng", "_model")
"""Attributes that do not change from scan to scan, or have a state of their own."""


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
        self.scan_matcher = ScanMatcher(self.settings.scan_matching)
        self._log_told = 0.0 if start is None else -self.settings.tracks.told_log_odds
        self.tracks = self._first_tracks(start)
        self._motion: Pose2 | None = None  # since the last keyframe; None before the first scan
        self._window: tuple[Keyframe, ...] = ()
        self.log_evidence = 0.0  # of this drawing over that of any building, since the first scan
        self._log_totals: tuple[tuple[float, float], ...] = ()  # travel [m] and log-evidence of each keyframe
        self._fits: tuple[float, ...] = ()
        self._searched = 0.0  # [m] of travel at the last search
        self._keyframe_estimate: Estimate | None = None
        self._estimate: Estimate | None = None

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
        vars(localizer).update(state.localizer)
        vars(localizer.scan_matcher).update(state.scan_matcher)
        localizer._rng.bit_generator.state = dict(state.generator)
        if stood:
            localizer.scan_matcher.stood_still()
        return localizer

    @property
    def state(self) -> LocalizerState:
        """All that was learned so far; `resumed` goes on from it."""
        matcher = {name: value for name, value in vars(self.scan_matcher).items() if name != "settings"}
        own = {name: value for name, value in vars(self).items() if name not in FIXED}
        generator = self._rng.bit_generator.state
        return LocalizerState(fingerprint(self.atlas.sketch), own, matcher, generator, self._scale)

    @property
    def estimate(self) -> Estimate:
        """The last estimate; ValueError before the first update."""
        if self._estimate is None:
            raise ValueError("an estimate needs at least one scan, got none")
        return self._estimate

    def sample(self, count: int) -> Array:
        """Pick states of equally probable particles, for planning over all tracks, (6, count)."""
        return self.tracks.particles.picked(count)

    def explain(self) -> Explanation:
        """Tell which drawn walls speak for the best place of now, and which against.

        ValueError before the first update.
        """
        estimate = self._keyframe_estimate
        if estimate is None:
            raise ValueError("an explanation needs at least one scan, got none")
        least = Simplification(self.settings.atlas.detail * self.atlas.sketch.diagonal)
        walls = segments_of(simplify_all(self.atlas.sketch.strokes, least))
        keyframes = choose_keyframes(self._window, SCANS)
        return explain(estimate.place, estimate.sketch_from_base, keyframes, walls, self._model)

    def update(self, scan: LaserScan, odometry: Odometry) -> Estimate:
        """Take one scan in, give one estimate out."""
        seen = self.scan_matcher.update(scan, odometry)  # 2.1, 2.2, 3.3: the robot's side, knows no drawing
        first = self._motion is None
        motion = seen.last_from_base if self._motion is None else self._motion @ seen.last_from_base
        if first or self.settings.is_keyframe_due(motion):
            self.add_keyframe(observe(scan, seen.shapes, motion))
            motion = Pose2.identity()
        else:
            assert self._keyframe_estimate is not None
            self._estimate = replace(self._keyframe_estimate.moved(motion, self.atlas), stamp=scan.stamp)
        self._motion = motion
        return self.estimate

    def add_keyframe(self, seen: Observation) -> Estimate:
        """Propagate and reweight all tracks, let new ones be born, and sum up.

        `update` calls it. Who compares one log with many drawings may give them the same observations.
        """
        settings, is_first = self.settings, not self._window
        scan, motion = seen.scan, seen.motion
        self._window = append_keyframe(self._window, seen)
        particles, log_null = self.tracks.particles, self.tracks.log_null
        if not is_first:
            particles = propagate(particles, motion, self.atlas, self._prior, self._rng)
            distance = math.hypot(motion.x, motion.y)
            particles, log_null = leave(
                particles, log_null, settings.tracks.leaving * distance * math.exp(self._log_told)
            )
        log_ratio = self._window[-1].novelty * self._model.log_ratio(particles.states, scan)
        particles, log_null = self._weighed(particles, log_null, log_ratio)
        share = 0.0 if is_first else self._search_effort()
        if share > 0.0:
            particles = join([particles, self._births(share)])
        self.tracks = cluster(particles, log_null, self.atlas, settings.tracks, self._rng)
        self._keyframe_estimate = self._summary(self._fit(scan), seen.stamp)
        self._estimate = self._keyframe_estimate
        return self._estimate

    def add_blocked_way(self, way: BlockedWay) -> None:
        """Weigh all tracks by a way that the robot found blocked, in its frame at the last update.

        A way that was found blocked before, over the last metres, is not counted again.
        """
        if self._motion is None:
            raise ValueError("a blocked way needs a scan before it, got none")
        last = self._keyframe_estimate
        assert last is not None
        window = append_blocked_way(self._window, way.moved(self._motion))
        if window is self._window:
            return
        self._window = window
        particles = self.tracks.particles
        log_ratio = log_ratio_of_ways(particles.states, window[-1].blocked[-1:], self.atlas)
        particles, log_null = self._weighed(particles, self.tracks.log_null, log_ratio)
        self.tracks = cluster(particles, log_null, self.atlas, self.settings.tracks, self._rng)
        self._keyframe_estimate = self._summary(last.fit, last.stamp)
        now = self._keyframe_estimate.moved(self._motion, self.atlas)
        self._estimate = replace(now, stamp=self.estimate.stamp)

    def _weighed(self, particles: Particles, log_null: float, log_ratio: Array) -> tuple[Particles, float]:
        """Multiply weights by likelihood ratios (n,) to the null model, normalize, and note the evidence."""
        weighed = Particles(particles.states, particles.log_weights + log_ratio)
        weighed, log_null, log_total = normalized(weighed, log_null)
        self.log_evidence += log_total
        totals = (*self._log_totals, (self._window[-1].travel, log_total))
        self._log_totals = tuple(one for one in totals if one[0] >= self._window[0].travel)
        return weighed, log_null

    def _summary(self, fit: float, stamp: float) -> Estimate:
        """Sum up what the tracks say at the newest keyframe."""
        return summarize(self.tracks, fit, stamp, self._window[-1].travel, self.atlas)

    def _search_effort(self) -> float:
        """Return the share of the proposals that a search tries at this keyframe; 0 for no search.

        All are tried at every keyframe until the place is settled.
        """
        assert self._keyframe_estimate is not None
        if self._keyframe_estimate.probability < SETTLED:
            return 1.0
        is_due = self._window[-1].travel - self._searched >= SETTLED_EVERY
        return SETTLED_PROPOSALS if is_due else 0.0

    def _births(self, share: float) -> Particles:
        """Let tracks be born where a search of the whole drawing explains the last metres (3.4).

        A birth says that the robot was carried there, or was on no drawn place, when the window began. Its
        mass is the evidence of the window there, over the evidence that all tracks together had since.
        """
        settings, travel = self.settings, self._window[-1].travel
        distance = max(travel - self._searched, MIN_CARRIED)
        self._searched = travel
        count = round(share * settings.proposals)
        found = global_search(self._window, self._model, self._prior, count, self._rng)
        since = sum(log_total for _, log_total in self._log_totals[1:])
        log_prior = math.log(rare(settings.tracks.moving * distance)) + self._log_told
        return found.resampled(BIRTH_COUNT, self._rng).plus(log_prior - since)

    def _fit(self, scan: SparseScan) -> float:
        """Average the fit at the leading track over the last keyframes."""
        if not self.tracks.tracks:
            return 0.0
        leading = self.tracks.tracks[0].particles
        state = leading.states[:, int(leading.log_weights.argmax())]
        self._fits = (*self._fits, self._model.fit(state, scan))[-FIT_MEMORY:]
        return sum(self._fits) / len(self._fits)

    def _first_tracks(self, start: Sequence[float] | None) -> Tracks:
        """Draw particles before the first scan."""
        settings = self.settings.tracks
        log_null = math.log(settings.first_null) + self._log_told
        if start is None:
            states = draw_anywhere(self.atlas, self._prior, settings.first_count, self._rng)
        else:
            in_file = Pose2(start[0], start[1], start[2] if len(start) > 2 else 0.0)
            pose = self.atlas.sketch.file_axes.pose_to_sketch(in_file)
            heading_std = self._prior.given_heading if len(start) > 2 else math.pi
            states = draw_near(
                pose, self.atlas, self._prior, settings.max_count, self._rng, heading_std=heading_std
            )
        particles = Particles(states, np.full(states.shape[1], -math.log(states.shape[1])))
        particles, log_null, _ = normalized(particles.plus(math.log1p(-math.exp(log_null))), log_null)
        return Tracks((Track(particles),), log_null)
