"""One gap worked out for a picture: on a dome, between a bar and a plank, past a corner."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from course.arrays import Array, failure, positive, scalar, scalars
from course.dynamics import Bodies, Dome, point_velocity
from course.scenes import Scene, bar_over_plank


@dataclass(frozen=True, eq=False)
class OldPoint:
    """A particle let go on a dome of 1 m, a moment ahead, in the plane of y and z.

    Args:
        angle, ahead: from the top [degrees], and the moment [s].
        path: of the flight, (k, 2) [m], from the touched point to the particle.
        normal: of the dome at the particle, (2,).
        gap, from_old_point: to the dome, and along N from the point touched before [m].
        bias, speed: d_ddot without a force [m/s^2], and v when it was let go [m/s].
    """

    angle: float
    ahead: float
    path: Array
    normal: Array
    gap: float
    from_old_point: float
    bias: float
    speed: float


def old_point(angle: float, ahead: float) -> OldPoint:
    """The gap to a dome and the gap from the point that was touched; degrees from the top and s ahead."""
    dome, theta = Dome(), np.radians(angle)
    path = dome.flight(theta, np.linspace(0, ahead, 40))
    return OldPoint(
        angle,
        ahead,
        path,
        path[-1] / np.linalg.norm(path[-1]),
        gap=float(dome.gap(theta, ahead)),
        from_old_point=float(dome.gap_from_the_old_point(theta, ahead)),
        bias=float(dome.bias(theta)),
        speed=float(dome.speed(theta)),
    )


@dataclass(frozen=True, eq=False)
class GapRate:
    """How fast a bar and a plank part, and what each motion adds to it.

    Args:
        bodies: bar and plank, level.
        point, velocity: of the two points of the contact, (2, 3) [m], [m/s].
        parts: name of a motion -> what it adds to d_dot [m/s].
    """

    bodies: Bodies
    point: Array
    velocity: Array
    parts: dict[str, float]

    @property
    def total(self) -> float:
        """d_dot [m/s]."""
        return sum(self.parts.values())


def gap_rate(
    rate_a: float,
    rate_b: float,
    velocity_a: float = 0.0,
    velocity_b: float = 0.0,
    *,
    reach: float = 1.8,
) -> GapRate:
    """Bar over plank: rates against the clock [rad/s], velocities upward [m/s], y of the bar's centre [m]."""
    scene = bar_over_plank(rate_a, rate_b, reach=reach, clear=0.7)
    bodies, contact = scene.bodies, scene.contacts
    point = np.stack([contact.point_a[0], contact.point_b[0]])
    lift = np.outer([velocity_a, velocity_b], [0.0, 0.0, 1.0])
    turning = point_velocity(0 * lift, bodies.angular_velocity, point - bodies.position)
    parts = {
        "A rises": velocity_a,
        "A turns": float(turning[0, 2]),
        "B rises": -velocity_b,
        "B turns": -float(turning[1, 2]),
    }
    return GapRate(bodies, point, turning + lift, parts)


@dataclass(frozen=True, eq=False)
class PairStates:
    """A bar over a plank at several times.

    Args:
        times: (t,) [s].
        bodies: bar and plank at each time.
        gaps: d at each time, (t,) [m].
        point_a, point_b: what meets at the last time, (3,) each [m].
    """

    times: tuple[float, ...]
    bodies: tuple[Bodies, ...]
    gaps: tuple[float, ...]
    point_a: Array
    point_b: Array


def pair_states(pair: Scene, times: Sequence[float] = (0.0,)) -> PairStates:
    """``course.scenes.bar_over_plank`` at these times [s], by its known motion.

    Raises:
        ValueError: no times.
    """
    when = tuple(scalar("times", time) for time in times)
    if not when:
        raise failure("times", "at least one", "none")
    states = tuple(pair.at(time) for time in when)
    gaps = tuple(pair.gap(time) for time in when)
    last = pair.touching(states[-1])
    return PairStates(when, states, gaps, last.point_a[0], last.point_b[0])


@dataclass(frozen=True, eq=False)
class CornerPassing:
    """A point that passes over the corner of a box at several heights, at equal times.

    The box fills y <= 0, z <= 0 of the plane.

    Args:
        heights: z of each passage, (h,) [m].
        y: of the point, the same in each passage, (k,) [m].
        normal: from the nearest point of the box to the point, unit, (h, k, 2).
    """

    heights: Array
    y: Array
    normal: Array


def corner_passing(
    heights: Sequence[float] = (0.3, 0.03), *, speed: float = 1.0, step: float = 0.1
) -> CornerPassing:
    """Passages at these heights [m] with one speed [m/s], looked at every ``step`` [s].

    N = (p - q)/|p - q| with the nearest point q = min(p, 0) of the box.
    """
    z = np.atleast_1d(positive("heights", scalars("heights", heights)))
    y = positive("speed", speed) * positive("step", step) * np.arange(-4, 7)
    place = np.stack(np.broadcast_arrays(y, z[:, None]), axis=-1)
    away = place - np.minimum(place, 0.0)
    return CornerPassing(z, y, away / np.linalg.norm(away, axis=-1, keepdims=True))
