"""Scan in, command out: drives a robot to a goal that is marked on a drawing (Wolter 2001, section 4.2)."""

import math
from dataclasses import dataclass, field, replace

import numpy as np

from pilotage.geometry import Array, Twist, wrap_angle
from pilotage.localization import Estimate, Localizer, Status
from pilotage.maps import NotEnclosedError, Roads, RouteError, RouteSettings, check_place
from pilotage.navigation.arrival import Arrival, ArrivalSettings, Doubt
from pilotage.navigation.closures import Closures, ClosureSettings
from pilotage.navigation.explorer import Explorer
from pilotage.navigation.exploring import SAMPLE, ExploringSettings, choose_onward
from pilotage.navigation.guidance import Leg, lead
from pilotage.navigation.progress import Progress
from pilotage.navigation.reckoning import Reckoning
from pilotage.navigation.steering import SLOW, SteeringSettings, steer, turn_on_the_spot
from pilotage.navigation.step import Behavior, Outcome, Step
from pilotage.navigation.surroundings import Reach, Surroundings, SurroundingsSettings
from pilotage.perception import LaserScan, Odometry


@dataclass(frozen=True, slots=True)
class NavigatorSettings:
    """How the robot drives."""

    radius: float = 0.2  # [m] of the robot's footprint, a disc about its base
    time_limit: float = 900.0  # [s] after which the robot gives up
    surroundings: SurroundingsSettings = field(default_factory=SurroundingsSettings)
    steering: SteeringSettings = field(default_factory=SteeringSettings)
    exploring: ExploringSettings = field(default_factory=ExploringSettings)
    closures: ClosureSettings = field(default_factory=ClosureSettings)
    arrival: ArrivalSettings = field(default_factory=ArrivalSettings)
    route: RouteSettings = field(default_factory=RouteSettings)
    perceive_every: float = 0.15  # [m] of way between two scans that the localizer is given
    perceive_turn: float = math.radians(8.0)  # [rad] the same
    plan_every: float = 0.3  # [s]
    way: float = 0.1  # cost of a metre of way, when it goes to where it can come nearest to a point
    astray: float = 1.0  # [m] cost of a place there that seems to lie in a cell off the route
    act_on: float = 0.5  # probability of a place from which on the robot goes by it
    patience: float = 8.0  # [s] without getting away from a place before something else is tried
    detour: float = 10.0  # [s] for which it explores then

    def __post_init__(self) -> None:
        """Refuse what cannot be meant."""
        for name in ("radius", "time_limit", "plan_every", "patience"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be > 0, got {getattr(self, name)}")
        if not 0.0 <= self.act_on <= 1.0:
            raise ValueError(f"act_on must be in [0, 1], got {self.act_on}")


@dataclass(frozen=True, eq=False)
class Plan:
    """Where to go now: a way over what was seen free."""

    behavior: Behavior
    way: Array  # (k, 2) in odom [m]
    leg: Leg | None = None
    gap: float = 0.0  # [m] from the end of the way to the point that the drawing names

    @property
    def target(self) -> Array:
        """The end of the way, (2,) in odom [m]."""
        return np.asarray(self.way[-1])


TRAIL = 0.5
"""So far [m] from where it was before, a place is remembered."""

TURNING = 0.7
"""At this share of its fastest turn the robot looks around."""

BLIND = math.radians(30.0)
"""A scanner that leaves out less sees all around."""


class Navigator:
    """Drives to `goal`, a point of the sketch (y up): the localizer holds the place, this the drive.

    Raises RouteError if the goal cannot be gone to at all, NotEnclosedError if the drawing has no cells.
    """

    def __init__(
        self, localizer: Localizer, goal: tuple[float, float], settings: NavigatorSettings | None = None
    ) -> None:
        self.settings = settings if settings is not None else NavigatorSettings()
        self.localizer = localizer
        self.goal = goal
        if localizer.atlas.cell_graph is None:
            raise NotEnclosedError("a drawing to drive by must enclose free space, this one has no cells")
        check_place(localizer.atlas.cell_graph, goal, "goal")
        self.roads = Roads(localizer.atlas.cell_graph, self.settings.route)
        self.surroundings = Surroundings.unseen(self.settings.surroundings)
        self.trail = np.zeros((1, 2))  # where the robot was, in odom [m]
        self._reckoning: Reckoning | None = None  # before the first scan
        self._began = 0.0
        self._plan: Plan | None = None
        self._planned = -math.inf
        self._turn_left = 0.0  # [rad] still to be turned while looking around
        self._heading = 0.0
        self._blind = math.tau  # [rad] of the directions that the scanner does not see
        self._closures = Closures()
        self._explorer = Explorer(localizer.atlas, self.roads, goal, self.settings.exploring)
        self._progress = Progress()
        self._explore_until = -math.inf
        self._times_stuck = 0
        self._arrival = Arrival()
        self._outcome: Outcome | None = None
        self._reason = ""

    def step(self, scan: LaserScan, odometry: Odometry) -> Step:
        """Take one scan in, give one command out."""
        settings = self.settings
        if self._reckoning is None:
            self._reckoning = reckoning = self._begin(scan, odometry)
        else:
            reckoning = self._reckoning
            reckoning.advance(scan, odometry, settings.perceive_every, settings.perceive_turn)
        odom_from_base = reckoning.odom_from_base
        self.surroundings = self.surroundings.seen(scan, odom_from_base)
        if np.hypot(*(self.trail[-1] - odom_from_base.position)) > TRAIL:
            self.trail = np.vstack([self.trail, odom_from_base.position])
        self._turn_left -= abs(wrap_angle(odom_from_base.theta - self._heading))
        self._heading = odom_from_base.theta
        if self._outcome is None and scan.stamp - self._began >= settings.time_limit:
            self._end(Outcome.GAVE_UP, f"the goal was not reached within {settings.time_limit:.0f} s")
        waited = scan.stamp - self._planned
        is_busy = reckoning.is_fresh and waited < 2.0 * settings.plan_every  # one thing at a time
        if self._outcome is None and waited >= settings.plan_every and not is_busy:
            self._plan = self._make_plan(scan.stamp, reckoning)
            self._planned = scan.stamp
        return self._report(scan, reckoning)

    def _begin(self, scan: LaserScan, odometry: Odometry) -> Reckoning:
        """Take the first scan in; look around if it does not tell where the robot is."""
        self._began = scan.stamp
        self._blind = math.tau - (len(scan) - 1) * abs(scan.angle_increment)
        reckoning = Reckoning(self.localizer, scan, odometry)
        if reckoning.estimate.status is Status.LOST:
            self._look_around()
        return reckoning

    def _end(self, outcome: Outcome, reason: str) -> None:
        """Stop for good."""
        self._outcome, self._reason = outcome, reason

    def _make_plan(self, stamp: float, reckoning: Reckoning) -> Plan | None:
        """Decide what to do next; None to turn on the spot."""
        if self._turn_left > 0.0:
            self._progress = Progress()
            return None
        here = self.surroundings.odom_from_base.position
        self._progress = self._progress.at(stamp, here, self.settings.patience)
        reach = self.surroundings.reach(self.settings.radius)
        if len(reach.cells) == 0:
            return None
        estimate = reckoning.here
        confidence, spread = estimate.confidence, estimate.position_std
        self._arrival = self._arrival.at(stamp, confidence, spread, self.settings.arrival)
        if self._arrival.doubt is Doubt.WHERE_IN_IT:
            plan = self._go_on(reach, estimate)
            if plan is not None:
                return plan
            self._arrival = self._arrival.forgotten()
        explores = self._arrival.doubt is Doubt.WHICH_PLACE or stamp < self._explore_until
        knows = estimate.hypotheses[0].probability >= self.settings.act_on
        leg = self._leg(stamp, estimate) if knows and not explores else None
        if leg is None:
            return self._explore(reach, estimate)
        plan = self._follow(reach, leg, estimate)
        return self._watch(plan, reach, stamp, reckoning)

    def _leg(self, stamp: float, estimate: Estimate) -> Leg | None:
        """Ask the drawing for the way; forget closed gateways after a while, and if nothing else is left."""
        self._closures = self._closures.lasting(stamp, self.settings.closures)
        for closed in (self._closures.gateway_ids, ()):
            try:
                return lead(estimate.sketch_from_base, self.roads, self.goal, closed)
            except RouteError:
                if not closed:
                    return None
                self._closures = self._closures.opened()
        return None

    def _follow(self, reach: Reach, leg: Leg, estimate: Estimate) -> Plan:
        """Go where one can come nearest to the point that the drawing names, but rather on the route."""
        settings, odom_from_base = self.settings, reach.surroundings.odom_from_base
        point = (odom_from_base @ leg.point[np.newaxis])[0]
        on_paper = estimate.sketch_from_base @ (odom_from_base.inverse() @ reach.points)
        on_route = self.localizer.atlas.are_in(leg.route.cell_ids, on_paper)
        index = reach.nearest(point, way=settings.way, extra=np.where(on_route, 0.0, settings.astray))
        near = leg.gateway_id and float(np.hypot(*leg.middle)) < 1.0
        behavior = Behavior.GO_THROUGH if near else Behavior.CROSS
        return Plan(behavior, reach.way_to(index), leg, float(np.hypot(*(reach.points[index] - point))))

    def _watch(self, plan: Plan, reach: Reach, stamp: float, reckoning: Reckoning) -> Plan | None:
        """See whether the robot arrives, or gets on at all."""
        settings, leg = self.settings, plan.leg
        assert leg is not None
        in_cell = not leg.next_cell_id
        to_goal = leg.distance if in_cell else math.inf
        way_left = float(np.hypot(*(plan.target - reach.surroundings.odom_from_base.position)))
        is_taken = plan.gap > settings.arrival.near  # something stands where the goal is
        is_beside = in_cell and is_taken and way_left < 0.3 and to_goal < settings.arrival.beside
        if to_goal < settings.arrival.near or is_beside:
            if reckoning.moving.linear > SLOW:
                return replace(plan, behavior=Behavior.REST)
            estimate = reckoning.estimate
            has_moved = len(self.trail) > 1  # before that it knows what it was told
            spread = reckoning.estimate.position_std if has_moved else 0.0
            self._arrival = self._arrival.judged(stamp, estimate, spread, settings.arrival)
            if self._arrival.doubt is Doubt.NONE:
                self._end(Outcome.REACHED, f"the goal in {estimate.cell_id} is reached")
            else:
                self._look_around()
            return None
        self._closures = self._closures.faced(
            leg,
            settings.closures,
            here=reach.surroundings.odom_from_base.position,
            gap=plan.gap,
            stamp=stamp,
            lasted=settings.plan_every,
            patience=settings.patience,
        )
        if self._progress.is_stuck(settings.patience):
            self._progress = Progress()
            self._closures = self._closures.blamed(leg, stamp, settings.closures)
            self._times_stuck += 1
            self._explore_until = stamp + settings.detour * self._times_stuck
        return plan

    def _look_around(self) -> None:
        """Turn on the spot until all was seen: a scanner that sees all around need not turn."""
        self._turn_left = self._blind if self._blind > BLIND else 0.0

    def _go_on(self, reach: Reach, estimate: Estimate) -> Plan | None:
        """Drive on in the direction in which the place is uncertain; None at a dead end."""
        self._explorer.interrupt()
        if self._progress.is_stuck(self.settings.patience):
            self._progress = Progress()
            return None
        axis = reach.surroundings.odom_from_base.rotation @ np.linalg.solve(
            estimate.sketch_from_base.linear, np.array(estimate.position_axis)
        )
        index = choose_onward(reach, axis)
        return None if index is None else Plan(Behavior.EXPLORE, reach.way_to(index))

    def _explore(self, reach: Reach, estimate: Estimate) -> Plan:
        """Drive to where places would look most different, or towards the goal."""
        if self._plan is None or self._plan.behavior is not Behavior.EXPLORE:
            self._explorer.interrupt()
        elif self._progress.is_stuck(self.settings.patience):
            self._progress = Progress()
            self._explorer.give_up()
        doubts = self._arrival.doubt is Doubt.WHICH_PLACE  # where the goal seemed to be: away from there
        belief = None if doubts else self.localizer.sample(SAMPLE)
        closed = self._closures.gateway_ids
        index, leads_on = self._explorer.choose(
            reach, self.trail, estimate.hypotheses, belief=belief, closed=closed
        )
        return Plan(Behavior.EXPLORE if leads_on else Behavior.BACK_OUT, reach.way_to(index))

    def _command(self, scan: LaserScan, moving: Twist) -> tuple[Twist, Behavior]:
        """Say what the wheels shall do."""
        steering = self.settings.steering
        if self._outcome is not None or (self._plan is not None and self._plan.behavior is Behavior.REST):
            return turn_on_the_spot(0.0, moving), Behavior.REST
        if self._plan is None:
            return turn_on_the_spot(TURNING * steering.turn_rate, moving), Behavior.LOOK_AROUND
        base_from_odom = self.surroundings.odom_from_base.inverse()
        way = base_from_odom @ self._plan.way
        passed = int(np.hypot(way[:, 0], way[:, 1]).argmin())
        remembered = base_from_odom @ self.surroundings.things
        things = np.vstack([scan.points_in_base, remembered[remembered[:, 0] < 0.1]])
        sight = scan.range_max
        command = steer(way[passed:], things, self.settings.radius, steering, moving, sight=sight)
        waits = command.linear == 0.0 and abs(command.angular) < 0.05
        return command, Behavior.WAIT if waits else self._plan.behavior

    def _report(self, scan: LaserScan, reckoning: Reckoning) -> Step:
        """Tell what is done and why."""
        command, behavior = self._command(scan, reckoning.moving)
        plan = self._plan
        leg = plan.leg if plan else None
        target = None
        if plan is not None:
            x, y = (self.surroundings.odom_from_base.inverse() @ plan.target[np.newaxis])[0]
            target = float(x), float(y)
        return Step(
            scan.stamp,
            command,
            behavior,
            reckoning.estimate,
            cell_belief=reckoning.estimate.cell_probability,
            alignment_error=reckoning.estimate.position_std,
            next_cell_id=leg.next_cell_id if leg else "",
            gateway_id=leg.gateway_id if leg else "",
            target=target,
            distance=leg.distance if leg else math.inf,
            closed_gateway_ids=self._closures.gateway_ids,
            times_lost=reckoning.times_lost,
            outcome=self._outcome,
            reason=self._reason,
        )
