"""Bodies as clouds of point masses: what the formulas say of a body, added up over its
points."""

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation


@dataclass(frozen=True)
class Cloud:
    """Point masses m (k,) at r (k, 3) from their centre of mass."""

    m: np.ndarray
    r: np.ndarray

    @property
    def mass(self):
        return self.m.sum()

    @property
    def inertia(self):
        """The sum of m (r.r 1 - r r'), (3, 3)."""
        return sum(
            m * (r @ r * np.eye(3) - np.outer(r, r))
            for m, r in zip(self.m, self.r, strict=True)
        )

    def turned(self, rotation):
        return Cloud(self.m, self.r @ np.asarray(rotation).T)

    def velocities(self, v, omega):
        return v + np.cross(omega, self.r)


def drawn_cloud(rng, points=7):
    m = rng.uniform(0.2, 1.5, points)
    r = rng.normal(size=(points, 3))
    return Cloud(m, r - m @ r / m.sum())


def turn(theta):
    """The rotation matrix of a rotation vector, by SciPy."""
    return Rotation.from_rotvec(theta).as_matrix()


def carried(motion, t):
    """x and R of a body after t, from (x, v, omega, v_dot, omega_dot), right to t^2."""
    x, v, omega, v_dot, omega_dot = motion
    place = x + t * v + t**2 / 2 * v_dot
    return place, turn(t * omega + t**2 / 2 * omega_dot)


def unit(v):
    """Vectors (..., 3) made one long."""
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def rate(f, h=1e-5):
    """f'(0) by a central difference, good to h^2."""
    return (f(h) - f(-h)) / (2 * h)


def second_rate(f, h=1e-3):
    """f''(0) by a five-point difference, good to h^4."""
    near, far = f(h) + f(-h), f(2 * h) + f(-2 * h)
    return (16 * near - far - 30 * f(0.0)) / (12 * h**2)
