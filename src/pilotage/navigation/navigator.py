"""Scan in, command out: drives a robot to a goal on a drawing (Wolter 2001, section 4.2)."""

import math
from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np

from pilotage.errors import PilotageError
from pilotage.geometry import Twist
from pilotage.localization import Localizer
from pilotage.maps import RouteError
from pilotage.maps.routing.roadmap import Point
from pilotage.navigation.arrival import Doubt
from pilotage.navigation.behaviors import make_plan
from pilotage.navigation.dead_reckoning import DeadReckoning
from pilotage.navigation.goal import find_goal
from pilotage.navigation.local_grid import LocalGrid
from pilotage.navigation.memory import Memory
from pilotage.navigation.plan import Plan
from pilotage.navigation.planner import RoutePlanner
from pilotage.navigation.settings import NavigatorSettings
from pilotage.navigation.situation import Situation
from pilotage.navigation.steering import steer, turn, turn_on_the_spot
from pilotage.navigation.step import Behavior, Outcome, Place, Step
from pilotage.navigation.tour import HOME, Tour, tour_of
from pilotage.perception import LaserScan, Odometry

PLAN_EVERY = 0.3
"""Least time [s] between plans."""

TURNING = 0.7
"""Share of its fastest turn at which the robot looks around."""

BEHIND = 0.1
"""Obstacles less far ahead than this [m] are taken from the grid: a scanner may not see backwards."""

SLOWLY = 0.5
"""Share of its fastest speed at which the robot drives in a slow zone."""

SEEING = 0.05
"""Share of beams that return below which a far-seeing scanner counts as blind: it is covered, or broken."""

FAR_SEEING = 10.0
"""Range [m] of a scanner within which something always stands indoors."""

WAITING = 0.05
"""Turn rate [rad/s] below which a robot that does not drive is waiting."""


