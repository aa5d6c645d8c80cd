"""Newton's cradle with springs and a fixed step: the knob of the work-precision chart."""

from __future__ import annotations

import numpy as np

from course.arrays import Array, ArrayLike, failure, positive, scalar, scalars


def cradle_by_steps(
    velocity: ArrayLike, step: float, *, exponent: float = 1.5
) -> tuple[Array, int]:
    """Final velocities of a row of touching equal balls, by velocity Verlet on contact springs, and the work.

    f = k delta^exponent pushes and never pulls (1.5: elastic spheres, Hertz;
    1: linear). Mass and stiffness are 1: another stiffness only changes the
    unit of time. It stops when the balls touch no more and part, or, should
    rounding keep two of equal speed together, after 1000 units of time.

    Args:
        velocity: along x, (n,) [m/s].
        step: in units of (m/k)^(1/2) (for exponent 1).
        exponent: at least 1.
    Returns:
        Velocities (n,) [m/s] and the number of force evaluations.
    """
    v = np.array(scalars("velocity", velocity))
    if v.ndim != 1 or v.size < 2:
        raise failure(
            "velocity",
            "the speeds of at least two balls, shape (n,)",
            f"shape {v.shape}",
        )
    h, power = (
        float(positive("step", scalar("step", step))),
        scalar("exponent", exponent),
    )
    x, push = np.zeros(v.size), np.zeros(v.size)
    count = 0
    while count * h < 1000.0:
        v_half = v + 0.5 * h * push
        x = x + h * v_half
        squeeze = np.maximum(x[:-1] - x[1:], 0.0) ** power
        push = np.append(0.0, squeeze) - np.append(squeeze, 0.0)
        v = v_half + 0.5 * h * push
        count += 1
        if not squeeze.any() and np.all(np.diff(v) >= 0):
            break
    return v, count
