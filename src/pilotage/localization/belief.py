"""All that a localizer believes, as one value: an update makes a new one or, if it fails, leaves the old."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from pilotage.geometry import Pose2
from pilotage.localization.estimate import Estimate
from pilotage.localization.keyframes import Keyframe
from pilotage.localization.particles import Particles
from pilotage.localization.prior import Prior, draw_anywhere, draw_near
from pilotage.localization.tracks import Track, Tracks, TrackSettings, normalized
from pilotage.maps import Atlas


@dataclass(frozen=True, eq=False)
class Belief:
    """Where the robot may be, and what was seen on the way there."""

    tracks: Tracks
    log_told: float = 0.0  # [nats] added to the log-probabilities of leaving and of being carried
    window: tuple[Keyframe, ...] = ()
    log_evidence: float = 0.0  # of this drawing over that of any building, since the first scan
    log_totals: tuple[tuple[float, float], ...] = ()  # travel [m] and log-evidence of keyframes of the window
    fits: tuple[float, ...] = ()  # at the last keyframes
    searched: float = 0.0  # [m] of travel at the last search
    at_keyframe: Estimate | None = None  # the estimate at the newest keyframe; None before the first scan
    motion: Pose2 = field(default_factory=Pose2.identity)  # since then [m, rad]
    estimate: Estimate | None = None  # the same, carried along by this motion

    def with_evidence(self, window: tuple[Keyframe, ...], log_total: float) -> "Belief":
        """Take in a window, and the log-evidence of what is new in it."""
        totals = (*self.log_totals, (window[-1].travel, log_total))
        kept = tuple(one for one in totals if one[0] >= window[0].travel)
        return replace(self, window=window, log_totals=kept, log_evidence=self.log_evidence + log_total)

    def moved(self, motion: Pose2, stamp: float, atlas: Atlas) -> "Belief":
        """Carry the estimate along by a motion since the last keyframe, of which there is one."""
        assert self.at_keyframe is not None
        estimate = replace(self.at_keyframe.moved(motion, atlas), stamp=stamp)
        return replace(self, motion=motion, estimate=estimate)


def first_belief(
    start: Sequence[float] | None,
    atlas: Atlas,
    prior: Prior,
    settings: TrackSettings,
    rng: np.random.Generator,
) -> Belief:
    """Draw particles before the first scan: anywhere, or where the robot is said to `start`.

    `start` is x, y and perhaps a heading [rad], in the drawing's own units and axes.
    """
    log_told = 0.0 if start is None else -settings.told_log_odds
    log_null = math.log(settings.first_null) + log_told
    if start is None:
        states = draw_anywhere(atlas, prior, settings.first_count, rng)
    else:
        in_file = Pose2(start[0], start[1], start[2] if len(start) > 2 else 0.0)
        pose = atlas.sketch.file_axes.pose_to_sketch(in_file)
        heading_std = prior.given_heading if len(start) > 2 else math.pi
        states = draw_near(pose, atlas, prior, settings.max_count, rng, heading_std=heading_std)
    on_drawing = math.log1p(-math.exp(log_null)) - math.log(states.shape[1])
    particles = Particles(states, np.full(states.shape[1], on_drawing))
    particles, log_null, _ = normalized(particles, log_null)
    return Belief(Tracks((Track(particles),), log_null), log_told)
