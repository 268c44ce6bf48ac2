"""Several goals in order: which of them are over, and which is next."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from numbers import Real

from pilotage.navigation.step import Outcome, Place, Visit

HOME = "where the drive began"
"""What stands for the goal of the way back."""


@dataclass(frozen=True, slots=True)
class Tour:
    """Goals in order, and how the drives to the first of them ended.

    A goal that is not reached in its time is left out, and the next one is tried. `rounds` is how often all
    goals are visited, None for again and again; `returns` adds the place where the drive began at the end.

    >>> tour = Tour(("kitchen", "hall"), returns=True).after(Outcome.REACHED, 12.0, "'kitchen' is reached")
    >>> tour.goal, tour.is_over
    ('hall', False)
    """

    goals: tuple[Place, ...]
    rounds: int | None = 1
    returns: bool = False
    visits: tuple[Visit, ...] = ()

    def __post_init__(self) -> None:
        """Reject a tour without a goal, or without a round."""
        if not self.goals:
            raise ValueError("a tour needs at least one goal, got none")
        if self.rounds is not None and not self.rounds >= 1:
            raise ValueError(f"rounds must be >= 1, got {self.rounds}")

    def __str__(self) -> str:
        """Write the goals as the user would."""
        return ", ".join(map(name_of, self.goals))

    @property
    def length(self) -> int | None:
        """Number of drives of the whole tour; None if it never ends."""
        return None if self.rounds is None else self.rounds * len(self.goals) + self.returns

    @property
    def is_over(self) -> bool:
        """Whether no goal is left, or none can be reached since the drawing does not fit."""
        return len(self.visits) == self.length or (
            bool(self.visits) and self.visits[-1].outcome is Outcome.MISMATCH
        )

    @property
    def goal(self) -> Place:
        """The goal of now; `HOME` on the way back."""
        number = len(self.visits)
        if self.returns and number + 1 == self.length:
            return HOME
        return self.goals[number % len(self.goals)]

    def after(self, outcome: Outcome, stamp: float, reason: str) -> "Tour":
        """Take note of how the drive to the goal of now ended."""
        return replace(self, visits=(*self.visits, Visit(self.goal, outcome, stamp, reason)))

    @property
    def outcome(self) -> Outcome:
        """How a tour that is over ended: reached, if all goals were."""
        missed = [one.outcome for one in self.visits if one.outcome is not Outcome.REACHED]
        return missed[-1] if missed else Outcome.REACHED

    @property
    def reason(self) -> str:
        """Why it ended so: of one goal its own reason, of several which were missed and why."""
        if len(self.visits) == 1 == self.length:
            return self.visits[0].reason
        missed = [one for one in self.visits if one.outcome is not Outcome.REACHED]
        told = f"{len(self.visits) - len(missed)} of {self.length} goals are reached"
        return "; ".join([told, *(f"{name_of(one.goal)}: {one.reason}" for one in missed)])


def tour_of(goal: Place | Sequence[Place] | Tour) -> Tour:
    """Read one goal, or several in order.

    >>> tour_of((3.0, 4.0)).goals, tour_of(["kitchen", (3.0, 4.0)]).goals
    (((3.0, 4.0),), ('kitchen', (3.0, 4.0)))

    Raises ValueError if a goal is neither a name nor a point.
    """
    if isinstance(goal, Tour):
        return goal
    if isinstance(goal, str):
        return Tour((goal,))
    if len(goal) == 2 and all(isinstance(one, Real) for one in goal):
        return Tour((as_point(goal),))
    return Tour(tuple(one if isinstance(one, str) else as_point(one) for one in goal))


def as_point(numbers: object) -> tuple[float, float]:
    """Check that a point is two numbers, of whatever type; raises ValueError if not."""
    if isinstance(numbers, Iterable) and not isinstance(numbers, str):
        match tuple(numbers):
            case (Real() as x, Real() as y):
                return float(x), float(y)
    raise ValueError(f"a goal must be a name or a point x, y, got {numbers}")


def name_of(goal: Place) -> str:
    """Write a goal as the user would."""
    return goal if isinstance(goal, str) else f"{goal[0]:g},{goal[1]:g}"
