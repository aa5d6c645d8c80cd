"""Two balls on a line before and after they meet, under any formula for the impulse."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.arrays import Array, failure
from course.dynamics import impulse_central

#: The moment at which balls that approach meet, and the end [s]. So little that they come
#: from near by: a velocity that is another moves the start by less than its arrow grows.
MEETING, LAST = 0.2, 0.52
#: p_hat(mass_1, mass_2, velocity_1, velocity_2, normal, restitution), as lesson 10 asks.
ImpulseLaw = Callable[..., Array]


@dataclass(frozen=True, eq=False)
class CentralMotion:
    """Body 2 comes from the left, body 1 from the right, n points right.

    Args:
        mass, radius: of body 1 and body 2, (2,) [kg], [m].
        times: (t,) [s]; the moment of the impact stands twice.
        position, velocity: along n, (t, 2) [m], [m/s].
        meeting: when they meet, inf if they never do [s].
        impulse: p_hat [N s].
        lost: kinetic energy that is gone after the impact [J].
    """

    mass: Array
    radius: Array
    times: Array
    position: Array
    velocity: Array
    meeting: float
    impulse: float
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
    law: ImpulseLaw = impulse_central,
    duration: float = LAST,
) -> CentralMotion:
    """The balls until they meet, MEETING after the start, and after it.

    Balls that do not approach stand side by side at the start, and no law is asked.

    Args:
        mass_1, mass_2: [kg].
        velocity_1, velocity_2: along n [m/s].
        restitution: e, from 0 to 1.
        law: the impulse; a student's, or the one the slide prints.
        duration: of the film [s].
    Raises:
        ValueError: a law that gives anything but one number.
    """
    mass, before = np.array([mass_1, mass_2]), np.array([velocity_1, velocity_2])
    radius = ball_radius(mass)
    side = np.array([1.0, -1.0])
    approach = before[0] < before[1]
    meeting = MEETING if approach else np.inf
    n = np.array([1.0, 0.0, 0.0])
    given = (mass_1, mass_2, velocity_1 * n, velocity_2 * n, n, restitution)
    # What parts is not asked: a law that pulls would be seen, but no balls touch there.
    p_hat = _number(law(*given)) if approach else 0.0
    after = before + p_hat * side / mass
    times = np.array([0.0, MEETING, MEETING, duration])
    touching = side * radius
    start = touching - before * MEETING if approach else touching + 0.2 * side
    position = np.array(
        [start, start + before * MEETING, start + before * MEETING, start]
    )
    position[3] = position[2] + after * (duration - MEETING)
    velocity = np.array([before, before, after, after])
    lost = float(0.5 * (mass @ before**2 - mass @ after**2))
    return CentralMotion(
        mass, radius, times, position, velocity, meeting, p_hat, lost
    )  # fmt: skip


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


def _number(impulse: object) -> float:
    value = np.asarray(impulse, dtype=float)
    if value.size != 1:
        raise failure("law", "one impulse for one pair", f"shape {value.shape}")
    return float(value.reshape(()))
