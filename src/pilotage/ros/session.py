"""One robot on one drawing: readings, starts and goals in; beliefs and commands out. It knows no network."""

import math
from dataclasses import dataclass, replace
from pathlib import Path

from pilotage.correction import CorrectedDrawing, Sighting, append_sighting
from pilotage.errors import PilotageError
from pilotage.geometry import Pose2, Twist
from pilotage.io.bags.belief import Belief, MapFrame, known_scale
from pilotage.io.bags.bent_frame import BentFrame
from pilotage.io.state import SavedState, save_state
from pilotage.localization import Estimate, Localizer, LocalizerSettings, Status
from pilotage.maps import Atlas
from pilotage.navigation import Navigator, NavigatorSettings, Step, Tour
from pilotage.navigation.dead_reckoning import DeadReckoning
from pilotage.navigation.plan import Plan
from pilotage.navigation.steering import STILL
from pilotage.perception import LaserScan, Odometry, Reading

SETTLED = 0.9
"""Probability of a place at which the scale there becomes that of the frame `map`, for good."""

OTHER_SCALE = 0.02
"""Logarithm of the ratio by which a scale must differ for the frame `map` to be changed: 2 %."""

MOST_SIGHTINGS, LATEST = 2000, 500
"""Sightings that are kept, a kilometre; if there are more, every second of all but the latest is dropped."""

AGREEING = 1.5
"""Distance [m] within which the localizer and the path of the correction tell the same place."""

Goal = str | tuple[float, float] | Tour


@dataclass(frozen=True, eq=False)
class Told:
    """What came of a reading."""

    belief: Belief
    map_from_odom: Pose2
    command: Twist
    scan: LaserScan  # that it was made of
    step: Step | None  # None without a goal