class Navigator:
    """Drives to a goal, or to several in order.

    A goal is the name of a room, reached anywhere in it, or a point in the drawing's own units and axes; a
    `Tour` holds several, and can go round and return. Each goal has the time limit of the settings. `blocked`
    are ids of gateways that were found blocked before. Raises RouteError if a goal cannot be reached on this
    drawing, NotEnclosedError if the drawing has no cells, ValueError if a point is not finite or an id is not
    of this drawing.
    """

    def __init__(
        self,
        localizer: Localizer,
        goal: Place | Sequence[Place] | Tour,
        settings: NavigatorSettings | None = None,
        *,
        blocked: Collection[str] = (),
    ) -> None:
        self.settings = settings if settings is not None else NavigatorSettings()
        self.tour = tour_of(goal)
        self.planner = self._first_planner(localizer)
        unknown = sorted(set(blocked) - self.planner.graph.gateway_ids)
        if unknown:
            raise ValueError(f"blocked must hold ids of gateways of this drawing, got {', '.join(unknown)}")
        self.zones = localizer.atlas.sketch.zones
        self.position = DeadReckoning(localizer)
        self.local_grid = LocalGrid.unknown()
        self.memory: Memory | None = None  # before the first scan
        self._blocked_before = tuple(blocked)
        self.plan = Plan(Behavior.LOOK_AROUND)
        self.home: Point | None = None  # where the drive began, once that is known; in the drawing's own axes

    @property
    def blocked(self) -> tuple[str, ...]:
        """The ids of the gateways that are blocked now."""
        return self._blocked_before if self.memory is None else self.memory.blocked.gateway_ids

    def step(self, scan: LaserScan, odometry: Odometry) -> Step:
        """Take one scan in, give one command out."""
        self.position.update(scan, odometry)  # which cell, and where in it
        self._find_home()
        self.local_grid = self.local_grid.seen(scan, self.position.odom_from_base)
        if self.memory is None:
            self.memory = Memory.at_start(scan, self.position.localized, self._blocked_before)
        if self.plan.outcome is None and self._is_due(scan.stamp, self.memory):
            self.memory = self.memory.updated(self.plan, scan.stamp, self.position, self.settings)
            if self.memory.blocked_way is not None and not self.zones.keep_out:  # else a zone may block it
                self.position.tell_blocked_way(self.memory.blocked_way)
            situation = self._situation(scan.stamp, self.memory)
            self.memory = situation.memory
            plan = make_plan(situation)
            self.plan = plan if plan.outcome is None else self._go_on(plan)
        return self._report(scan, *self._command(scan))

    def set_goal(self, goal: Place | Sequence[Place] | Tour) -> None:
        """Drive elsewhere from now on; what is believed and what was found blocked is kept.

        Raises as the constructor does, and then the old goal stays.
        """
        before, self.tour = self.tour, tour_of(goal)
        try:
            self.planner = self._first_planner(self.position.localizer)
        except (PilotageError, ValueError):
            self.tour = before
            raise
        self._forget(self.plan.stamp)
        self.plan = Plan(Behavior.LOOK_AROUND)

    def _first_planner(self, localizer: Localizer) -> RoutePlanner:
        """Look all goals up on the drawing, and return the planner of the first."""
        first, *others = self.tour.goals
        planner = RoutePlanner(localizer.atlas, first, self.settings.route)
        for goal in others:
            find_goal(localizer.atlas, goal)
        return planner

    def _go_on(self, plan: Plan) -> Plan:
        """Drive to the next goal of the tour, or end it; `plan` ended the drive to the goal of now."""
        assert plan.outcome is not None
        self.tour = self.tour.after(plan.outcome, plan.stamp, plan.reason)
        while not self.tour.is_over:
            try:
                self.planner = self._planner_of(self.tour.goal)
            except (PilotageError, ValueError) as error:  # no way back
                self.tour = self.tour.after(Outcome.GAVE_UP, plan.stamp, str(error))
            else:
                self._forget(plan.stamp)
                return Plan(Behavior.REST, plan.stamp)
        return replace(plan, outcome=self.tour.outcome, reason=self.tour.reason)

    def _planner_of(self, goal: Place) -> RoutePlanner:
        """Plan routes to one goal."""
        if goal == HOME:
            if self.home is None:
                raise RouteError("where the drive began is not known")
            goal = self.home
        return RoutePlanner(self.position.localizer.atlas, goal, self.settings.route)

    def _forget(self, stamp: float) -> None:
        """Begin the drive to a new goal at a time [s]."""
        if self.memory is not None:
            self.memory = self.memory.for_new_goal(max(stamp, self.memory.began))

    def _find_home(self) -> None:
        """Tell where the drive began, as soon as the robot knows where it is."""
        estimate = self.position.localized
        if self.home is None and self.settings.knows_place(estimate):
            began = self.position.odom_from_base.inverse() @ self.position.trail[:1]
            sketch = self.position.localizer.atlas.sketch
            x, y = sketch.file_from_sketch(self.position.estimate.sketch_from_base @ began)[0].tolist()
            self.home = x, y

    def _is_due(self, stamp: float, memory: Memory) -> bool:
        """Tell whether to plan now; not at a scan that the localizer got, if that can wait."""
        waited = stamp - self.plan.stamp
        is_over = stamp - memory.began >= self.settings.time_limit
        return is_over or waited >= (2.0 * PLAN_EVERY if self.position.is_fresh else PLAN_EVERY)

    def _situation(self, stamp: float, memory: Memory) -> Situation:
        """Gather what behaviors look at."""
        position, estimate = self.position, self.position.estimate
        knows = self.settings.knows_place(estimate)
        explores = memory.arrival.doubt is Doubt.WHICH_PLACE or stamp < memory.detour_until
        leg = None
        if knows and not explores:
            leg, blocked = self.planner.leg(estimate, memory.blocked)
            memory = memory.with_blocked(blocked)
        return Situation(
            stamp=stamp,
            estimate=estimate,
            twist=position.twist,
            has_moved=len(position.trail) > 1,
            turned=position.turned,
            trail=position.trail,
            local_grid=self.local_grid,
            reachable=self._allowed_grid(knows=knows).reachable_set(self.settings.radius),
            memory=memory,
            planner=self.planner,
            leg=leg,
            sample=position.localizer.sample,
            settings=self.settings,
        )

    def _allowed_grid(self, *, knows: bool) -> LocalGrid:
        """Enter keep-out zones as obstacles where they are believed to be, unless the robot is in one."""
        zones, sketch_from_base = self.zones, self.position.estimate.sketch_from_base
        if not (knows and zones.keep_out) or zones.are_kept_out(sketch_from_base.translation[np.newaxis])[0]:
            return self.local_grid
        base_from_odom = self.local_grid.odom_from_base.inverse()
        return self.local_grid.without(
            lambda points: zones.are_kept_out(sketch_from_base @ (base_from_odom @ points))
        )

    def _command(self, scan: LaserScan) -> tuple[Twist, Behavior]:
        """Turn the plan into a command to the wheels, and say what the robot does."""
        plan, steering, twist = self.plan, self.settings.steering, self.position.twist
        if is_blind(scan):
            return turn_on_the_spot(0.0, steering, twist), Behavior.REST if plan.outcome else Behavior.WAIT
        if plan.behavior is Behavior.REST:
            return turn_on_the_spot(0.0, steering, twist), Behavior.REST
        rectangle = self.settings.rectangle
        base_from_odom = self.local_grid.odom_from_base.inverse()
        remembered = base_from_odom @ self.local_grid.obstacles
        obstacles = np.vstack([scan.points_in_base, remembered[remembered[:, 0] < BEHIND]])
        if len(plan.path) == 0:
            around = TURNING * steering.turn_rate
            return turn(around, obstacles, steering, twist, rectangle), Behavior.LOOK_AROUND
        path = base_from_odom @ plan.path
        passed = int(np.hypot(path[:, 0], path[:, 1]).argmin())
        if self.zones.is_slow(self.position.estimate.sketch_from_base.translation):
            steering = replace(steering, speed=SLOWLY * steering.speed)
        command = steer(
            path[passed:],
            obstacles,
            self.settings.radius,
            steering,
            twist,
            sight=scan.range_max,
            rectangle=rectangle,
        )
        waits = command.linear == 0.0 and abs(command.angular) < WAITING
        return command, Behavior.WAIT if waits else plan.behavior

    def _report(self, scan: LaserScan, command: Twist, behavior: Behavior) -> Step:
        """Say what is done and why."""
        plan, leg, memory = self.plan, self.plan.leg, self.memory
        target = None
        if len(plan.path) > 0:
            x, y = (self.local_grid.odom_from_base.inverse() @ plan.path[-1:])[0].tolist()
            target = x, y
        return Step(
            scan.stamp,
            command,
            behavior,
            self.position.localized,
            next_cell_id=leg.next_cell_id if leg else "",
            gateway_id=leg.gateway_id if leg else "",
            target=target,
            distance=leg.distance if leg else math.inf,
            closed_gateway_ids=memory.blocked.gateway_ids if memory else (),
            times_lost=self.position.times_lost,
            outcome=plan.outcome,
            reason=plan.reason,
            visits=self.tour.visits,
        )


def is_blind(scan: LaserScan) -> bool:
    """Tell whether a scanner that sees far sees nothing at all: the robot must not drive by it."""
    return scan.range_max >= FAR_SEEING and float(scan.returned.mean()) < SEEING
