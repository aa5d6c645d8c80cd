"""When pairs first meet that fly on parabolas and turn: conservative advancement along the axis that separates them.

Along a fixed axis N two solids that are d apart at t are, at t + h, apart by at least

    q(h) = d + (w - s) h + a h^2/2,   w = N.(v_A - v_B),  a = N.(a_A - a_B),
                                      s = sum over both of |N x omega| rho,

rho being how far a solid reaches from the point it turns about. So nothing is met before
the first root of q, and the pair is put there. It is the acceleration in q that finds a body
that turns back before it arrives, or arrives only later, whatever the step.

Source: B. Mirtich, *Impulse-based Dynamic Simulation of Rigid Body Systems*, Berkeley 1996,
section 2.3; C. Ericson, *Real-Time Collision Detection*, section 5.5.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import Array, BoolArray
from course.overlap import nearest_points

#: After so many steps a pair that creeps is said to meet where it is.
STEPS = 1000
#: What touches slides if it approaches by less than this times its speed.
SLIDING = 1e-12


@dataclass(frozen=True, eq=False)
class Flight:
    """How k solids fly: c(t) = c + v t + a t^2/2, turned about it by omega t.

    Args:
        pivot: c, (k, 3) [m].
        velocity: v, (k, 3) [m/s].
        spin: omega, (k, 3) [rad/s], world axes, constant.
        acceleration: a, (k, 3) [m/s^2], constant.
        reach: rho, (k,) [m].
    """

    pivot: Array
    velocity: Array
    spin: Array
    acceleration: Array
    reach: Array

    def __getitem__(self, which: Any) -> Flight:
        return Flight(*(x[which] for x in vars(self).values()))

    def way(self, t: Array) -> Array:
        """v t + a t^2/2, (k, 3) [m]."""
        s = t[:, None]
        return self.velocity * s + 0.5 * self.acceleration * s * s

    def placed(self, shape: Any, t: Array) -> Any:
        """The solids where they are at t, (k,)."""
        from scipy.spatial.transform import Rotation

        if not np.any(self.spin):
            return shape.moved(np.eye(3), self.way(t))
        turn = Rotation.from_rotvec(self.spin * t[:, None]).as_matrix()
        fixed = np.einsum("kij,kj->ki", turn, self.pivot)
        return shape.moved(turn, self.pivot + self.way(t) - fixed)

    def speed_at(self, point: Array, t: Array) -> Array:
        """v + a t + omega x (x - c(t)) of points x (k, 3)."""
        arm = point - self.pivot - self.way(t)
        return self.velocity + self.acceleration * t[:, None] + np.cross(self.spin, arm)


def flight_times(
    a: Any, b: Any, fly_a: Flight, fly_b: Flight, horizon: Array, tolerance: Array
) -> Array:
    """When k pairs first meet within the horizon, (k,) [s]; inf where they do not.

    0 for pairs that penetrate, or touch and approach; those that touch and part are followed
    further. No penetration deeper than the tolerance is missed.

    Args:
        a, b: solids at t = 0, batches (k,), not two half spaces.
        horizon: (k,) [s].
        tolerance: (k,) [m], above 0.
    """
    t, time = np.zeros(horizon.size), np.full(horizon.size, np.inf)
    apart = np.zeros(horizon.size, dtype=bool)  # whether it ever was
    rows = np.arange(horizon.size)
    for _ in range(STEPS):
        pairs = a[rows], b[rows], fly_a[rows], fly_b[rows]
        meets, step = _step(*pairs, t[rows], tolerance[rows], apart, rows)
        time[rows[meets]] = t[rows[meets]]
        t[rows] += step
        rows = rows[~meets & (t[rows] <= horizon[rows])]
        if not rows.size:
            return time
    time[rows] = t[rows]
    return time


def _step(
    a: Any, b: Any, fly_a: Flight, fly_b: Flight, t: Array, tolerance: Array, apart: BoolArray, rows: Any
) -> tuple[BoolArray, Array]:  # fmt: skip
    """Which pairs meet at t, and how far the others may go without meeting; notes who is apart."""
    near = nearest_points(fly_a.placed(a, t), fly_b.placed(b, t))
    d, n = near.gap, near.normal
    speed = fly_a.speed_at(near.point_a, t) - fly_b.speed_at(near.point_b, t)
    rate = _dot(n, speed)
    bend = _dot(n, fly_a.acceleration - fly_b.acceleration)
    turning = sum(
        np.linalg.norm(np.cross(n, fly.spin), axis=1) * fly.reach for fly in (fly_a, fly_b)
    )  # fmt: skip
    arms = _dot(n, np.cross(fly_a.spin, near.point_a - fly_a.pivot - fly_a.way(t)))
    arms -= _dot(n, np.cross(fly_b.spin, near.point_b - fly_b.pivot - fly_b.way(t)))
    least = rate - arms - turning
    level = SLIDING * np.linalg.norm(speed, axis=1)
    closing = (rate < -level) | ((rate <= level) & (bend < 0))
    touching = d <= tolerance
    meets = touching & (closing | apart[rows] | (d < -tolerance))
    apart[rows[~touching]] = True
    ahead = first_root(np.maximum(d - 0.5 * tolerance, 0.0), least, 0.5 * bend)
    return meets, np.where(touching, _away(least, bend, tolerance), ahead)


def first_root(d: Array, b: Array, c: Array) -> Array:
    """The least h > 0 with d + b h + c h^2 = 0, for d >= 0; inf if there is none.

    Written so that neither root loses its digits: 2 d/(-b + sqrt(b^2 - 4 c d)) where b < 0,
    (b + sqrt(b^2 - 4 c d))/(-2 c) where it first rises.
    """
    square = b * b - 4.0 * c * d
    root = np.sqrt(np.maximum(square, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        falling = np.where(square >= 0, 2.0 * d / (root - b), np.inf)
        rising = np.where(c < 0, (b + root) / (-2.0 * c), np.inf)
    return np.where(b < 0, falling, rising)


def _away(b: Array, bend: Array, tolerance: Array) -> Array:
    """How far a pair that touches and parts may go: to the top of its way, or until it may be back by the tolerance."""
    with np.errstate(divide="ignore", invalid="ignore"):
        top = np.where(bend < 0, b / -bend, np.inf)
        back = first_root(tolerance, np.minimum(b, 0.0), np.minimum(0.5 * bend, 0.0))
    return np.where(b > 0, top, back)


def _dot(a: Array, b: Array) -> Array:
    return np.asarray(np.einsum("ki,ki->k", a, b))
