"""A box that falls onto a floor in steps, moved by the word that is said of it in each step."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array, ArrayLike
from course.study.asking import RUN_AWAY, UnusableResult

#: What two bodies can be to each other, as ``contact_state`` says it.
STATES = ("apart", "separating", "colliding", "resting", "sliding", "penetrating")
GRAVITY = 9.81  # [m/s^2]


@dataclass(frozen=True, eq=False)
class BoxSteps:
    """A box over a floor, step by step.

    Args:
        times: (n + 1,) [s].
        gap: to the floor, (n + 1,) [m].
        rate: of the gap, as it was asked about, with gravity's share of the step, (n,) [m/s].
        said: the word in each step, (n,).
    """

    times: Array
    gap: Array
    rate: Array
    said: tuple[str, ...]

    def share(self, word: str, last: float) -> float:
        """The share of the steps of the last seconds in which a word was said."""
        late = self.times[:-1] >= self.times[-1] - last - 1e-9
        return float(np.mean(np.array(self.said)[late] == word))


def step_tolerance(speed: Any, steps_per_second: float) -> tuple[Any, Any]:
    """The tolerance of this speed s and the distance s h/2: half the way of a step at s.

    Args:
        speed: s [m/s]; with less than g h no box stays at rest.
        steps_per_second: 1/h.
    """
    return 0.5 * speed / steps_per_second, speed


def stepped_box(
    function: Callable[..., Any],
    *,
    tolerance: tuple[float, float],
    steps_per_second: float = 60.0,
    drop: float = 0.15,
    restitution: float = 0.5,
    slip_speed: float = 0.0,
    duration: float = 1.2,
) -> BoxSteps:
    """Gravity first, then a word, then what the word asks for, then the way of the step.

    colliding: the rate turns round, times the restitution. resting and sliding: it becomes
    0. penetrating: the box is lifted onto the floor, and moves no further in this step.

    Args:
        function: ``contact_state``, asked once a step.
        tolerance: that is given to it, a distance [m] and a speed [m/s].
        steps_per_second: 1/h.
        drop: the gap at the start [m], at rest.
        restitution: 0 to 1.
        slip_speed: with which it moves along the floor [m/s].
        duration: [s].
    """
    step = 1.0 / float(steps_per_second)
    count = round(duration * steps_per_second)
    gap, rate = [float(drop)], []
    said, speed = [], 0.0
    for _ in range(count):
        speed -= GRAVITY * step
        rate.append(speed)
        said.append(asked_word(function, gap[-1], speed, slip_speed, tolerance))
        if said[-1] == "colliding":
            speed *= -restitution
        if said[-1] in ("resting", "sliding"):
            speed = 0.0
        lifted = said[-1] == "penetrating"
        gap.append(0.0 if lifted else gap[-1] + step * speed)
        if abs(gap[-1]) > RUN_AWAY:
            raise UnusableResult("it lets the box run away")
    times = step * np.arange(count + 1.0)
    return BoxSteps(times, np.array(gap), np.array(rate), tuple(said))


def asked_word(
    function: Callable[..., Any], gap: float, rate: float, slip: float, tolerance: tuple[float, float]
) -> str:  # fmt: skip
    """The word that somebody's ``contact_state`` says of one pair.

    Raises:
        UnusableResult: what is none of the six words.
    """
    got = function(gap, rate, slip, tolerance)
    if got is None:
        raise UnusableResult("it returned nothing: is there a `return`?")
    array = np.asarray(got)
    if array.size != 1:
        raise UnusableResult(f"it returned shape {array.shape} in place of one word")
    word = str(array.reshape(())[()])
    if word not in STATES:
        raise UnusableResult(
            f"it returned {word[:30]!r}, which is none of the six words"
        )
    return word


def highest_hidden_drop(
    speed: float, *, steps_per_second: float, function: Callable[..., Any] | None = None
) -> float:
    """The highest of many drops, 0.1 mm to 1 m, whose landing is not said to be a collision [m].

    All of them fall at once, and each is followed until it touches.

    Args:
        speed: of the tolerance [m/s].
        steps_per_second: 1/h.
        function: ``contact_state``; none: the formula.
    """
    drops = np.geomspace(1e-4, 1.0, 400)
    fall = _Fall(drops, steps_per_second, speed, 0.0, function)
    hidden, falling = np.zeros(len(drops), bool), np.ones(len(drops), bool)
    while falling.any():
        said = fall.step()
        hidden |= falling & (said == "resting")
        falling &= (said == "apart") | (said == "penetrating")
    return float(drops[hidden].max(initial=0.0))


def share_without_rest(
    speeds: ArrayLike,
    *,
    steps_per_second: float,
    drops: ArrayLike = 0.0,
    restitution: float = 0.5,
    duration: float = 2.0,
    function: Callable[..., Any] | None = None,
) -> Array:
    """Steps of the last second in which boxes are not said to rest: their share, (k,).

    Args:
        speeds: of the tolerance, (k,) [m/s].
        steps_per_second: 1/h.
        drops: from which the boxes fall, (m,) [m]; 0: put down at rest.
        restitution: 0 to 1.
        duration: [s].
        function: ``contact_state``; none: the formula.
    """
    heights = np.atleast_1d(np.asarray(drops, dtype=float))
    each = np.asarray(speeds, dtype=float)
    count, late = round(duration * steps_per_second), round(steps_per_second)

    def shares(some: ArrayLike, gap: Array) -> Array:
        fall = _Fall(gap, steps_per_second, some, restitution, function)
        said = np.array([fall.step() for _ in range(count)])
        return np.asarray(np.mean(said[-late:] != "resting", axis=(0, -1)))

    if function is None:  # takes a batch of tolerances as well
        return shares(each[:, None], np.tile(heights, (len(each), 1)))
    return np.array([shares(speed, heights) for speed in each])


class _Fall:
    """Many boxes that fall at once, moved as ``stepped_box`` moves one."""

    def __init__(
        self, drops: Array, steps_per_second: float, speed: Any, restitution: float, function: Any
    ) -> None:  # fmt: skip
        self.says = formulas.contact_state if function is None else function
        self.step_length, self.restitution = 1.0 / steps_per_second, restitution
        self.tolerance = step_tolerance(speed, steps_per_second)
        self.gap, self.rate = drops.copy(), np.zeros_like(drops)

    def step(self) -> Array:
        """The words that are said, and the boxes moved on."""
        self.rate = self.rate - GRAVITY * self.step_length
        said = np.asarray(
            self.says(self.gap, self.rate, 0.0 * self.gap, self.tolerance)
        )
        self.rate = np.where(
            said == "colliding", -self.restitution * self.rate, self.rate
        )
        self.rate = np.where(said == "resting", 0.0, self.rate)
        moved = self.gap + self.step_length * self.rate
        self.gap = np.where(said == "penetrating", 0.0, moved)
        return said


def rule_of_the_sign(gap: ArrayLike) -> Array:
    """What a slide reads off the gap alone, (...) of str: "moving", "stay" or "no"."""
    d = np.asarray(gap, dtype=float)
    return np.select([d > 0, d < 0], ["moving", "no"], default="stay")
