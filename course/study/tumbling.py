"""A body that turns with no torque on it: the handle in space, its exact motion, and how fast a wobble grows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from course import rotations
from course.arrays import (
    Array,
    ArrayLike,
    failure,
    positive,
    scalar,
    scalars,
    vectors,
    written,
)
from course.dynamics import (
    Bodies,
    Wrench,
    box_mass_properties,
    combined_mass_properties,
    parabola,
    principal_axes,
    splitting,
    torque_free_rotation,
)
from course.study.stability import Integrator, growth_rate

#: A steel T: a crossbar along axis 1 and a stem along axis 2, both 2 cm by 2 cm; centres and half extents [m]
#: about the middle of the crossbar, and the density [kg/m^3].
HANDLE_CENTERS = np.array([[0.0, 0.0, 0.0], [0.0, 0.06, 0.0]])
HANDLE_HALF_EXTENTS = np.array([[0.1, 0.01, 0.01], [0.01, 0.05, 0.01]])
STEEL = 7850.0

#: A plain step on arrays: (x, R, p, L, mass, I_body, force, torque, h) -> (x, R, p, L) one step on.
PlainStep = Callable[..., tuple[Array, Array, Array, Array]]


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


def handle_mass_properties() -> Any:
    """Mass, centre and inertia of the steel T, in axes through the middle of its crossbar."""
    boxes = zip(HANDLE_CENTERS, HANDLE_HALF_EXTENTS, strict=True)
    return combined_mass_properties(
        [box_mass_properties(c, np.eye(3), e, density=STEEL) for c, e in boxes]
    )


def spinning_handle(
    *, tilt: float = np.radians(1.0), spin: float = 6.0, axis: int = 1
) -> Bodies:
    """The handle at the origin, L upright, and one of its axes almost along L.

    The moments are least about the crossbar (axis 0), middle about the stem
    (axis 1), largest about the axis across both (axis 2).

    Args:
        tilt: angle between L and that axis [rad]; L leans toward the next axis.
        spin: |L| over the moment about that axis [rad/s].
        axis: 0, 1 or 2.
    """
    solid = handle_mass_properties()
    return spinning_body(
        np.diag(solid.inertia), mass=float(solid.mass), tilt=tilt, spin=spin, axis=axis
    )


def spinning_body(
    moments: ArrayLike,
    *,
    mass: float = 1.0,
    tilt: float = np.radians(1.0),
    spin: float = 6.0,
    axis: int = 1,
) -> Bodies:
    """One body at the origin, L upright, and one of its axes almost along L.

    Args:
        moments: about its centre, (3,) [kg m^2]; the axes are numbered as they stand here.
        mass: [kg].
        tilt: angle between L and the axis of the spin [rad]; L leans toward the next axis.
        spin: |L| over the moment about that axis [rad/s].
        axis: 0, 1 or 2.
    """
    moment = positive("moments", vectors("moments", moments))
    if moment.ndim != 1:
        raise failure("moments", "shape (3,)", f"shape {moment.shape}")
    if axis not in (0, 1, 2):
        raise failure("axis", "0, 1 or 2", written(axis))
    leaning = _leaning(axis, scalar("tilt", tilt))
    # The least turn that takes the leaning direction to the world's z.
    up = np.array([0.0, 0.0, 1.0])
    across = np.cross(leaning, up)
    size = float(np.linalg.norm(across))
    angle = np.arctan2(size, leaning @ up)
    turn = rotations.from_rotation_vector(
        angle * across / size if size > 0 else angle * np.array([1.0, 0.0, 0.0])
    )
    none = np.zeros((1, 3))
    length = moment[axis] * scalar("spin", spin)
    return Bodies(
        np.array([mass]),
        np.diag(moment)[None],
        none,
        turn[None],
        none,
        length * up[None],
    )


def free_tumble(
    bodies: Bodies, times: ArrayLike, *, gravity: ArrayLike = (0.0, 0.0, 0.0)
) -> Tumble:
    """The exact motion of one body without torque; even gravity bends its path and nothing else.

    Turning by Jacobi's elliptic functions (``course.dynamics.torque_free_rotation``), the centre on its parabola.

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


