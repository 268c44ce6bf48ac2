"""Scan in, estimate out: the whole of section 3 on one screen."""

import math
from dataclasses import dataclass, field, replace

import numpy as np

from pilotage.geometry import Affine2, Array, Pose2
from pilotage.localization.alignment import (
    AlignmentSettings,
    View,
    align,
    corners_in_base,
    extend_views,
    trust_in,
)
from pilotage.localization.belief import Belief
from pilotage.localization.estimate import Estimate as RawEstimate
from pilotage.localization.estimate import (
    EstimateSettings,
    Hypothesis,
    agreement,
    area_of,
    defended,
    defended_confidence,
    distance_between,
    estimate_from,
    find_places,
    share_at,
    steady_confidence,
)
from pilotage.localization.incumbent import Incumbent, IncumbentSettings, gain_of, incumbent_at
from pilotage.localization.placement import Placement, place_at
from pilotage.localization.pose_hypothesis import Estimate, PoseHypothesis
from pilotage.localization.proposals import propose_anywhere, propose_by_corners, propose_near
from pilotage.localization.tracking import TrackingSettings, predict, thin, weigh
from pilotage.localization.visibility import Look, VisibilityModel, VisibilitySettings, look
from pilotage.maps import Atlas, AtlasSettings, SchematicMap, build_atlas
from pilotage.perception import LaserScan, Odometry
from pilotage.scan_matching import ScanMatcher, ScanMatchingSettings
from pilotage.shape import PartialShape, Simplification, simplify_all
from pilotage.shape.corners import find_corners


