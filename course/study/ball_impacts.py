"""Balls that hit one another: Newton's cradle by laws and by springs, and the billiard break."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    failure,
    positive,
    scalar,
    scalars,
    vectors,
    whole_number,
)
from course.contact.collisions import LAWS, resolve_collisions
from course.dynamics.bodies import Bodies
from course.overlap.contact_arrays import Contacts

#: A pool ball: radius [m] and mass [kg] (2 1/4 inches and 6 ounces).
POOL_RADIUS, POOL_MASS = 0.028575, 0.17


def ball_contacts(
    position: ArrayLike, radius: ArrayLike, *, margin: float = 1e-9
) -> Contacts:
    """All pairs of balls closer than a margin, i < j, body A the one with the lower number.

    Args:
        position: centres, (n, 3) [m].
        radius: one or (n,) [m].
        margin: greatest gap that counts as touching [m].
    """
    x = vectors("position", position)
    r = np.broadcast_to(positive("radius", radius), x.shape[:1])
    first, second = np.triu_indices(len(x), 1)
    apart = x[first] - x[second]
    distance = np.sqrt(np.sum(apart**2, axis=-1))
    gap = distance - r[first] - r[second]
    near = gap <= margin
    if np.any(distance[near] == 0):
        raise failure("position", "centres apart from each other", "two equal ones")
    a, b = first[near], second[near]
    normal = apart[near] / distance[near, None]
    tangent = np.eye(3) - normal[:, :, None] * normal[:, None, :]
    return Contacts(
        body_a=a,
        body_b=b,
        point=x[a] - (r[a] + 0.5 * gap[near])[:, None] * normal,
        normal=normal,
        separation=gap[near],
        feature=np.full(a.size, "curved"),
        curvature_a=tangent / r[a, None, None],
        curvature_b=tangent / r[b, None, None],
    )


def touching_row(
    velocity: ArrayLike, *, mass: ArrayLike = 1.0, radius: float = 0.5
) -> tuple[Bodies, Contacts]:
    """n balls in a row along x, each touching the next, and their n - 1 contacts in order.

    Args:
        velocity: along x, (n,) [m/s].
        mass: one or (n,) [kg].
        radius: [m].
    """
    v = _speeds(velocity)
    r = float(positive("radius", scalar("radius", radius)))
    position = 2 * r * np.arange(v.size)[:, None] * [1.0, 0.0, 0.0]
    bodies = Bodies.balls(mass, r, position, v[:, None] * [1.0, 0.0, 0.0])
    return bodies, ball_contacts(position, r, margin=1e-6 * r)


def cradle(
    velocity: ArrayLike,
    *,
    law: str = "simultaneous",
    restitution: float = 1.0,
    mass: ArrayLike = 1.0,
) -> Array:
    """Velocities of a row of touching balls after they collide, by a law of ``resolve_collisions``, (n,)."""
    bodies, contacts = touching_row(velocity, mass=mass)
    return resolve_collisions(bodies, contacts, restitution, law=law).velocity[:, 0]


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
    from scipy.integrate import solve_ivp

    v = _speeds(velocity)
    n, power = v.size, scalar("exponent", exponent)
    if power < 1:
        raise failure("exponent", "at least 1", f"{power:g}")
    k = float(positive("stiffness", scalar("stiffness", stiffness)))
    m = np.broadcast_to(positive("mass", mass), v.shape)
    fastest = max(float(np.max(np.abs(v - np.mean(v)))), 1e-300)
    # Units in which mass, stiffness and the fastest ball are all 1.
    length = (float(np.max(m)) * fastest**2 / k) ** (1 / (power + 1))
    weight, unit = m / np.max(m), length / fastest

    def rate(_: float, state: Array) -> Array:
        push = np.concatenate(
            [[0.0], np.maximum(-np.diff(state[:n]), 0.0) ** power, [0.0]]
        )
        return np.concatenate([state[n:], (push[:-1] - push[1:]) / weight])

    state, pieces, began = np.concatenate([np.zeros(n), v / fastest]), [], 0.0
    for _ in range(1000):
        times = np.linspace(began, began + 2.0, 81)
        part = solve_ivp(
            rate,
            (began, began + 2.0),
            state,
            method="DOP853",
            t_eval=times,
            rtol=1e-10,
            atol=1e-12,
        )
        pieces.append((times[:-1], part.y[:, :-1]))
        state, began = part.y[:, -1], began + 2.0
        if np.all(np.diff(state[:n]) >= 0) and np.all(np.diff(state[n:]) >= 0):
            break
    pieces.append((np.array([began]), state[:, None]))
    time, states = (
        np.concatenate([p[0] for p in pieces]),
        np.concatenate([p[1] for p in pieces], axis=1),
    )
    force = k * (np.maximum(-np.diff(states[:n], axis=0), 0.0) * length) ** power
    return SpringCradle(
        time * unit,
        states[:n].T * length,
        states[n:].T * fastest,
        force.T,
        state[n:] * fastest,
    )


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


def rack(*, rows: int = 5, radius: float = POOL_RADIUS, spacing: float = 0.0) -> Array:
    """Centres of a triangle of balls in the plane z = 0, apex at the origin, opening toward +x, (n, 3) [m].

    Args:
        rows: 5 make 15 balls.
        spacing: gap between neighbours [m]; 0 makes them touch.
    """
    count, r = (
        whole_number("rows", rows, minimum=1),
        float(positive("radius", scalar("radius", radius))),
    )
    row = np.repeat(np.arange(count), np.arange(1, count + 1))
    place = np.concatenate([np.arange(k + 1) - 0.5 * k for k in range(count)])
    pitch = 2 * r + scalar("spacing", spacing)
    return pitch * np.stack([np.sqrt(0.75) * row, place, np.zeros(row.size)], axis=-1)


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
    speed: float = 8.0,
    offset: float = 0.0,
    law: str = "simultaneous",
    restitution: float = 1.0,
    rows: int = 5,
    radius: float = POOL_RADIUS,
    mass: float = POOL_MASS,
) -> BilliardBreak:
    """The cue ball, moving along +x, onto the apex of a rack of touching balls, by one of the laws.

    Args:
        speed: of the cue ball [m/s].
        offset: how far its path passes beside the apex ball's centre, below 2 radius [m].
        law, restitution: of ``resolve_collisions``.
        rows: of the rack; 5 make 15 balls.
    """
    balls, side = rack(rows=rows, radius=radius), scalar("offset", offset)
    if abs(side) >= 2 * radius:
        raise failure("offset", f"less than two radii, {2 * radius:g}", f"{side:g}")
    cue = np.array([-np.sqrt(4 * radius**2 - side**2), side, 0.0])
    position = np.concatenate([cue[None], balls])
    velocity = np.zeros(position.shape)
    velocity[0, 0] = positive("speed", scalar("speed", speed))
    before = Bodies.balls(mass, radius, position, velocity)
    contacts = ball_contacts(position, radius, margin=1e-6 * radius)
    after = resolve_collisions(before, contacts, restitution, law=law)
    return BilliardBreak(before, contacts, after, radius, law, restitution)


def _speeds(velocity: ArrayLike) -> Array:
    v = scalars("velocity", velocity)
    if v.ndim != 1 or v.size < 2:
        raise failure(
            "velocity",
            "the speeds of at least two balls, shape (n,)",
            f"shape {v.shape}",
        )
    return v