class Session:
    """Localizes a robot, and drives it to a goal if it has one; raises as `Localizer` and `Navigator` do."""

    def __init__(
        self,
        atlas: Atlas,
        settings: tuple[LocalizerSettings, NavigatorSettings],
        *,
        seed: int = 0,
        start: tuple[float, float, float] | None = None,
        scale: float | None = None,
        resumed: SavedState | None = None,
        keeps_sightings: bool = False,
    ) -> None:
        self._anchor: tuple[Pose2, Pose2] | None = None  # odom_from_base of scan matching, and map_from_base
        self._keeps_sightings = keeps_sightings
        self.sightings: list[Sighting] = []  # by which the drawing can be corrected, if they are kept
        self.sightings_began = 0  # how often they were begun anew, or made fewer
        self._settings, self._seed, self._scale = settings, seed, scale
        self._blocked: tuple[str, ...] = ()
        if resumed is None:
            self._localizer = Localizer(atlas, settings[0], seed=seed, start=start, scale=scale)
        else:
            self._localizer = Localizer.resumed(
                atlas, resumed.localizer, settings[0], scale=scale, stood=True
            )
            self.sightings += resumed.sightings
            if atlas.joined is not None:  # other settings may have divided the drawing otherwise
                ids = atlas.joined.graph.gateway_ids
                self._blocked = tuple(one for one in resumed.blocked if one in ids)
        self.atlas = self._localizer.atlas
        self._navigator: Navigator | None = None
        self._reckoning = DeadReckoning(self._localizer)
        known = known_scale(atlas.sketch, scale)
        self.frame = MapFrame(atlas.sketch, math.exp(self.atlas.log_scale) if known is None else known)
        self._is_settled = known is not None
        self._shift, self._last_stamp = 0.0, -math.inf  # [s] so that time never runs backwards in here
        self.goal: Goal | None = None

    @property
    def has_seen(self) -> bool:
        """Whether a scan was taken in."""
        return self._last_stamp > -math.inf

    def save(self, path: Path) -> None:
        """Save what is believed, blocked gateways and sightings; raises FileError if that fails."""
        save_state(path, self._localizer, self.blocked, self.sightings)

    @property
    def blocked(self) -> tuple[str, ...]:
        """The ids of the gateways that were found blocked on this drive, or else on the last."""
        return self._blocked if self._navigator is None else self._navigator.blocked

    @property
    def position(self) -> DeadReckoning:
        """Where the robot is believed to be, at every scan."""
        return self._reckoning if self._navigator is None else self._navigator.position

    @property
    def plan(self) -> Plan | None:
        """What the robot does; None without a goal."""
        return None if self._navigator is None else self._navigator.plan

    def forget_blocked(self) -> None:
        """Take all gateways as open again."""
        self._blocked, self._navigator = (), None

    def set_goal(self, goal: Goal | None) -> str:
        """Drive there from now on, or stop; return why not if it cannot be, else nothing."""
        if goal is None:
            self._blocked = self.blocked
            self.goal, self._navigator = None, None
            self._reckoning = DeadReckoning(self._localizer)
            return ""
        try:
            self._navigator = Navigator(self._localizer, goal, self._settings[1], blocked=self.blocked)
        except (PilotageError, ValueError) as error:
            return f"{goal} is no goal: {error}"
        self.goal = goal
        return ""

    def set_start(self, pose: Pose2) -> str:
        """Begin anew at a pose of the frame `map`; return why not if it cannot be, else nothing."""
        return self.begin_at(self.frame.to_file(pose))

    def begin_at(self, start: tuple[float, float, float]) -> str:
        """Begin anew at x, y and heading in the axes of the drawing's file; return why not, else nothing."""
        try:
            self._localizer = Localizer(
                self.atlas, self._settings[0], seed=self._seed, start=start, scale=self._scale
            )
        except (PilotageError, ValueError) as error:
            return f"this is no start: {error}"
        self._reckoning = DeadReckoning(self._localizer)
        self.sightings.clear()  # they are in the frame of the scan matching of before
        self.sightings_began += 1
        self._anchor = None
        return self.set_goal(self.goal)

    def correct(self, corrected: CorrectedDrawing, count: int) -> None:
        """Take the drawing as it was corrected by the first `count` sightings: `map` is then in metres."""
        frame = BentFrame.after(self.frame, corrected, self.sightings[:count])
        last = Pose2(*corrected.path[-1].tolist())
        self._anchor = self.sightings[count - 1].odom_from_base, frame.map_from_metres @ last
        self.frame = frame
        self._is_settled = True

    def goal_at(self, pose: Pose2) -> tuple[float, float]:
        """Return a pose of the frame `map` as a goal."""
        x, y, _ = self.frame.to_file(pose)
        return x, y

    def update(self, reading: Reading) -> Told:
        """Take a reading in."""
        scan, odometry = self._in_our_time(reading)
        step = None
        if self._navigator is not None:
            step = self._navigator.step(scan, odometry)
            estimate = self._navigator.position.estimate
        else:
            self._reckoning.update(scan, odometry)
            estimate = self._reckoning.estimate
        if self._keeps_sightings and self.position.is_fresh:
            append_sighting(self.sightings, self._localizer, scan)
            if len(self.sightings) > MOST_SIGHTINGS:
                self.sightings[:-LATEST] = self.sightings[:-LATEST:2]
                self.sightings_began += 1
        self._settle(estimate)
        belief = Belief.of_estimate(estimate, self.frame, reading.scan.stamp)
        if self._anchor is not None and estimate.status is Status.LOCATED:
            first, *others = belief.places
            belief = replace(belief, places=(replace(first, pose=self._followed(first.pose)), *others))
        if step is not None:
            told = {"behavior": step.behavior.value, "outcome": step.outcome.value if step.outcome else ""}
            belief = replace(belief, values={**belief.values, **told, "reason": step.reason})
        map_from_odom = belief.pose @ reading.odometry.odom_from_base.inverse()
        return Told(belief, map_from_odom, STILL if step is None else step.command, scan, step)

    def _followed(self, estimate: Pose2) -> Pose2:
        """Return where the robot is in `map` by the path of the correction, or the estimate if they disagree.

        That path lies on the corrected walls more exactly than the localizer's place on the drawing does.
        """
        assert self._anchor is not None
        odom_then, map_then = self._anchor
        followed = map_then @ odom_then.inverse() @ self.position.odom_from_base
        off = math.hypot(followed.x - estimate.x, followed.y - estimate.y)
        return followed if off < AGREEING else estimate

    def _in_our_time(self, reading: Reading) -> tuple[LaserScan, Odometry]:
        """Shift stamps where the robot's clock was set back."""
        stamp = reading.scan.stamp + self._shift
        if stamp < self._last_stamp:
            self._shift += self._last_stamp - stamp
            stamp = self._last_stamp
        self._last_stamp = stamp
        if self._shift == 0.0:
            return reading.scan, reading.odometry
        return replace(reading.scan, stamp=stamp), replace(reading.odometry, stamp=stamp)

    def _settle(self, estimate: Estimate) -> None:
        """Give the frame `map` the scale of the first place that is sure; it then stays."""
        if self._is_settled or estimate.probability < SETTLED:
            return
        self._is_settled = True
        if abs(math.log(estimate.scale / self.frame.scale)) > OTHER_SCALE:
            self.frame = MapFrame(self.atlas.sketch, estimate.scale)
