"""A ladder that slides down a smooth wall until it lets go, and on over the floor until it lies."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import Array, failure, scalar
from course.dynamics import ladder_gaps, sliding_ladder_forces


@dataclass(frozen=True, eq=False)
class LadderSlide:
    """The ladder of ``course.dynamics.ladder_gaps`` over time, from rest.

    Args:
        time: (t,) [s].
        angle, rate: theta and theta_dot, (t,) [rad], [rad/s].
        centre: y and z, (t, 2) [m].
        force: of floor and wall, (t, 2) [N]; NaN once it lies.
        gap: at floor and wall, (t, 2) [m].
        leaving, lying: when it leaves the wall, inf if it never does, and when it
            lies on the floor [s].
    """

    time: Array
    angle: Array
    rate: Array
    centre: Array
    force: Array
    gap: Array
    leaving: float
    lying: float


def ladder_slide(
    start: float,
    *,
    held: bool = False,
    duration: float = 2.5,
    frames: int = 101,
    length: float = 4.0,
    mass: float = 10.0,
    gravity: float = 9.81,
) -> LadderSlide:
    """The slide from rest, to ten digits.

    On the wall theta'' = -(3 g/(2 l)) cos theta, until f_2 is 0. After that
    the centre keeps its speed away from the wall, m z'' = f_1 - m g with z = (l/2) sin theta, and
    (m l^2/12) theta'' = -f_1 (l/2) cos theta.

    Args:
        start: theta_0 [rad].
        held: whether the wall may pull as well, so that the ladder never leaves it.
        duration, frames: the times are even from 0 to the end, and those of leaving
            and lying besides [s].
        length, mass, gravity: [m], [kg], [m/s^2].
    """
    theta = scalar("start", start)
    if not 0 < theta < np.pi / 2:
        raise failure("start", "a number between 0 and pi/2, both excluded", f"{theta}")
    half, let_go = 0.5 * length, np.arcsin(2 / 3 * np.sin(theta))
    wall = _phase(
        lambda x, v: -0.75 * gravity / half * np.cos(x),
        theta,
        0.0,
        0.0 if held else let_go,
    )
    leaving = np.inf if held else wall.end
    at, rate = (float(value) for value in wall.state(wall.end))
    free = _phase(lambda x, v: _free(x, v, half, gravity), at, rate, 0.0)
    lying = wall.end if held else wall.end + free.end
    jumps = [t for t in (leaving, lying) if t < duration]
    times = np.union1d(np.linspace(0.0, duration, frames), jumps)
    seen = np.minimum(times, lying)
    x, v = wall.state(np.minimum(seen, wall.end))
    y = -half * np.cos(x)
    size = {"length": length, "mass": mass, "gravity": gravity}
    force = sliding_ladder_forces(np.clip(x, 0, np.pi / 2), rate=v, **size)
    off = seen > leaving
    if np.any(off):
        since = seen[off] - leaving
        x[off], v[off] = free.state(since)
        y[off] = half * (np.sin(at) * rate * since - np.cos(at))
        turning = _free(x[off], v[off], half, gravity)
        lifted = half * (turning * np.cos(x[off]) - v[off] ** 2 * np.sin(x[off]))
        force[off] = np.stack([mass * (gravity + lifted), 0 * lifted], axis=-1)
    z = half * np.sin(x)
    force[times > lying] = np.nan
    gap, centre = ladder_gaps(y, z, x, length=length), np.stack([y, z], axis=-1)
    return LadderSlide(times, x, v, centre, force, gap, float(leaving), float(lying))


@dataclass(frozen=True)
class _Phase:
    """An angle from its start until it reaches a value, at ``end`` [s]."""

    solution: Any
    end: float

    def state(self, time: Any) -> Array:
        """theta and theta_dot, (2, ...)."""
        return np.asarray(self.solution(time))


def _phase(
    acceleration: Callable[[Any, Any], Any], angle: float, rate: float, stop: float
) -> _Phase:
    """Integrated from theta and theta_dot until theta falls to ``stop`` [rad]."""
    from scipy.integrate import solve_ivp

    if angle <= stop:  # it lies already
        return _Phase(lambda t: np.array([angle + 0 * t, rate + 0 * t]), 0.0)

    def there(_: float, state: Array) -> float:
        return float(state[0] - stop)

    there.terminal, there.direction = True, -1.0  # type: ignore[attr-defined]

    def rates(_: float, state: Array) -> list[float]:
        return [state[1], float(acceleration(state[0], state[1]))]

    options = {"method": "DOP853", "rtol": 1e-10, "atol": 1e-12, "dense_output": True}
    done = solve_ivp(rates, (0.0, 60.0), [angle, rate], events=there, **options)
    return _Phase(done.sol, float(done.t_events[0][0]))


def _free(angle: Array, rate: Array, half: float, gravity: float) -> Array:
    """theta'' of a ladder with its foot on the floor and its top free [rad/s^2]."""
    cosine, weight = np.cos(angle), gravity - half * rate**2 * np.sin(angle)
    return np.asarray(-cosine * weight / (half * (1 / 3 + cosine**2)))
