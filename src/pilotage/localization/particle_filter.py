"""A clustered particle filter on one drawing: what follows from a keyframe, given what was held before it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from pilotage.geometry import Pose2
from pilotage.localization.blocked_way import log_ratio_of_ways
from pilotage.localization.global_search import global_search
from pilotage.localization.keyframes import WINDOW, Keyframe
from pilotage.localization.motion_model import propagate
from pilotage.localization.particles import Particles, join
from pilotage.localization.prior import Prior, draw_anywhere, draw_near
from pilotage.localization.sensor_model import SensorModel
from pilotage.localization.tracks import (
    Track,
    Tracks,
    TrackSettings,
    as_one,
    cluster,
    leave,
    normalized,
    rare,
)

CARRIED = 0.2
"""Probability that the robot was carried where a scan shows another place than those before."""
MIN_TRAVEL = 0.05
"""[m] of travel since a search that counts at least: a robot that only turns may be elsewhere, too."""


@dataclass(frozen=True, eq=False)
class Posterior:
    """Where the robot may be on a drawing after a keyframe, and how well the drawing explained the way."""

    tracks: Tracks
    log_told: float = 0.0  # [nats] added to the log-probabilities of leaving and of being carried
    log_evidence: float = 0.0  # of all tracks over that of any ranges, since the first scan [nats]
    log_totals: tuple[tuple[float, float], ...] = ()  # travel [m] and log-evidence of keyframes of the window
    searched: float = 0.0  # [m] of travel at the last search

    @property
    def log_evidence_of_places(self) -> float:
        """The log-evidence of all places of this drawing together, without the null track [nats]."""
        return self.log_evidence + self.tracks.particles.log_mass

    def with_evidence(self, window: tuple[Keyframe, ...], log_total: float) -> "Posterior":
        """Add the log-evidence of what is new in a window."""
        totals = (*self.log_totals, (window[-1].travel, log_total))
        kept = tuple(one for one in totals if one[0] >= window[0].travel)
        return replace(self, log_totals=kept, log_evidence=self.log_evidence + log_total)


@dataclass(frozen=True, eq=False)
class ParticleFilter:
    """A drawing, and how its particles move, are weighed and are born."""

    model: SensorModel
    prior: Prior
    settings: TrackSettings
    proposals: int  # places that a whole search tries
    births: int  # particles that a search gives birth to
    clustered: bool = True  # whether places compete as tracks; else only the evidence of all is asked for

    def first(self, start: Sequence[float] | None, rng: np.random.Generator) -> Posterior:
        """Draw particles before the first scan: anywhere, or where the robot is said to `start`.

        `start` is x, y and perhaps a heading [rad], in the drawing's own units and axes.
        """
        atlas, prior, settings = self.model.atlas, self.prior, self.settings
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
        return Posterior(Tracks((Track(particles),), log_null), log_told)

    def updated(
        self,
        before: Posterior,
        window: tuple[Keyframe, ...],
        motion: Pose2,
        rng: np.random.Generator,
        *,
        effort: float,
    ) -> Posterior:
        """Move and weigh all tracks by the newest keyframe, after this motion, and let new ones be born.

        `effort` is the share of the proposals that a search tries, 0 for no search.
        """
        keyframe = window[-1]
        particles, log_null = before.tracks.particles, before.tracks.log_null
        if before.log_totals:
            particles = propagate(particles, motion, self.model.atlas, self.prior, rng)
            leaving = self.settings.leaving * math.hypot(motion.x, motion.y) * math.exp(before.log_told)
            particles, log_null = leave(particles, log_null, CARRIED if keyframe.was_carried else leaving)
        log_ratio = keyframe.novelty * self.model.log_ratio(particles.states, keyframe.scan)
        particles, log_null, log_total = normalized(particles.scaled(log_ratio), log_null)
        since = replace(before, log_totals=()) if keyframe.was_carried else before
        after = since.with_evidence(window, log_total)
        if effort > 0.0:
            count = round(effort * self.proposals)
            found = global_search(window, self.model, self.prior, count, rng).resampled(self.births, rng)
            particles = join([particles, found.scaled(log_birth_factor(after, window, self.settings))])
            after = replace(after, searched=keyframe.travel)
        return replace(after, tracks=self.gathered(particles, log_null, rng))

    def with_blocked_way(
        self, before: Posterior, window: tuple[Keyframe, ...], rng: np.random.Generator
    ) -> Posterior:
        """Weigh all tracks by the way that was found blocked last."""
        particles = before.tracks.particles
        log_ratio = log_ratio_of_ways(particles.states, window[-1].blocked[-1:], self.model.atlas)
        particles, log_null, log_total = normalized(particles.scaled(log_ratio), before.tracks.log_null)
        return replace(
            before.with_evidence(window, log_total), tracks=self.gathered(particles, log_null, rng)
        )

    def gathered(self, particles: Particles, log_null: float, rng: np.random.Generator) -> Tracks:
        """Split particles into tracks, and give each as many as it needs; all masses sum to 1 after it."""
        if self.clustered:
            return cluster(particles, log_null, self.model.atlas, self.settings, rng)
        return as_one(particles, log_null, self.settings.max_count, rng)


def log_birth_factor(posterior: Posterior, window: tuple[Keyframe, ...], settings: TrackSettings) -> float:
    """Return what the log-mass of a birth adds to the log-evidence there of a searched window [nats].

    A birth says that the robot was carried there before the window began, and no track knows it. By Bayes'
    rule its mass is the prior of that, times the evidence of the window there, over the evidence that all
    tracks together had since. That of the first keyframe is left out: a search weighs a window by a few of
    its keyframes, so births are weak already, and with it fewer runs ended right (decision 0023). The prior
    is shared among the searches.
    """
    distance = max(window[-1].travel - posterior.searched, MIN_TRAVEL)
    if window[0].was_carried:
        log_prior = math.log(CARRIED * distance / WINDOW)
    else:
        log_prior = math.log(rare(settings.moving * distance)) + posterior.log_told
    return log_prior - sum(log_total for _, log_total in posterior.log_totals[1:])
