"""A particle stepped down a dome until a rule lets it go; ``course.dynamics.Dome`` has the closed form."""

from __future__ import annotations

import numpy as np

from course.arrays import Array, choice, failure, positive, scalar
from course.dynamics import Dome

RULES = ("as printed", "with curvature", "with curvature, located")


def slide_off(
    dome: Dome, step: float, *, rule: str = "with curvature"
) -> tuple[float, int]:
    """Step a particle down the dome until d_ddot without a force is positive.

    theta_ddot = (g/R) sin theta by the classical Runge-Kutta method of order
    4 (E. Hairer, S. Norsett, G. Wanner, *Solving Ordinary Differential
    Equations I*, section II.1), from rest at theta_0, which must be above 0.

    Args:
        dome: with a start above 0.
        step: [s].
        rule: "as printed" and "with curvature" stop at the first step past the
            sign change, "with curvature, located" puts a straight line through
            the last two values and takes its zero.
    Returns:
        The angle where it leaves [rad] and the number of evaluations of theta_ddot.
    Raises:
        ValueError: a start of 0, where it would rest; a step that is not positive; an unknown rule.
    """
    choice("rule", rule, RULES)
    h = float(positive("step", scalar("step", step)))
    if dome.start == 0:
        raise failure(
            "dome.start", "an angle above 0, from where it slides by itself", "0"
        )
    pull, factor = dome.gravity / dome.radius, 2.0 if rule == "as printed" else 1.0
    state, count = np.array([dome.start, 0.0]), 0
    value = before = -np.inf
    last = state
    while value <= 0:
        last, before = state, value
        k_1 = _rate(state, pull)
        k_2 = _rate(state + 0.5 * h * k_1, pull)
        k_3 = _rate(state + 0.5 * h * k_2, pull)
        state = state + h / 6 * (k_1 + 2 * k_2 + 2 * k_3 + _rate(state + h * k_3, pull))
        count += 4
        value = factor * state[1] ** 2 - pull * np.cos(state[0])
    if rule == "with curvature, located" and np.isfinite(before):
        return float(last[0] + (state[0] - last[0]) * before / (before - value)), count
    return float(state[0]), count


def _rate(state: Array, pull: float) -> Array:
    return np.array([state[1], pull * np.sin(state[0])])
