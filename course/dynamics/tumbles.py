"""The exact motion of one body without torque, as arrays over time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course import rotations
from course.arrays import Array, ArrayLike, failure, scalars, vectors
from course.dynamics.bodies import Bodies
from course.dynamics.closed_form_motions import parabola
from course.dynamics.mass_properties import principal_axes
from course.dynamics.torque_free_top import torque_free_rotation


@dataclass(frozen=True, eq=False)
class BodyView:
    """The constant L as a turning body sees it, as a direction.

    Args:
        times: (t,) [s].
        direction: R'L/|L|, its parts along the principal axes, (t, 3).
        turnovers: when L lies across the axis that was asked for, (k,) [s].
    """

    times: Array
    direction: Array
    turnovers: Array


@dataclass(frozen=True, eq=False)
class EnergyLines:
    """Lines of equal energy on the sphere of directions of l = R'L, seen along each principal axis.

    Args:
        grid: of both coordinates of a view, in units of |L|, (k,).
        energy: seen along axis 0, 1, 2, with the next axis to the right and the one after it up, in
            units of |L|^2/2; NaN outside the sphere, (3, k, k) [1/(kg m^2)].
        levels: ascending, between the least and the largest energy, (l,) [1/(kg m^2)].
        direction: where l/|L| runs, (t, 3).
    """

    grid: Array
    energy: Array
    levels: Array
    direction: Array


@dataclass(frozen=True, eq=False)
class Tumble:
    """One body over time, t moments of it.

    Args:
        times: (t,) [s].
        moments: principal, about the centre of mass, (3,) [kg m^2].
        mass: [kg].
        position: of the centre of mass, (t, 3) [m].
        velocity: (t, 3) [m/s].
        rotation: principal axes to world axes, (t, 3, 3).
        angular_momentum: L, world axes, (3,) [kg m^2/s]; constant.
    """

    times: Array
    moments: Array
    mass: float
    position: Array
    velocity: Array
    rotation: Array
    angular_momentum: Array

    @property
    def seen_from_body(self) -> Array:
        """l = R'L: the constant L as the turning body sees it, (t, 3) [kg m^2/s]."""
        return np.einsum("tji,j->ti", self.rotation, self.angular_momentum)

    @property
    def angular_velocity(self) -> Array:
        """omega = R I^-1 R'L, world axes, (t, 3) [rad/s]."""
        return np.einsum(
            "tij,tj->ti", self.rotation, self.seen_from_body / self.moments
        )

    @property
    def turning_energy(self) -> Array:
        """l_i^2/(2 I_i), the energy of turning about each principal axis, (t, 3) [J]; their sum is constant."""
        return self.seen_from_body**2 / (2 * self.moments)

    def turnover_times(self, axis: int = 1) -> Array:
        """When L lies across a principal axis (0, 1, 2 from the least moment): half-way through each turnover [s].

        From the samples, by Hermite's cubic between two of them: the rate of l is l x omega.
        """
        from scipy.interpolate import CubicHermiteSpline

        l_body = self.seen_from_body
        rate = np.cross(l_body, l_body / self.moments)
        curve = CubicHermiteSpline(self.times, l_body[:, axis], rate[:, axis])
        return np.asarray(curve.roots(extrapolate=False))

    def body_view(self, axis: int = 1) -> BodyView:
        """Where L points in the body over time, and the ``turnover_times`` of an axis."""
        return BodyView(self.times, self._direction, self.turnover_times(axis))

    def energy_lines(self, points: int = 241, levels: int = 15) -> EnergyLines:
        """The energy sum_i l_i^2/I_i over the sphere |l| = 1, and where l runs on it.

        Args:
            points: of the grid in each coordinate.
            levels: how many lines, evenly spaced between the two extremes.
        """
        grid = np.linspace(-1, 1, points)
        x, y = np.meshgrid(grid, grid)
        depth = 1 - x**2 - y**2
        least, _, most = moments = self.moments
        energy = [
            x**2 / moments[(k + 1) % 3]
            + y**2 / moments[(k + 2) % 3]
            + depth / moments[k]
            for k in range(3)
        ]
        between = np.linspace(1 / most, 1 / least, levels + 2)[1:-1]
        seen = np.where(depth >= 0, np.stack(energy), np.nan)
        return EnergyLines(grid, seen, between, self._direction)

    @property
    def _direction(self) -> Array:
        return self.seen_from_body / np.linalg.norm(self.angular_momentum)


def free_tumble(
    bodies: Bodies, times: ArrayLike, *, gravity: ArrayLike = (0.0, 0.0, 0.0)
) -> Tumble:
    """The exact motion of one body without torque; even gravity bends its path and nothing else.

    Turning by Jacobi's elliptic functions (``torque_free_rotation``), the centre on its parabola.

    Args:
        bodies: exactly one, free.
        times: (t,) [s] from the state given.
        gravity: g, (3,) [m/s^2].
    """
    t = scalars("times", times)
    if len(bodies) != 1 or bodies.fixed[0]:
        raise failure(
            "bodies",
            "one body that is free to move",
            f"{len(bodies)} with {int(bodies.fixed.sum())} fixed",
        )
    if t.ndim != 1 or not t.size:
        raise failure("times", "shape (t,) with at least one", f"shape {t.shape}")
    moments, axes = principal_axes(bodies.inertia[0])
    start = bodies.rotation[0] @ axes
    _, turn = torque_free_rotation(moments, start.T @ bodies.angular_momentum[0], t)
    x, v = parabola(
        bodies.position[0], bodies.velocity[0], vectors("gravity", gravity), t
    )
    rotation = start @ rotations.to_matrix(turn)
    return Tumble(
        t, moments, float(bodies.mass[0]), x, v, rotation, bodies.angular_momentum[0]
    )


def orientation_error(bodies: Bodies, truth: Bodies) -> float:
    """The largest angle by which a body would have to be turned to stand as in the truth [rad]."""
    return float(rotations.angle_between(bodies.rotation, truth.rotation).max())
