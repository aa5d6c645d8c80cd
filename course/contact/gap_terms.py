"""The terms of d_ddot, each with the size of what it was added up from (syllabus rows 20, 23 and 24)."""

from __future__ import annotations

import numpy as np

from course.arrays import Array, ArrayLike, shaped, vectors
from course.contact.moving_points import (
    ContactMotion,
    carried_normal_rate,
    contact_motion,
    of_feature,
)
from course.dynamics.bodies import Bodies
from course.overlap.contact_arrays import Contacts


def signed_terms(
    bodies: Bodies, contacts: Contacts, force: ArrayLike, torque: ArrayLike
) -> dict[str, tuple[Array, Array]]:
    """The terms of ``separation_acceleration_terms``, each with the sum of the magnitudes it was added up from.

    A sum whose value is some 1e-16 of those magnitudes is rounding noise.
    """
    f, tau = vectors("force", force), vectors("torque", torque)
    shaped("force", f, (len(bodies), 3))
    shaped("torque", tau, (len(bodies), 3))
    motion, n = contact_motion(bodies, contacts), contacts.normal
    inverse, omega, momentum = (
        bodies.world_inverse_inertia,
        bodies.angular_velocity,
        bodies.angular_momentum,
    )
    tau = np.where(bodies.fixed[:, None], 0.0, tau)
    gyroscopic = np.cross(momentum, omega)  # L x omega
    gyroscopic_size = _cross_size(momentum, omega)
    terms = {
        name: np.zeros((2, len(contacts)))
        for name in ("force", "torque", "gyroscopic", "centripetal")
    }
    for body, arm, sign in (
        (motion.a, motion.arm_a, 1.0),
        (motion.b, motion.arm_b, -1.0),
    ):
        lever = np.cross(arm, n)  # N.(alpha x r) = alpha.(r x N)
        lever_size = _cross_size(arm, n)
        acceleration = (f * bodies.inverse_mass[:, None])[body]
        terms["force"] += _dot(sign * n, acceleration, np.abs(n), np.abs(acceleration))
        for name, moment, moment_size in (
            ("torque", tau, np.abs(tau)), ("gyroscopic", gyroscopic, gyroscopic_size)
        ):  # fmt: skip
            alpha = np.einsum("nij,nj->ni", inverse, moment)[body]
            alpha_size = np.einsum("nij,nj->ni", np.abs(inverse), moment_size)[body]
            terms[name] += _dot(sign * alpha, lever, alpha_size, lever_size)
        w = omega[body]
        inward = np.cross(w, np.cross(w, arm))
        terms["centripetal"] += _dot(
            sign * n, inward, np.abs(n), _cross_size(w, _cross_size(w, arm))
        )
    result = {name: (value[0], value[1]) for name, value in terms.items()}
    return result | _turning_terms(motion, contacts)


def _turning_terms(
    motion: ContactMotion, contacts: Contacts
) -> dict[str, tuple[Array, Array]]:
    """The terms that come from the normal's turning: "normal", "curvature", "gap"."""
    n_dot = carried_normal_rate(motion, contacts)
    curved, curvature = of_feature(contacts, "curved"), np.zeros((2, len(contacts)))
    if motion.curved is not None:
        curvature[:, curved] = motion.curved.curvature, motion.curved.curvature_size
    normal = 2 * _dot(motion.relative, n_dot, np.abs(motion.relative), np.abs(n_dot))
    gap = np.where(curved, 0.0, -contacts.separation * np.sum(n_dot**2, axis=1))
    return {
        "normal": (normal[0], normal[1]),
        "curvature": (curvature[0], curvature[1]),
        "gap": (gap, np.abs(gap)),
    }


def _dot(x: Array, y: Array, x_size: Array, y_size: Array) -> Array:
    """Rows (2, c): the scalar products, and the sums of the magnitudes of what they were added up from."""
    return np.stack([np.sum(x * y, axis=1), np.sum(x_size * y_size, axis=1)])


def _cross_size(x: Array, y: Array) -> Array:
    """The magnitudes that each component of x cross y was added up from."""
    x, y = np.abs(x), np.abs(y)
    return x[:, [1, 2, 0]] * y[:, [2, 0, 1]] + x[:, [2, 0, 1]] * y[:, [1, 2, 0]]
