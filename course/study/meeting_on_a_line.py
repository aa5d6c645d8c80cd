"""Two balls on a line before and after they meet, under any formula for the impulse."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array
from course.study.asking import asked, one_number

#: The moment at which balls that approach meet, and the end [s]. So little that they come
#: from near by: a velocity that is another moves the start by less than its arrow grows.
MEETING, LAST = 0.2, 0.52
#: p_hat(mass_1, mass_2, velocity_1, velocity_2, normal, restitution), as lesson 10 asks.
ImpulseLaw = Callable[..., Array]
#: Velocities of both after the impact, of the same arguments, (2, 3) [m/s].
Outcome = Callable[..., Array]


@dataclass(frozen=True, eq=False)
class CentralMotion:
    """Body 2 comes from the left, body 1 from the right, n points right.

    Args:
        mass, radius: of body 1 and body 2, (2,) [kg], [m].
        times: (t,) [s]; the moment of the impact stands twice.
        position, velocity: along n, (t, 2) [m], [m/s].
        meeting: when they meet, inf if they never do [s].
        impulse: p_hat, what body 1 takes along n [N s].
        push: change of momentum of both along n, (2,) [N s].
        aside: velocity of both across n after the impact, upward, (2,) [m/s]; 0 unless
            somebody's formula loses the direction.
        lost: kinetic energy that is gone after the impact [J].
    """

    mass: Array
    radius: Array
    times: Array
    position: Array
    velocity: Array
    meeting: float
    impulse: float
    push: Array
    aside: Array
    lost: float

    @property
    def kinetic_energy(self) -> Array:
        """Of both, (t, 2) [J]."""
        return np.asarray(0.5 * self.mass * self.velocity**2)

    @property
    def centre(self) -> Array:
        """Of both together, (t,) [m]."""
        return np.asarray(self.position @ self.mass / self.mass.sum())


def ball_radius(mass: float | Array) -> Array:
    """Of one density, as far as the picture shows it: between 0.14 and 0.62 m."""
    return np.clip(0.32 * np.cbrt(mass), 0.14, 0.62)


def central_motion(
    mass_1: float,
    mass_2: float,
    velocity_1: float,
    velocity_2: float,
    restitution: float,
    *,
    law: ImpulseLaw = formulas.impulse_central,
    outcome: Outcome | None = None,
    duration: float = LAST,
) -> CentralMotion:
    """The balls until they meet, MEETING after the start, and after it.

    Balls that do not approach stand side by side at the start, and no law is asked.

    Args:
        mass_1, mass_2: [kg].
        velocity_1, velocity_2: along n [m/s].
        restitution: e, from 0 to 1.
        law: the impulse; a student's, or the one the slide prints.
        outcome: the velocities after, in place of a law of the impulse.
        duration: of the film [s].
    Raises:
        UnusableResult: a law that gives anything but one number.
    """
    mass, before = np.array([mass_1, mass_2]), np.array([velocity_1, velocity_2])
    radius = ball_radius(mass)
    side = np.array([1.0, -1.0])
    approach = before[0] < before[1]
    meeting = MEETING if approach else np.inf
    n = np.array([1.0, 0.0, 0.0])
    given = (mass_1, mass_2, velocity_1 * n, velocity_2 * n, n, restitution)
    # What parts is not asked: a law that pulls would be seen, but no balls touch there.
    left = (outcome or by_impulse(law))(*given) if approach else before[:, None] * n
    after, aside = left[:, 0], left[:, 2]
    push = mass * (after - before)
    times = np.array([0.0, MEETING, MEETING, duration])
    touching = side * radius
    start = touching - before * MEETING if approach else touching + 0.2 * side
    position = np.array(
        [start, start + before * MEETING, start + before * MEETING, start]
    )
    position[3] = position[2] + after * (duration - MEETING)
    velocity = np.array([before, before, after, after])
    lost = float(0.5 * (mass @ before**2 - mass @ np.sum(left**2, axis=1)))
    return CentralMotion(
        mass, radius, times, position, velocity, meeting, float(push[0]), push, aside, lost
    )  # fmt: skip


def printed_speed(
    velocity_1: Array, velocity_2: Array, normal: Array, restitution: float
) -> Array:
    """The speed with which they part by the same line, e (v1 - v2).n: still toward each other."""
    return restitution * np.sum((velocity_1 - velocity_2) * normal, axis=-1)


def by_impulse(law: ImpulseLaw) -> Outcome:
    """What an impulse makes of the velocities: v1 + p_hat n/m1, v2 - p_hat n/m2."""

    def outcome(
        m1: float, m2: float, v1: Array, v2: Array, n: Array, e: float
    ) -> Array:
        p_hat = one_number(law, m1, m2, v1, v2, n, e)
        return np.stack([v1 + p_hat / m1 * n, v2 - p_hat / m2 * n])

    return outcome


def by_momenta(momenta: Callable[..., Any]) -> Outcome:
    """What ``momentum_after`` makes of the right impulse, over the masses."""

    def outcome(
        m1: float, m2: float, v1: Array, v2: Array, n: Array, e: float
    ) -> Array:
        p_hat = float(formulas.impulse_central(m1, m2, v1, v2, n, e))
        p1, p2 = asked(momenta, ((3,), (3,)), m1 * v1, m2 * v2, p_hat, n)
        return np.stack([p1 / m1, p2 / m2])

    return outcome


def by_separation_speed(speed: Callable[..., Any]) -> Outcome:
    """The impulse that makes the bodies part with what ``separation_speed`` says."""

    def impulse(
        m1: float, m2: float, v1: Array, v2: Array, n: Array, e: float
    ) -> Array:
        change = one_number(speed, v1, v2, n, e) - (v1 - v2) @ n
        return np.asarray(change / (1 / m1 + 1 / m2))

    return by_impulse(impulse)


def printed_law(
    mass_1: float,
    mass_2: float,
    velocity_1: Array,
    velocity_2: Array,
    normal: Array,
    restitution: float,
) -> Array:
    """The impulse of the restitution line as it is printed, without its minus sign.

    (v2' - v1') = e (v2 - v1) gives p_hat the factor 1 - e for 1 + e (misprint 3): the
    balls never turn round, and at e = 1 they do not notice each other.
    """
    closing = np.sum((velocity_2 - velocity_1) * normal, axis=-1)
    impulse = (1 - restitution) * closing / (1 / mass_1 + 1 / mass_2)
    return np.where(closing > 0, impulse, 0.0)
