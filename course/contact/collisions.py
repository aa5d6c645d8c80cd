"""Collisions of any number of bodies at one instant, by three laws."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from course.arrays import Array, BoolArray, IntArray, choice, failure, in_range
from course.contact.solvers.nnls import nonnegative_least_squares
from course.dynamics.bodies import Bodies
from course.dynamics.impulses_at_points import (
    apply_impulse,
    effective_mass,
    normal_velocity,
)
from course.overlap.contact_arrays import Contacts

LAWS = ("simultaneous", "sequential", "reflection")
#: A contact approaches while its normal velocity is below -APPROACHING times
#: the fastest approach at the start (of the bodies connected by contacts).
APPROACHING = 1e-12
#: How often all contacts of connected bodies are gone through before giving up.
MAX_ROUNDS = 50_000


class CollisionsUnresolved(RuntimeError):
    """Some contact still approached after MAX_ROUNDS rounds; ``bodies`` is the state reached.

    A ball pinned between two fixed walls at e = 1 is the plainest case: no
    outcome keeps its energy and parts from both. "reflection" raises there at
    any e, because its elastic answer is sought first, for e < 1 as well.
    """

    def __init__(self, message: str, bodies: Bodies) -> None:
        super().__init__(message)
        self.bodies = bodies


def resolve_collisions(
    bodies: Bodies, contacts: Contacts, restitution: float, *, law: str = "simultaneous"
) -> Bodies:
    """The bodies after all their collisions, when no contact approaches any more.

    With u the normal velocities, A = J M^-1 J' and impulses p (syllabus rows
    15-17, 21-22), bodies turning as well:

    "simultaneous": over the contacts that do not part (u <= 0, touching at
        rest counts), p >= 0, u' + e u >= 0, p.(u' + e u) = 0; repeated until
        none approaches, as a contact that parted may approach afterwards.
        The energy changes by (1 - e) p.u / 2 <= 0.
    "sequential": each approaching contact in turn, in the order given, as if
        it were alone; repeated until none approaches. The order matters.
    "reflection": over the contacts that approach, the elastic answer of the
        simultaneous law; repeated until none approaches (B. Smith, D. Kaufman,
        E. Vouga, R. Tamstorf, E. Grinspun, "Reflections on simultaneous
        impact", ACM Transactions on Graphics 31(4), 2012). For e < 1 the
        mixture (1 - e) plastic + e reflected of that and the outcome that
        loses most energy; both part everywhere, so the mixture does.

    Every law keeps the momentum and angular momentum of bodies that are free,
    gains no energy, and keeps it at e = 1. They agree on a single contact and
    differ on many; no single law is the truth. Nothing happens to bodies that
    part. Every contact given counts as touching, whatever its separation.

    Approaching means u < -1e-12 times the fastest approach before (or below
    rounding, 9e-16 times the largest speed, where that is more). Where the
    exact sequence is infinite, reaching that is success. "reflection" raises on
    a ball pinned between fixed bodies at any e, the other two above e = 0.999. At
    e = 0 "sequential" hits the cap of its rounds on rows of more than about 140
    equal balls (squeezed from both ends; about 155 if hit at one end); the
    other two solve dense systems, seconds for a thousand contacts in one island.

    Args:
        bodies: n bodies.
        contacts: c contacts between them.
        restitution: e, from 0 to 1, one for all contacts.
        law: one of the three.
    Returns:
        The bodies with new momenta.
    Raises:
        ValueError: restitution outside 0..1 or an array, an unknown law, a contact with a body that is not there.
        CollisionsUnresolved: a contact still approaches after 50,000 rounds; has the state reached.
    """
    if np.ndim(restitution):
        raise failure(
            "restitution",
            "one number for all contacts",
            f"shape {np.shape(restitution)}",
        )
    e = float(in_range("restitution", restitution, 0, 1))
    choice("law", law, LAWS)
    contacts.require_bodies(len(bodies))
    if not len(contacts):
        return bodies
    u, alone, islands = _islands(bodies, contacts)
    mass = np.where(alone, effective_mass(bodies, contacts), 0.0)
    after = apply_impulse(
        bodies, contacts, np.where(alone & (u < 0), -(1 + e) * u * mass, 0.0)
    )
    momentum, angular_momentum, stuck = (
        after.momentum.copy(),
        after.angular_momentum.copy(),
        0,
    )
    motion = _mass_coordinates(bodies)
    for chosen in islands:
        if np.any(u[chosen] < 0):
            island = _island(bodies, contacts, motion, chosen)
            change, done = _resolve(island, e, law)
            island.add(change, momentum, angular_momentum)
            stuck += not done
    after = replace(bodies, momentum=momentum, angular_momentum=angular_momentum)
    if stuck:
        message = (
            f"{stuck} group(s) of touching bodies still collide after {MAX_ROUNDS} rounds, "
            f"law {law!r}, e = {e:g}"
        )
        raise CollisionsUnresolved(message, after)
    return after


@dataclass(frozen=True, eq=False)
class _Island:
    """Bodies connected by contacts, in coordinates y in which the kinetic energy is |y|^2 / 2.

    There every impulse at e = 1 is a mirror image, so that rounding does not
    grow, whatever the masses.
    """

    bodies: IntArray  # the free bodies, (k,)
    root_mass: Array  # sqrt(m), (k,)
    root: Array  # C with C C' = I^-1 in the world, (k, 3, 3)
    rows: BoolArray  # which of the 6 k coordinates the contacts can change
    columns: Array  # G = M^-1/2 J', (rows, c)
    start: Array  # y before, (rows,): of each body sqrt(m) v, then C^-1 omega
    tolerance: float

    def add(self, change: Array, momentum: Array, angular_momentum: Array) -> None:
        """Add a change of y to the momenta: sqrt(m) y and C^-T y."""
        each = np.zeros((self.bodies.size, 6))
        each.reshape(-1)[self.rows] = change
        momentum[self.bodies] += self.root_mass[:, None] * each[:, :3]
        turned = np.linalg.solve(np.swapaxes(self.root, -1, -2), each[:, 3:, None])
        angular_momentum[self.bodies] += turned[:, :, 0]


def _islands(
    bodies: Bodies, contacts: Contacts
) -> tuple[Array, BoolArray, list[IntArray]]:
    """Normal velocities, which contacts share no free body with another, and the islands of the rest."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    u, a, b = normal_velocity(bodies, contacts), contacts.body_a, contacts.body_b
    free_a, free_b = ~bodies.fixed[a], ~bodies.fixed[b]
    n = len(bodies)
    used = np.bincount(a[free_a], minlength=n) + np.bincount(b[free_b], minlength=n)
    movable = free_a | free_b
    alone = movable & ~(free_a & (used[a] > 1)) & ~(free_b & (used[b] > 1))
    both = free_a & free_b
    graph = coo_array(
        (np.ones(np.count_nonzero(both)), (a[both], b[both])), shape=(n, n)
    )
    label = connected_components(graph, directed=False)[1][np.where(free_a, a, b)]
    rest = np.flatnonzero(movable & ~alone)
    order = rest[np.argsort(label[rest], kind="stable")]
    cuts = np.flatnonzero(np.diff(label[order])) + 1
    return u, alone, [island for island in np.split(order, cuts) if island.size]


@dataclass(frozen=True, eq=False)
class _MassCoordinates:
    """Of all bodies: v, sqrt(m), C with C C' = I^-1 in the world, C^-1 omega (any values for fixed ones)."""

    velocity: Array
    root_mass: Array
    root: Array
    angular: Array  # C^-1 omega


def _mass_coordinates(bodies: Bodies) -> _MassCoordinates:
    fixed = bodies.fixed[:, None, None]
    root = np.linalg.cholesky(np.where(fixed, np.eye(3), bodies.world_inverse_inertia))
    angular = np.asarray(
        np.linalg.solve(root, bodies.angular_velocity[:, :, None])[:, :, 0],
        dtype=np.float64,
    )
    return _MassCoordinates(bodies.velocity, bodies.mass**0.5, root, angular)


def _island(
    bodies: Bodies, contacts: Contacts, motion: _MassCoordinates, chosen: IntArray
) -> _Island:
    touched = np.unique(
        np.concatenate([contacts.body_a[chosen], contacts.body_b[chosen]])
    )
    free = touched[~bodies.fixed[touched]]
    velocity, root_mass, root = (
        motion.velocity[free],
        motion.root_mass[free],
        motion.root[free],
    )
    if (
        free.size == touched.size
    ):  # nothing fixed: a common motion is no collision's business
        velocity = velocity - velocity.mean(axis=0)
    start = np.concatenate(
        [velocity * root_mass[:, None], motion.angular[free]], axis=1
    )
    direction = np.zeros((chosen.size, free.size, 6))
    for body, sign in ((contacts.body_a[chosen], 1.0), (contacts.body_b[chosen], -1.0)):
        moves = np.flatnonzero(~bodies.fixed[body])
        index, n = (
            np.searchsorted(free, body[moves]),
            sign * contacts.normal[chosen[moves]],
        )
        torque = np.cross(
            contacts.point[chosen[moves]] - bodies.position[body[moves]], n
        )
        direction[moves, index, :3] = n / root_mass[index, None]
        direction[moves, index, 3:] = np.einsum("cji,cj->ci", root[index], torque)
    rows = np.asarray(np.any(direction.reshape(chosen.size, -1), axis=0))
    g, y = direction.reshape(chosen.size, -1)[:, rows].T.copy(), start.reshape(-1)[rows]
    fastest = max(float(-np.min(g.T @ y)), 0.0)
    rounding = 4 * np.finfo(float).eps * float(np.max(np.abs(velocity), initial=0.0))
    # Half of it, so that rounding in the answer's own velocities does not cross the line.
    return _Island(
        free, root_mass, root, rows, g, y, max(0.5 * APPROACHING * fastest, rounding)
    )


def _resolve(island: _Island, e: float, law: str) -> tuple[Array, bool]:
    """The change of y by a law, and whether none approaches any more."""
    limit = island.tolerance
    if law == "sequential":
        return _in_turn(island, e)
    if law == "simultaneous":
        return _at_once(island, 1 + e, lambda u: u <= limit)
    elastic, done = _at_once(island, 2.0, lambda u: u < -limit)
    if e == 1:
        return elastic, done
    plastic, also = _at_once(island, 1.0, lambda u: np.full(u.shape, True))
    return e * elastic + (1 - e) * plastic, done and also


def _at_once(
    island: _Island, strength: float, taken: Callable[[Array], BoolArray]
) -> tuple[Array, bool]:
    """Again and again strength times the plastic impulses of the contacts taken, until none approaches."""
    g, change = island.columns, np.zeros(island.start.shape)
    for _ in range(MAX_ROUNDS):
        y = island.start + change
        u = g.T @ y
        if np.min(u) >= -island.tolerance:
            return change, True
        which = np.flatnonzero(taken(u))
        columns = g[:, which]
        if which.size == 1:
            impulse = -strength * np.minimum(u[which], 0.0) / np.sum(columns * columns)
        else:
            impulse = nonnegative_least_squares(columns, -strength * y)
        change = change + columns @ impulse
    return change, False


def _in_turn(island: _Island, e: float) -> tuple[Array, bool]:
    """One contact after the other, each as if it were alone, until none approaches."""
    from course.contact.sequential_collisions import Passes

    g, change, limit = island.columns, np.zeros(island.start.shape), -island.tolerance
    passes = Passes(g.T @ g)
    for _ in range(MAX_ROUNDS):
        u = g.T @ (island.start + change)  # afresh, so that rounding does not add up
        if np.min(u) >= limit:
            return change, True
        change = change + g @ passes.once(u, e, limit)
    return change, False
