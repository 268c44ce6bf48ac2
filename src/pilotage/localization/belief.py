"""All that a localizer believes, as one value: an update makes a new one or, if it fails, leaves the old."""

from dataclasses import dataclass, field, replace

from pilotage.geometry import Pose2
from pilotage.localization.estimate import Estimate
from pilotage.localization.keyframes import Keyframe
from pilotage.localization.particle_filter import Posterior
from pilotage.maps import Atlas


@dataclass(frozen=True, eq=False)
class Belief:
    """Where the robot may be, and what was seen on the way there."""

    posterior: Posterior
    log_elsewhere: float = 0.0  # log-evidence of other buildings, since the first scan [nats]
    window: tuple[Keyframe, ...] = ()
    fits: tuple[float, ...] = ()  # at the last keyframes
    at_keyframe: Estimate | None = None  # the estimate at the newest keyframe; None before the first scan
    motion: Pose2 = field(default_factory=Pose2.identity)  # since then [m, rad]
    estimate: Estimate | None = None  # the same, carried along by this motion

    @property
    def log_evidence(self) -> float:
        """The log-evidence of the drawing over that of other buildings, since the first scan [nats]."""
        return self.posterior.log_evidence_of_places - self.log_elsewhere

    def moved(self, motion: Pose2, stamp: float, atlas: Atlas) -> "Belief":
        """Carry the estimate along by a motion since the last keyframe, of which there is one."""
        assert self.at_keyframe is not None
        estimate = replace(self.at_keyframe.moved(motion, atlas), stamp=stamp)
        return replace(self, motion=motion, estimate=estimate)
