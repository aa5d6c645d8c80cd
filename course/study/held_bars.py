"""A bar whose corner lies on a turning plank, held there by the b of somebody's own function."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array
from course.scenes import GRAVITY
from course.study.asking import RUN_AWAY, one_number

#: Half lengths of bar (A) and plank (B), and half their thickness [m].
BAR, PLANK, HALF = 0.7, 1.6, 0.06
MASS = 1.0
INERTIA = MASS * BAR**2 / 3.0
#: The bar's lower left corner, from its centre, at time 0 (y, z) [m].
CORNER = np.array([0.0, -BAR, -HALF])
Bias = Callable[..., Any]


@dataclass(frozen=True, eq=False)
class HeldBar:
    """In the plane of y and z; a turn against the clock is positive.

    Args:
        times: (t,) [s].
        position: of the bar's centre, (t, 3) [m]; the plank turns about the origin.
        angle: of bar and plank, (t, 2) [rad].
        gap: of the bar's corner over the plank's upper face, (t,) [m].
        corner, normal: (t, 3) [m].
        force: along N, (t,) [N].
    """

    times: Array
    position: Array
    angle: Array
    gap: Array
    corner: Array
    normal: Array
    force: Array


def held_bar(
    rate_a: float,
    rate_b: float,
    place: float,
    times: Array,
    *,
    function: Bias = formulas.contact_bias,
) -> HeldBar:
    """The bar falls, the plank turns evenly on its axle, and f = -b/a keeps d_ddot at 0.

    At the start both lie level, the corner touches the plank and moves with its face
    along N. Midpoint steps from one time to the next.

    Args:
        rate_a, rate_b: of bar and plank at the start [rad/s].
        place: y of the corner at the start [m].
        times: equally spaced, (t,) [s].
        function: ``contact_bias``, (p, n, face, body_a, body_b) -> b.
    """
    # y, z and angle of the bar, then their rates.
    state = np.zeros(6)
    state[:2] = np.array([place, HALF]) - CORNER[1:]
    lever = -CORNER[1]
    state[4:] = rate_b * place + rate_a * lever, rate_a
    step = float(times[1] - times[0])
    states, forces = [], []
    for time in times:
        first, force = _rate(state, float(time), rate_b, function)
        states.append(state)
        forces.append(force)
        middle, _ = _rate(
            state + 0.5 * step * first, time + 0.5 * step, rate_b, function
        )
        if np.abs(state).max() < RUN_AWAY:
            state = state + step * middle
    return _held(times, np.array(states), rate_b, np.array(forces))


def terms_changed(
    p: Array, n: Array, face: str, body_a: tuple[Array, ...], body_b: tuple[Array, ...]
) -> Array:
    """b with 2 (p_A_ddot - p_B_ddot).N in the middle, as the slide repeats it (misprint 7)."""
    accelerations = [
        formulas.free_point_acceleration(v_dot, omega_dot, omega, p - x)
        for x, _, omega, v_dot, omega_dot in (body_a, body_b)
    ]
    return np.sum(3 * (accelerations[0] - accelerations[1]) * n, axis=-1)


def _rate(
    state: Array, time: float, rate_b: float, function: Bias
) -> tuple[Array, float]:
    """Rates of the state, and the force along N [N]."""
    x, corner, n = _places(state[None], np.array([time]), rate_b)
    v, spin = np.array([0.0, state[3], state[4]]), np.array([state[5], 0.0, 0.0])
    none = np.zeros(3)
    body_a = x[0], v, spin, np.array([0.0, 0.0, -GRAVITY]), none
    body_b = none, none, np.array([rate_b, 0.0, 0.0]), none, none
    b = one_number(function, corner[0], n[0], "face_b", body_a, body_b)
    turning = float(np.cross(corner[0] - x[0], n[0])[0])
    force = max(0.0, -b / (1 / MASS + turning**2 / INERTIA))
    push = force * n[0]
    pulled = [push[1] / MASS, push[2] / MASS - GRAVITY, force * turning / INERTIA]
    return np.concatenate([state[3:], pulled]), force


def _places(states: Array, times: Array, rate_b: float) -> tuple[Array, Array, Array]:
    """Centre and corner of the bar, and the plank's normal, (t, 3) each."""
    x = np.concatenate([0 * states[:, :1], states[:, :2]], axis=1)
    cos, sin = np.cos(states[:, 2]), np.sin(states[:, 2])
    y, z = CORNER[1:]
    corner = x + np.stack([0 * cos, cos * y - sin * z, sin * y + cos * z], axis=-1)
    turned = rate_b * times
    normal = np.stack([0 * turned, -np.sin(turned), np.cos(turned)], axis=-1)
    return x, corner, normal


def _held(times: Array, states: Array, rate_b: float, force: Array) -> HeldBar:
    x, corner, normal = _places(states, times, rate_b)
    gap = np.sum(corner * normal, axis=-1) - HALF
    angle = np.stack([states[:, 2], rate_b * times], axis=-1)
    return HeldBar(times, x, angle, gap, corner, normal, force)
