"""Energy, momentum and angular momentum: of one body, and of all together (syllabus row
14).
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array, ArrayLike, broadcast, failure, positive, vectors
from course.dynamics.bodies import Bodies


def linear_kinetic_energy(momentum: ArrayLike, velocity: ArrayLike) -> Array:
    """T_linear = p.v/2 (syllabus row 14).

    Args:
        momentum: p, (..., 3) [kg m/s].
        velocity: v, of the centre of mass, (..., 3) [m/s].
    Returns:
        (...) [J]; 0 for a fixed body, which has p = 0 and v = 0.
    Raises:
        ValueError: a wrong shape, NaN or infinity.
    """
    p, v = vectors("momentum", momentum), vectors("velocity", velocity)
    broadcast(momentum=(p, 1), velocity=(v, 1))
    return np.sum(0.5 * p * v, axis=-1)


def angular_kinetic_energy(
    angular_momentum: ArrayLike, angular_velocity: ArrayLike
) -> Array:
    """T_angular = L.omega/2 (syllabus row 14).

    Both in world axes, or both in body axes.

    Args:
        angular_momentum: L, about the centre of mass, (..., 3) [kg m^2/s].
        angular_velocity: omega, (..., 3) [rad/s].
    Returns:
        (...) [J]; 0 for a fixed body, which has L = 0 and omega = 0.
    Raises:
        ValueError: a wrong shape, NaN or infinity.
    """
    L, omega = (
        vectors("angular_momentum", angular_momentum),
        vectors("angular_velocity", angular_velocity),
    )
    broadcast(angular_momentum=(L, 1), angular_velocity=(omega, 1))
    return np.sum(0.5 * L * omega, axis=-1)


def potential_energy(mass: ArrayLike, position: ArrayLike, gravity: ArrayLike) -> Array:
    """V = -m g.x, the part V of E = V + T in a uniform field (syllabus row 14).

    0 at the origin.

    Args:
        mass: m, (...) [kg]; a body of infinite mass does not fall, and its V is 0.
        position: x, of the centre of mass, (..., 3) [m].
        gravity: g, (..., 3) [m/s^2], for instance (0, 0, -9.81).
    Returns:
        (...) [J].
    Raises:
        ValueError: mass <= 0, a wrong shape, NaN, infinity but in the mass.
    """
    m, x, g = (
        positive("mass", mass, infinite=True),
        vectors("position", position),
        vectors("gravity", gravity),
    )
    broadcast(mass=(m, 0), position=(x, 1), gravity=(g, 1))
    return -np.where(np.isfinite(m), m, 0.0) * np.sum(g * x, axis=-1)


def kinetic_energy(bodies: Bodies) -> Array:
    """T = p.v/2 + L.omega/2 of each body (syllabus row 14), (n,) [J].

    0 for a fixed one.
    """
    linear = linear_kinetic_energy(bodies.momentum, bodies.velocity)
    return linear + angular_kinetic_energy(
        bodies.angular_momentum, bodies.angular_velocity
    )


def total_energy(bodies: Bodies, gravity: ArrayLike = (0.0, 0.0, 0.0)) -> float:
    """E = V + T of all bodies together (syllabus row 14); fixed ones add nothing.

    Args:
        bodies: n bodies.
        gravity: g, (3,) [m/s^2].
    Returns:
        E [J].
    """
    g = _one_vector("gravity", gravity)
    return float(
        np.sum(
            kinetic_energy(bodies) + potential_energy(bodies.mass, bodies.position, g)
        )
    )


def total_momentum(bodies: Bodies) -> Array:
    """The sum of p, (3,) [kg m/s].

    Constant while no outer force acts (syllabus row 15).
    """
    return bodies.momentum.sum(axis=0)


def total_angular_momentum(bodies: Bodies, point: ArrayLike = (0.0, 0.0, 0.0)) -> Array:
    """The sum of L + (x - c) x p about a point c at rest, (3,) [kg m^2/s].

    Each body's angular momentum about its own centre, and that of its centre's motion
    (Goldstein, *Classical Mechanics*, section 1.2). Constant while no external force or
    torque acts.

    Args:
        bodies: n bodies.
        point: c, (3,) [m]; default: the origin.
    """
    arm = bodies.position - _one_vector("point", point)
    return (bodies.angular_momentum + np.cross(arm, bodies.momentum)).sum(axis=0)


def _one_vector(name: str, value: ArrayLike) -> Array:
    array = vectors(name, value)
    if array.shape != (3,):
        raise failure(name, "shape (3,)", f"shape {array.shape}")
    return array
