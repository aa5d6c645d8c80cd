"""Balls that hit one another: Newton's cradle by laws and by springs, and the billiard break."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import Array, ArrayLike, failure, positive, scalar
from course.contact import resolve_collisions
from course.contact.collisions import LAWS
from course.dynamics import Bodies
from course.overlap import Contacts
from course.scenes import POOL_RADIUS, billiard_rack, touching_row


def cradle(
    velocity: ArrayLike,
    *,
    law: str = "simultaneous",
    restitution: float = 1.0,
    mass: ArrayLike = 1.0,
) -> Array:
    """Velocities of a row of touching balls after they collide, by a law of ``resolve_collisions``, (n,)."""
    row = touching_row(velocity, mass=mass)
    after = resolve_collisions(row.bodies, row.contacts, restitution, law=law)
    return after.velocity[:, 0]


@dataclass(frozen=True, eq=False)
class SpringCradle:
    """A row of balls with a spring at each contact.

    Args:
        time: (t,) [s].
        displacement: from where each ball stood, (t, n) [m].
        velocity: (t, n) [m/s].
        force: at each contact, pushing, (t, n - 1) [N].
        final: velocities once all have parted for good, (n,) [m/s].
    """

    time: Array
    displacement: Array
    velocity: Array
    force: Array
    final: Array


def cradle_by_springs(
    velocity: ArrayLike,
    *,
    exponent: float = 1.5,
    stiffness: float = 1.0,
    mass: ArrayLike = 1.0,
) -> SpringCradle:
    """Newton's cradle with its contacts as springs that push and never pull: f = k delta^exponent.

    Exponent 1.5 is the contact of two elastic spheres (Hertz), 1 a linear
    spring. m_i v_i' = f_(i-1) - f_i, by an eighth-order Runge-Kutta method at
    a tolerance of 1e-10. The final velocities do not depend on the stiffness:
    another k only changes the unit of time.

    Args:
        velocity: along x, (n,) [m/s].
        exponent: at least 1.
        stiffness: k [N/m^exponent].
        mass: one or (n,) [kg].
    Raises:
        ValueError: fewer than two balls, exponent below 1, stiffness or mass <= 0.
    """
    v = touching_row(velocity).bodies.velocity[:, 0]
    n, power = v.size, scalar("exponent", exponent)
    if power < 1:
        raise failure("exponent", "at least 1", f"{power:g}")
    k = float(positive("stiffness", scalar("stiffness", stiffness)))
    m = np.broadcast_to(positive("mass", mass), v.shape)
    fastest = max(float(np.max(np.abs(v - np.mean(v)))), 1e-300)
    # Units in which mass, stiffness and the fastest ball are all 1.
    length = (float(np.max(m)) * fastest**2 / k) ** (1 / (power + 1))
    time, states = _until_parted(v / fastest, m / np.max(m), power)
    position, speed = states[:, :n] * length, states[:, n:] * fastest
    force = k * np.maximum(-np.diff(position, axis=1), 0.0) ** power
    return SpringCradle(time * length / fastest, position, speed, force, speed[-1])


def _until_parted(v: Array, mass: Array, power: float) -> tuple[Array, Array]:
    """Times (t,) and displacements with velocities (t, 2n) of balls on springs of stiffness 1."""
    from scipy.integrate import solve_ivp

    n = v.size

    def rate(_: float, state: Array) -> Array:
        squeeze = np.maximum(-np.diff(state[:n]), 0.0) ** power
        push = np.concatenate([[0.0], squeeze, [0.0]])
        return np.concatenate([state[n:], (push[:-1] - push[1:]) / mass])

    state, pieces, began = np.concatenate([np.zeros(n), v]), [], 0.0
    for _ in range(1000):
        times = np.linspace(began, began + 2.0, 81)
        options = {"method": "DOP853", "t_eval": times, "rtol": 1e-10, "atol": 1e-12}
        part = solve_ivp(rate, times[[0, -1]], state, **options)
        pieces.append((times[:-1], part.y[:, :-1].T))
        state, began = part.y[:, -1], began + 2.0
        if np.all(np.diff(state[:n]) >= 0) and np.all(np.diff(state[n:]) >= 0):
            break
    pieces.append((np.array([began]), state[None]))
    time, states = (np.concatenate(column) for column in zip(*pieces, strict=True))
    return time, states


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
    v = touching_row(velocity).bodies.velocity[:, 0]
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


@dataclass(frozen=True, eq=False)
class CradleComparison:
    """Final velocities of one cradle by several models, and how far each is from the Hertz contact.

    Args:
        model: names, (k,): the laws, "linear springs", "Hertz springs".
        velocity: (k, n) [m/s].
        difference: greatest over the balls, from the Hertz springs, (k,) [m/s].
    """

    model: tuple[str, ...]
    velocity: Array
    difference: Array


def compare_cradles(velocity: ArrayLike) -> CradleComparison:
    """The same cradle at e = 1 by every law and by springs of two kinds: no single law is the truth."""
    rows = [cradle(velocity, law=law) for law in LAWS]
    rows += [cradle_by_springs(velocity, exponent=power).final for power in (1.0, 1.5)]
    table = np.array(rows)
    return CradleComparison(
        (*LAWS, "linear springs", "Hertz springs"),
        table,
        np.abs(table - table[-1]).max(axis=1),
    )


@dataclass(frozen=True, eq=False)
class BilliardBreak:
    """A break at the moment the cue ball (body 0) touches the rack, and after it."""

    before: Bodies
    contacts: Contacts
    after: Bodies
    radius: float
    law: str
    restitution: float


def billiard_break(
    *,
    law: str = "simultaneous",
    restitution: float = 1.0,
    radius: float = POOL_RADIUS,
    **rack: Any,
) -> BilliardBreak:
    """The cue ball onto the apex of a rack of touching balls, by one of the laws.

    Args:
        law, restitution: of ``resolve_collisions``.
        radius: of every ball [m].
        rack: speed, offset, rows and mass, of ``course.scenes.billiard_rack``.
    """
    scene = billiard_rack(radius=radius, **rack)
    before, contacts = scene.bodies, scene.contacts
    after = resolve_collisions(before, contacts, restitution, law=law)
    return BilliardBreak(before, contacts, after, radius, law, restitution)