@dataclass(frozen=True, slots=True)
class LocalizerSettings:
    """The settings of all stages, and how often belief is weighed."""

    atlas: AtlasSettings = field(default_factory=AtlasSettings)
    scan_matching: ScanMatchingSettings = field(default_factory=ScanMatchingSettings)
    features: Simplification = field(default_factory=lambda: Simplification(min_relevance=0.08))  # [rad·m]
    visibility: VisibilitySettings = field(default_factory=VisibilitySettings)
    alignment: AlignmentSettings = field(default_factory=AlignmentSettings)
    tracking: TrackingSettings = field(default_factory=TrackingSettings)
    incumbent: IncumbentSettings = field(default_factory=IncumbentSettings)
    estimate: EstimateSettings = field(default_factory=EstimateSettings)
    step: float = 0.5  # [m] belief is weighed anew once the robot has moved this far
    turn: float = math.radians(20.0)  # [rad] or turned so much
    new_turn: float = math.radians(60.0)  # [rad] of a turn on the spot after which a look counts in full

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        for name in ("step", "turn", "new_turn"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be > 0, got {getattr(self, name)}")

    def is_due(self, motion: Pose2) -> bool:
        """Tell whether a robot that moved so since the last look sees anything new."""
        return math.hypot(motion.x, motion.y) >= self.step or abs(motion.theta) >= self.turn

    def news_in(self, motion: Pose2) -> float:
        """Return the share of a look that is news after such a motion, [0..1]: half a step, half as much."""
        return min(math.hypot(motion.x, motion.y) / self.step + abs(motion.theta) / self.new_turn, 1.0)


class Localizer:
    """Finds where on a drawing a robot is, scan by scan; the one place that holds state.

    Give it a drawing, or an atlas that was built of one before. `start` is a pose in the sketch (y up),
    `scale` drawing units per metre; without them the robot may be anywhere, at any heading, and the drawing
    of any scale. Raises ValueError if these cannot be meant.
    """

    def __init__(
        self,
        drawing: SchematicMap | Atlas,
        settings: LocalizerSettings | None = None,
        *,
        seed: int = 0,
        start: Pose2 | tuple[float, ...] | None = None,
        scale: float | None = None,
    ) -> None:
        self.settings = settings if settings is not None else LocalizerSettings()
        if scale is not None and not (scale > 0.0 and math.isfinite(scale)):
            raise ValueError(f"scale must be positive and finite, got {scale}")
        self._rng = np.random.default_rng(seed)
        self.atlas = drawing if isinstance(drawing, Atlas) else build_atlas(drawing, self.settings.atlas)
        tracking = self.settings.tracking
        if isinstance(start, tuple):
            x, y = self.atlas.sketch.sketch_from_file(np.array([start[:2]], dtype=np.float64))[0].tolist()
            if len(start) == 2:
                tracking = replace(tracking, prior=replace(tracking.prior, known_heading=math.pi))
            start = Pose2(x, y, start[2] if len(start) > 2 else 0.0)
        if scale is not None:
            self.atlas = replace(self.atlas, log_scale=math.log(scale))
            tracking = replace(
                tracking, prior=replace(tracking.prior, log_scale=tracking.prior.known_log_scale)
            )
        self._tracking = tracking
        self._model = VisibilityModel(self.atlas, self.settings.visibility)
        self.scan_matcher = ScanMatcher(self.settings.scan_matching)
        states = self._first_states(start)
        self.belief = Belief(states, np.zeros(states.shape[1]))
        self._motion: Pose2 | None = None  # since belief was last weighed; None before the first scan
        self._views: tuple[View, ...] = ()
        self._places: tuple[Hypothesis, ...] = ()
        self._placement: Placement | None = None
        self._search_due = False
        self._incumbent: Incumbent | None = None  # whose belief is believed, if not this one
        if start is not None:
            worth = self.settings.incumbent.told
            own = self.belief.resampled(self.settings.incumbent.count, self._rng)
            self._incumbent = Incumbent(own, 1.0, odds=worth, stake=worth)
        self._confidence = 0.0 if start is None else 1.0

    def update(self, scan: LaserScan, odometry: Odometry) -> Estimate:
        """Take one scan in, give one estimate out."""
        settings = self.settings
        seen = self.scan_matcher.update(scan, odometry)  # 2.1, 2.2, 3.3
        motion = self._motion @ seen.last_from_base if self._motion else Pose2.identity()
        if self._motion is None or settings.is_due(motion):
            if self._search_due:
                self._search()
            self._weigh(scan, seen.shapes, motion)
            self._search_due = self._motion is not None and not settings.is_due(seen.last_from_base)
            if not self._search_due:
                self._search()
            self._settle(motion)
            motion = Pose2.identity()
        elif self._search_due:  # where scans come close together, the next one has time for it
            self._search()
            self._search_due = False
        self._motion = motion
        raw = estimate_from(self._moved_places(motion), self._confidence, scan.stamp, settings.estimate)
        self.estimate = self._offered(raw)
        return self.estimate

    def _offered(self, raw: RawEstimate) -> Estimate:
        """Offer an estimate."""
        placement = self.placement
        affine = Affine2.from_state(*placement.state.tolist())
        a, b = placement.axis.tolist()
        leading = PoseHypothesis(raw.cell_id, affine, raw.hypotheses[0].probability, placement.spread, (a, b))
        others = tuple(
            PoseHypothesis(
                one.cell_id,
                Affine2(
                    one.sketch_from_base.scale * one.sketch_from_base.pose.rotation,
                    one.sketch_from_base.pose.position,
                ),
                one.probability,
            )
            for one in raw.hypotheses[1:]
        )
        graph, pose, y_down = self.atlas.cell_graph, affine.pose, self.atlas.sketch.y_down
        label = graph.cell(raw.cell_id).label if graph is not None and raw.cell_id else ""
        return Estimate(
            raw.stamp, raw.status, (leading, *others), self.belief_in(raw.cell_id), 1.0, label or raw.cell_id,
            pose.x, -pose.y if y_down else pose.y, pose.theta, affine.scale, y_down, raw.confidence,
        )  # fmt: skip

    def sample(self, count: int) -> Array:
        """Pick equally probable particles, (6, count)."""
        return self.believed.picked(count)

    @property
    def scan_matcher(self) -> PerceptionMap:
        """The state of scan matching."""
        return self.perception_map

    @property
    def placement(self) -> Placement:
        """Where in its surroundings the robot stands at the most probable place; after the first update."""
        if self._placement is None or self._motion is None:
            raise ValueError("a placement needs at least one scan, got none")
        return self._placement.moved(self._motion)

    @property
    def believed(self) -> Belief:
        """The belief that is believed: the incumbent's, if there is one."""
        return self.belief if self._incumbent is None else self._incumbent.belief

    def belief_in(self, cell_id: str) -> float:
        """Return the probability that the robot was in this cell at the last look, wherever in it."""
        inside = self.atlas.are_in((cell_id,), self.believed.states[:2].T)
        return float(self.believed.weights[inside].sum())

    def _weigh(self, scan: LaserScan, shapes: tuple[PartialShape, ...], motion: Pose2) -> None:
        """Carry belief along, and weigh it by what is seen now."""
        settings = self.settings
        seen = look(scan, settings.visibility)
        features = simplify_all([shape.polyline for shape in shapes], settings.features)
        corners = find_corners(features)
        self._views = extend_views(self._views, motion, seen, corners, settings.alignment.window)
        news = settings.news_in(motion) if self._places else 1.0
        weighed = self._weighed(self.belief, motion, seen, news)
        incumbent = self._incumbent
        if incumbent is not None:
            own = self._weighed(incumbent.belief, motion, seen, news)
            gain = gain_of((self.belief, weighed), (incumbent.belief, own))
            own = thin(own, self._tracking, self._rng)
            self._incumbent = incumbent.contested(own, gain, settings.incumbent)
        self.belief = thin(weighed, self._tracking, self._rng)

    def _weighed(self, belief: Belief, motion: Pose2, seen: Look, news: float) -> Belief:
        """Move belief and weigh it by a look."""
        moved = predict(belief, motion, self.atlas, self._tracking, self._rng)
        return weigh(moved, seen, self._model, news=news)

    def _settle(self, motion: Pose2) -> None:
        """Gather belief into places, and see where in its surroundings the robot stands at the first."""
        settings, carried = self.settings.estimate, self._moved_places(motion)
        incumbent = self._incumbent
        if incumbent is not None and incumbent.is_beaten:
            incumbent = None
        places = find_places(self.belief, self.atlas, settings)
        diagonal = self.atlas.sketch.diagonal / places[0].sketch_from_base.scale  # [m]
        way = math.hypot(motion.x, motion.y) / diagonal
        if incumbent is not None:
            agreed = agreement(self.belief, incumbent.belief, self.atlas, settings)
            is_led = incumbent.lead > 0.0
            worth = defended_confidence(incumbent.confidence, agreed, way, settings, is_led=is_led)
            incumbent = replace(incumbent, confidence=worth)
            own = find_places(incumbent.belief, self.atlas, replace(settings, hypotheses=1))[0]
            share = share_at(own, self.belief, settings)
            self._confidence = defended_confidence(self._confidence, share, way, settings, is_led=is_led)
            probability = max(share, self._confidence * incumbent.credit)
            places = defended(own, probability, share, places, settings)
        elif carried:
            jump = distance_between(places[0], carried[0])
            share = places[0].probability
            self._confidence = steady_confidence(self._confidence, share, jump, way, settings)
        self._places = places
        self._incumbent = incumbent or incumbent_at(
            places[0], self.belief, self._confidence, self.settings.incumbent, self._rng
        )
        at = places[0].sketch_from_base.pose
        self._placement = place_at(self.believed, (at.x, at.y), settings.jump)

    def _search(self) -> None:
        """Hold belief against a search of the drawing, and let it have a share where it explains as much."""
        settings, rng = self.settings, self._rng
        fresh = align(self._views, self._proposals(), self._model, settings.alignment, rng)
        sample = self.belief.resampled(len(fresh), rng).states
        share = trust_in(fresh, sample, self._views, self._model, settings.alignment)
        area = area_of(self.belief, self.atlas, settings.estimate)
        count = self._tracking.count_for(area, len(self.belief))
        self.belief = self.belief.mixed(fresh, share, count, rng)

    def _first_states(self, start: Pose2 | None) -> Array:
        """Draw hypotheses before the first scan."""
        tracking = self._tracking
        if start is None:
            return propose_anywhere(self.atlas, tracking.prior, tracking.first_count, self._rng)
        count = max(tracking.count, self.settings.incumbent.count)  # which are drawn from these
        return propose_near(start, self.atlas, tracking.prior, count, self._rng)

    def _proposals(self) -> Array:
        """Propose places for an alignment: half where corners agree, half anywhere."""
        count, prior = self.settings.alignment.proposals // 2, self._tracking.prior
        seen = corners_in_base(self._views)
        by_corners = propose_by_corners(seen, self.atlas, prior, count, self._rng)
        return np.hstack([by_corners, propose_anywhere(self.atlas, prior, count, self._rng)])

    def _moved_places(self, motion: Pose2) -> tuple[Hypothesis, ...]:
        """Carry the places on since they were found."""
        moved = []
        for place in self._places:
            sketch_from_base = place.sketch_from_base @ motion
            cell_id = self.atlas.cell_at((sketch_from_base.pose.x, sketch_from_base.pose.y))
            moved.append(Hypothesis(cell_id, sketch_from_base, place.probability))
        return tuple(moved)
