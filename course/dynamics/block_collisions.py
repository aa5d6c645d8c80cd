"""Two blocks and a wall, nothing lost: the collisions count the digits of pi.

The wall is at x = 0; block 1 of mass 1 stands before it, block 2 of mass
``mass_ratio`` comes in. In the plane of (sqrt(m1) v1, sqrt(m2) v2) the energy
is a circle, each collision a mirror image, and the state turns by 2 theta,
theta = arctan sqrt(m1/m2), with every two collisions: there are
ceil(pi/theta) - 1 of them (G. Galperin, "Playing pool with pi", Regular and
Chaotic Dynamics 8(4), 2003).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.arrays import Array, choice, failure, positive, scalar, whole_number

ARITHMETICS = ("float64", "float32", "exact")


def count_collisions(
    mass_ratio: float | Fraction, *, arithmetic: str = "float64"
) -> int:
    """How many collisions, by doing them one after the other.

    p_hat = 2 (v1 - v2)/(1/m1 + 1/m2) while block 2 is slower than block 1
    toward the wall, v1' = -v1 at the wall (syllabus rows 16-18, e = 1).

    "exact" counts with whole-number fractions, whose length grows with every
    collision: a second for 31,415. float64 is right for 100^k while one has
    patience (checked to 100^9); float32 fails at 100^6. Any rounding fails
    near a ratio where pi/theta is a whole number (``critical_mass_ratio``):
    the last collision is a graze, and rounding decides whether it happens.

    Args:
        mass_ratio: m2/m1 > 0; an int or a Fraction is taken exactly.
        arithmetic: "float64", "float32" or "exact".
    Returns:
        The number of collisions.
    Raises:
        ValueError: mass_ratio not positive, an unknown arithmetic.
    """
    ratio = _ratio(mass_ratio)
    if choice("arithmetic", arithmetic, ARITHMETICS) == "exact":
        return _count_exactly(ratio)
    number: Any = float if arithmetic == "float64" else np.float32
    heavy, one, two = number(ratio), number(1), number(2)
    inverse = one / heavy
    reduced_mass, v_1, v_2, count = one / (one + inverse), number(0), number(-1), 0
    while True:
        if v_2 < v_1:
            impulse = two * reduced_mass * (v_1 - v_2)
            v_1, v_2 = v_1 - impulse, v_2 + impulse * inverse
        elif v_1 < 0:
            v_1 = -v_1
        else:
            return count
        count += 1


def _count_exactly(ratio: Fraction) -> int:
    # Velocities times a common positive factor, so that they stay whole numbers.
    m, heavy = ratio.denominator, ratio.numerator
    v_1, v_2, count = 0, -1, 0
    while True:
        if v_2 < v_1:
            v_1, v_2 = (
                (m - heavy) * v_1 + 2 * heavy * v_2,
                2 * m * v_1 + (heavy - m) * v_2,
            )
            # the wall's turn comes next, in the same units
            if v_1 < 0:
                v_1, count = -v_1, count + 1
        elif v_1 < 0:
            v_1 = -v_1
        else:
            return count
        count += 1


def predicted_count(mass_ratio: float) -> int:
    """ceil(pi/theta) - 1 in float64: as good as pi/theta is, so not near a critical ratio nor beyond 1e15."""
    ratio = float(positive("mass_ratio", scalar("mass_ratio", float(mass_ratio))))
    return math.ceil(math.pi / math.atan(1 / math.sqrt(ratio))) - 1


def pi_count(exponent: int) -> int:
    """ceil(pi/theta) - 1 at mass ratio 100^exponent, in whole numbers of any length.

    theta = arctan(10^-k) and pi = 16 arctan(1/5) - 4 arctan(1/239) (Machin)
    by their series, with 2 k + 20 digits.
    """
    k = whole_number("exponent", exponent)
    if k == 0:
        return 3  # theta = pi/4 exactly: the fourth would be a graze
    one = 10 ** (2 * k + 20)
    pi = 16 * _arctan_inverse(5, one) - 4 * _arctan_inverse(239, one)
    return pi // _arctan_inverse(10**k, one)


def _arctan_inverse(n: int, one: int) -> int:
    """arctan(1/n) in units of 1/one."""
    power, total, odd, sign = one // n, 0, 1, 1
    while power:
        total += sign * (power // odd)
        power, odd, sign = power // (n * n), odd + 2, -sign
    return total


def critical_mass_ratio(count: int) -> float:
    """The ratio cot^2(pi/n) at which pi/theta = n: the n-th collision is a graze that rounding decides.

    n = 4 and 6 give the ratios 1 and 3, whole numbers with 3 and 5 collisions.
    """
    n = whole_number("count", count, minimum=3)
    return 1.0 / math.tan(math.pi / n) ** 2


@dataclass(frozen=True, eq=False)
class TwoBlocks:
    """The motion, collision by collision, and its last state.

    Args:
        mass: of the two blocks, (2,) [kg].
        time: of each collision, (c,) [s].
        at_wall: which collisions are with the wall, (c,).
        position: of both blocks at each collision, (c, 2) [m].
        velocity: before the first and after each collision, (c + 1, 2) [m/s].
    """

    mass: Array
    time: Array
    at_wall: NDArray[np.bool_]
    position: Array
    velocity: Array

    @property
    def count(self) -> int:
        """How many collisions."""
        return self.time.size

    @property
    def scaled_velocity(self) -> Array:
        """(sqrt(m1) v1, sqrt(m2) v2), all on one circle, (c + 1, 2)."""
        return self.velocity * np.sqrt(self.mass)

    @property
    def wedge_angle(self) -> float:
        """theta = arctan sqrt(m1/m2), of the states 0 <= v1 <= v2 where nothing meets [rad]."""
        return float(np.arctan(np.sqrt(self.mass[0] / self.mass[1])))

    def paths(self, end: float) -> tuple[Array, Array]:
        """The times (c + 2,) [s] and places (c + 2, 2) [m] between which both blocks go straight.

        From time 0 to ``end``, which must not be before the last collision [s].
        """
        last = scalar("end", end) - self.time[-1]
        if last < 0:
            raise failure("end", f"at least {self.time[-1]:g}", f"{end:g}")
        first = self.position[0] - self.velocity[0] * self.time[0]
        final = self.position[-1] + self.velocity[-1] * last
        times = np.concatenate([[0.0], self.time, [end]])
        return times, np.vstack([first, self.position, final])


def two_blocks(
    mass_ratio: float,
    *,
    speed: float = 1.0,
    start: tuple[float, float] = (1.0, 2.0),
    max_events: int = 100_000,
) -> TwoBlocks:
    """Where and when the blocks collide, in float64, for a picture.

    Args:
        mass_ratio: m2/m1 > 0.
        speed: of block 2 toward the wall [m/s].
        start: where the blocks are at time 0, 0 < x1 < x2 [m].
        max_events: more collisions than this are refused.
    Raises:
        ValueError: a ratio or speed that is not positive, blocks out of order, too many collisions.
    """
    heavy = float(_ratio(mass_ratio))
    v_1, v_2 = 0.0, -float(positive("speed", scalar("speed", speed)))
    x_1, x_2 = (scalar("start", x) for x in start)
    if not 0 < x_1 < x_2:
        raise failure("start", "0 < x1 < x2", f"{start}")
    if predicted_count(heavy) > max_events:
        raise failure(
            "mass_ratio",
            f"at most {max_events} collisions",
            f"{predicted_count(heavy)}",
        )
    time, place, moving = 0.0, (x_1, x_2), (v_1, v_2)
    times, walls, places, speeds = [], [], [], [moving]
    while moving[1] < moving[0] or moving[0] < 0:
        wait, at_wall, place, moving = _next_collision(place, moving, heavy)
        time += wait
        times.append(time)
        walls.append(at_wall)
        places.append(place)
        speeds.append(moving)
    return TwoBlocks(
        mass=np.array([1.0, heavy]),
        time=np.array(times),
        at_wall=np.array(walls, dtype=bool),
        position=np.array(places).reshape(-1, 2),
        velocity=np.array(speeds),
    )


def _next_collision(
    place: tuple[float, float], moving: tuple[float, float], heavy: float
) -> tuple[float, bool, tuple[float, float], tuple[float, float]]:
    """The time to the next collision, whether it is with the wall, and the blocks' places and velocities after it."""
    (x_1, x_2), (v_1, v_2) = place, moving
    meet = (x_2 - x_1) / (v_1 - v_2) if v_2 < v_1 else math.inf
    wall = x_1 / -v_1 if v_1 < 0 else math.inf
    wait = max(min(meet, wall), 0.0)
    x_1, x_2 = x_1 + v_1 * wait, x_2 + v_2 * wait
    if wall < meet:
        return wait, True, (0.0, x_2), (-v_1, v_2)
    impulse = 2 / (1 + 1 / heavy) * (v_1 - v_2)
    return wait, False, (x_2, x_2), (v_1 - impulse, v_2 + impulse / heavy)


def _ratio(mass_ratio: float | Fraction) -> Fraction:
    if isinstance(mass_ratio, Fraction):
        ratio = mass_ratio
    elif isinstance(mass_ratio, int | np.integer) and not isinstance(mass_ratio, bool):
        ratio = Fraction(int(mass_ratio))
    else:
        ratio = Fraction(
            float(positive("mass_ratio", scalar("mass_ratio", mass_ratio)))
        )
    if ratio <= 0:
        raise failure("mass_ratio", "a positive number", str(ratio))
    return ratio