def turnover_times(tumble: Tumble, axis: int = 1) -> Array:
    """When L lies across a principal axis (0, 1, 2 from the least moment): half-way through each turning over [s].

    From the samples, by Hermite's cubic between two of them: the rate of l is l x omega.
    """
    from scipy.interpolate import CubicHermiteSpline

    l_body = tumble.seen_from_body
    rate = np.cross(l_body, l_body / tumble.moments)
    roots = CubicHermiteSpline(tumble.times, l_body[:, axis], rate[:, axis]).roots(
        extrapolate=False
    )
    return np.asarray(roots)


def tilt_growth(
    moments: ArrayLike,
    *,
    axis: int = 1,
    spin: float = 1.0,
    tilt: float = 1e-6,
    turns: float = 10.0,
) -> Array:
    """How fast a small tilt grows, measured on the motion [1/s]; 0 where it does not.

    Where the tilt comes to ten times its start, the slope of its logarithm from there until it is a hundredth of a
    radian. The motion is that of ``splitting`` of order 4 with 60 steps a turn.

    Args:
        moments: of n bodies, (n, 3) [kg m^2]; the axes are numbered as they stand here.
        axis: the one that the bodies spin about, 0, 1 or 2.
        spin: Omega, |L| over the moment about that axis [rad/s].
        tilt: at the start, of L toward the next axis [rad].
        turns: how long they are watched, in turns of 2 pi/Omega.
    Returns:
        (n,).
    """
    moment = positive("moments", vectors("moments", moments))
    if moment.ndim != 2:
        raise failure("moments", "shape (n, 3)", f"shape {moment.shape}")
    several = [spinning_body(one, tilt=tilt, spin=spin, axis=axis) for one in moment]
    bodies = Bodies.concatenate(several)
    step = 2 * np.pi / abs(scalar("spin", spin)) / 60
    times: Array = step * np.arange(round(60 * turns) + 1, dtype=float)
    across = []
    for _ in times:
        seen = np.einsum("nji,nj->ni", bodies.rotation, bodies.angular_momentum)
        across.append(
            np.linalg.norm(np.delete(seen, axis, axis=1), axis=1)
            / np.linalg.norm(seen, axis=1)
        )
        bodies = splitting(bodies, None, step, order=4)
    return np.array(
        [_slope_between(times, one, 10 * tilt, 1e-2) for one in np.transpose(across)]
    )


def method_of(plain: PlainStep) -> Integrator:
    """A step on plain arrays as a method with the house's signature.

    Args:
        plain: (x, R, p, L, mass, I_body, force, torque, h) -> (x, R, p, L), as the exercise symplectic_euler_step
            has it, for n bodies at once.
    """

    def method(
        bodies: Bodies, wrench: Wrench | None, step: float, *, time: float = 0.0
    ) -> Bodies:
        none = np.zeros(bodies.position.shape)
        force, torque = (none, none) if wrench is None else wrench(bodies, time)
        x, turned, p, momentum = plain(
            bodies.position, bodies.rotation, bodies.momentum, bodies.angular_momentum,
            bodies.mass, bodies.inertia, force, torque, step,
        )  # fmt: skip
        return replace(
            bodies,
            position=x,
            orientation=rotations.from_matrix(turned),
            momentum=p,
            angular_momentum=momentum,
        )

    return method


def even_spin_error(bodies: Bodies, times: ArrayLike) -> Array:
    """How far off the cheapest model of turning is, which keeps omega as it is, at each time, (t,) [rad].

    Exact for a ball, and about a principal axis.

    Args:
        bodies: exactly one, with no torque on it.
        times: (t,) [s].
    """
    truth = free_tumble(bodies, times)
    even = rotations.turned(
        bodies.orientation, truth.times[:, None] * bodies.angular_velocity
    )
    _, axes = principal_axes(bodies.inertia[0])
    return _angle_between(rotations.to_matrix(even) @ axes, truth.rotation)


