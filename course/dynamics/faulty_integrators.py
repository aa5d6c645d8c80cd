"""Two common but wrong updates, to be measured: each loses what the exact motion keeps.

They work on plain arrays and never on ``Bodies``, whose unit quaternions they would
break. ``course.dynamics.integrators`` has the right ones.
"""

from __future__ import annotations

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    broadcast,
    failure,
    inertias,
    scalars,
    vectors,
)


def body_frame_euler(
    angular_momentum: ArrayLike,
    inertia: ArrayLike,
    step: ArrayLike,
    *,
    torque: ArrayLike = (0.0, 0.0, 0.0),
) -> Array:
    """Explicit Euler on the angular momentum in body axes: l' = l + h (tau + l x
    omega), omega = I^-1 l.

    With no torque the body-frame l only turns, yet each step adds a vector
    across it: |l|^2 grows by h^2 |l x omega|^2. L in world axes has no such
    term, which is why ``Bodies`` keeps it there.

    Args:
        angular_momentum: l, in body axes, (..., 3) [kg m^2/s].
        inertia: about the centre of mass in body axes, (..., 3, 3) [kg m^2].
        step: h, (...) [s].
        torque: in body axes, (..., 3) [N m].
    Returns:
        l', (..., 3) [kg m^2/s].
    Raises:
        ValueError: a wrong shape, an inertia not symmetric and positive definite, NaN
            or infinity.
    """
    l, tensor = (  # noqa: E741
        vectors("angular_momentum", angular_momentum),
        inertias("inertia", inertia),
    )
    h, tau = scalars("step", step), vectors("torque", torque)
    broadcast(
        angular_momentum=(l, 1), inertia=(tensor, 2), step=(h, 0), torque=(tau, 1)
    )
    omega = np.linalg.solve(tensor, l[..., None])[..., 0]
    return l + h[..., None] * (tau + np.cross(l, omega))


def quaternion_euler(
    orientation: ArrayLike,
    angular_velocity: ArrayLike,
    step: ArrayLike,
    *,
    renormalize: bool = False,
) -> Array:
    """Explicit Euler on a quaternion: q' = q + h/2 (omega, 0) q, with or without
    bringing it back to length 1.

    With x = h |omega|: |q|^2 grows by the factor 1 + x^2/4 a step.
    Renormalised, each step turns by 2 atan(x/2) in place of x, too little by
    the factor (2/x) atan(x/2), about 1 - x^2/12. The exponential map does
    neither.

    Args:
        orientation: q, (..., 4), scalar last; of any length above 0, because it grows.
        angular_velocity: omega, world axes, (..., 3) [rad/s].
        step: h, (...) [s].
        renormalize: divide by the length after the step.
    Returns:
        q', (..., 4).
    Raises:
        ValueError: a quaternion of length 0, a wrong shape, NaN or infinity.
    """
    q = vectors("orientation", orientation, size=4)
    omega, h = vectors("angular_velocity", angular_velocity), scalars("step", step)
    batch = broadcast(orientation=(q, 1), angular_velocity=(omega, 1), step=(h, 0))
    if not np.all(np.any(q != 0, axis=-1)):
        raise failure("orientation", "quaternions of length above 0", "length 0.0")
    u, w = q[..., :3], q[..., 3:]
    rate = np.empty((*np.broadcast_shapes(q.shape[:-1], omega.shape[:-1]), 4))
    rate[..., :3] = 0.5 * (w * omega + np.cross(omega, u))
    rate[..., 3] = -0.5 * np.sum(omega * u, axis=-1)
    result = np.broadcast_to(q + h[..., None] * rate, (*batch, 4))
    return (
        result / np.linalg.norm(result, axis=-1, keepdims=True)
        if renormalize
        else np.array(result)
    )