def turn_for(
    bodies: Bodies, method: Integrator, duration: float, step: float, **options: Any
) -> Bodies:
    """The bodies after a time without forces, by as many whole steps of at most ``step`` as it takes [s]."""
    count = max(1, round(duration / scalar("step", step)))
    for _ in range(count):
        bodies = method(bodies, None, duration / count, **options)
    return bodies


def turn_by_plain_steps(
    bodies: Bodies, plain: PlainStep, duration: float, step: float
) -> Bodies:
    """As ``turn_for``, by a step on plain arrays, with no checks between the steps."""
    count = max(1, round(duration / scalar("step", step)))
    none = np.zeros(bodies.position.shape)
    x, turned, p, momentum = (
        bodies.position,
        bodies.rotation,
        bodies.momentum,
        bodies.angular_momentum,
    )
    for _ in range(count):
        x, turned, p, momentum = plain(
            x,
            turned,
            p,
            momentum,
            bodies.mass,
            bodies.inertia,
            none,
            none,
            duration / count,
        )
    return replace(
        bodies,
        position=x,
        orientation=rotations.from_matrix(turned),
        momentum=p,
        angular_momentum=momentum,
    )


def turn_in_body_axes(bodies: Bodies, duration: float, step: float) -> Bodies:
    """As ``turn_for``, by Euler as it is often written: on l in body axes, and on the quaternion, renormalised.

    Each half of it, with what it loses, stands in ``course.dynamics``: ``body_frame_euler``, ``quaternion_euler``.
    """
    count = max(1, round(duration / scalar("step", step)))
    h, inverse, q = duration / count, np.linalg.inv(bodies.inertia), bodies.orientation
    l_body = np.einsum("nji,nj->ni", bodies.rotation, bodies.angular_momentum)
    for _ in range(count):
        omega = np.einsum("nij,nj->ni", inverse, l_body)
        u, w = q[:, :3], q[:, 3:]
        along = w * omega + np.cross(u, omega)
        q = q + 0.5 * h * np.concatenate(
            [along, -np.sum(u * omega, axis=-1, keepdims=True)], axis=-1
        )
        q = q / np.linalg.norm(q, axis=-1, keepdims=True)
        l_body = l_body + h * np.cross(l_body, omega)
    position = bodies.position + duration * bodies.velocity
    return replace(
        bodies,
        position=position,
        orientation=q,
        angular_momentum=rotations.rotate(q, l_body),
    )


def orientation_error(bodies: Bodies, truth: Bodies) -> float:
    """The largest angle by which a body would have to be turned to stand as in the truth [rad]."""
    return float(_angle_between(bodies.rotation, truth.rotation).max())


def counting_wrench() -> tuple[Wrench, list[int]]:
    """A wrench of zeros that counts how often it is asked, and the list whose one entry is that count."""
    asked = [0]

    def wrench(bodies: Bodies, time: float) -> tuple[Array, Array]:
        asked[0] += 1
        return np.zeros(bodies.position.shape), np.zeros(bodies.position.shape)

    return wrench, asked


def _angle_between(one: Array, other: Array) -> Array:
    """The angle of the turn that takes one rotation matrix to the other, (...) [rad]; exact for small ones too."""
    apart = np.swapaxes(other, -1, -2) @ one
    sine = (
        0.5
        * np.linalg.norm(apart - np.swapaxes(apart, -1, -2), axis=(-2, -1))
        / np.sqrt(2.0)
    )
    return np.asarray(
        np.arctan2(sine, 0.5 * (np.trace(apart, axis1=-2, axis2=-1) - 1.0))
    )


def _slope_between(times: Array, sizes: Array, low: float, high: float) -> float:
    """The rate of growth while a size is between two bounds for the first time; 0 where it never is."""
    within = (np.maximum.accumulate(sizes) > low) & (
        np.maximum.accumulate(sizes) < high
    )
    return growth_rate(times[within], sizes[within]) if within.sum() > 2 else 0.0


def _leaning(axis: int, tilt: float) -> Array:
    """The unit vector along an axis, leaning toward the next one: from the stem toward axis 3."""
    direction = np.zeros(3)
    direction[axis], direction[(axis + 1) % 3] = np.cos(tilt), np.sin(tilt)
    return direction
