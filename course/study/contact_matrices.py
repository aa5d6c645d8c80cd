"""Contact matrices of lesson 15: what bodies do when their contacts are pushed, and what A costs to make and to use.

The scenes are those of ``course.scenes``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    IntArray,
    failure,
    scalar,
    scalars,
    shaped,
)
from course.contact import contact_system, contact_wrench
from course.dynamics import Bodies, reference_motion
from course.overlap import Contacts
from course.scenes import Scene
from course.study.stencils import SECOND_FIVE


def measured_accelerations(
    scene: Scene, contact_force: ArrayLike, *, step: float = 3e-3
) -> Array:
    """d_ddot of every contact under these contact forces, from the motion alone: no A, no b (syllabus row 21).

    The bodies move for two steps to both sides of the moment under the external and the contact forces, integrated
    to 1e-13. Five-point second differences of the gaps give d_ddot. The point of A, the point of B and the normal
    are followed as they are carried, the normal with B.

    Args:
        scene: its contacts must all be of faces of B.
        contact_force: f of each contact, (c,) [N].
        step: of the differences [s].
    Returns:
        (c,) [m/s^2], good to about 1e-9 for gaps and arms of 1 m.
    Raises:
        ValueError: contacts of another feature, force of another shape.
    """
    contacts, force = scene.contacts, scalars("contact_force", contact_force)
    shaped("contact_force", force, (len(contacts),))
    if contacts.feature is not None and np.any(contacts.feature != "face_b"):
        raise failure(
            "scene",
            "contacts of faces of B",
            f"{sorted(set(contacts.feature.tolist()))}",
        )
    pushing, turning = contact_wrench(scene.bodies, contacts, force)
    free = ~scene.bodies.fixed[:, None]
    wrench = free * (scene.force + pushing), free * (scene.torque + turning)
    h = scalar("step", step)

    def gaps(time: float) -> Array:
        bodies = (
            reference_motion(scene.bodies, lambda *_: wrench, [time])[0]
            if time
            else scene.bodies
        )
        return _carried_gaps(scene.bodies, bodies, contacts)

    terms = [
        w * gaps(o * h)
        for o, w in zip(SECOND_FIVE.offsets, SECOND_FIVE.weights, strict=True)
    ]
    return np.sum(terms, axis=0) / h**2


def plain_arrays(scene: Scene) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
    """The scene as the exercises of lesson 15 take it.

    Returns:
        (body_a, body_b, point, normal) and (mass, inverse inertia in body axes, rotation, position); the inverse
        inertia of a fixed body is zero.
    """
    contacts, bodies = scene.contacts, scene.bodies
    fixed = bodies.fixed[:, None, None]
    inverse = np.where(
        fixed, 0.0, np.linalg.inv(np.where(fixed, np.eye(3), bodies.inertia))
    )
    described = contacts.body_a, contacts.body_b, contacts.point, contacts.normal
    return described, (bodies.mass, inverse, bodies.rotation, bodies.position)


@dataclass(frozen=True)
class MatrixCost:
    """How many numbers are stored or multiplied for A, counted and not timed.

    Args:
        contacts, bodies: c and n.
        entries: multiplications to make A entry by entry, all c^2 of them, about 30 for each body in common.
        dense: multiplications to make J (M^-1 J') with J and M^-1 J' full arrays, 6 n c^2, and 36 n c for M^-1 J'.
        sparse: multiplications of the same product where only what is not 0 is multiplied.
        stored_dense, stored_sparse, stored_factors: numbers stored for A full, A sparse, and J with M^-1 sparse.
    """

    contacts: int
    bodies: int
    entries: int
    dense: int
    sparse: int
    stored_dense: int
    stored_sparse: int
    stored_factors: int


def matrix_cost(bodies: Bodies, contacts: Contacts) -> MatrixCost:
    """Count what A costs by the ways of lesson 15; multiplying by a stored matrix costs what it stores.

    For a product X Y of sparse matrices the multiplications are the sum over k of the entries in column k of X
    times those in row k of Y.
    """
    still = np.zeros((len(bodies), 3))
    system = contact_system(bodies, contacts, still, still, rate_tolerance=np.inf)
    jacobian, inverse = system.jacobian, system.inverse_mass
    c, n = len(contacts), len(bodies)
    moved = inverse @ jacobian.T
    first = int(
        np.bincount(inverse.indices, minlength=6 * n)
        @ np.diff(jacobian.T.tocsr().indptr)
    )
    second = int(
        np.bincount(jacobian.indices, minlength=6 * n) @ np.diff(moved.tocsr().indptr)
    )
    meetings = np.zeros((c, n), dtype=int)
    for side in contacts.sides:
        meetings[np.arange(c), side.body] += 1
    shared = int(np.sum(meetings.sum(axis=0) ** 2))
    return MatrixCost(
        c, n, 30 * shared, 6 * n * c * c + 36 * n * c, first + second,
        c * c, (jacobian @ moved).nnz, jacobian.nnz + inverse.nnz,
    )  # fmt: skip


@dataclass(frozen=True, eq=False)
class MatrixGrowth:
    """What ways to make A cost over the number of contacts, each by its name.

    Args:
        contacts: c of each scene, (k,).
        seconds: measured, (k,) [s].
        multiplications: counted, (k,).
        exponent: p of multiplications ~ c^p at the end of each way.
    """

    contacts: dict[str, Array]
    seconds: dict[str, Array]
    multiplications: dict[str, Array]
    exponent: dict[str, float]


def matrix_growth(
    contacts: Mapping[str, Sequence[float]],
    seconds: Mapping[str, Sequence[float]],
    multiplications: Mapping[str, Sequence[float]],
) -> MatrixGrowth:
    """What was measured and counted, with the exponent of the counts: least squares of the last three logarithms.

    Times have none: theirs differs from machine to machine.

    Raises:
        ValueError: a way with fewer than three numbers of contacts, or without as many times or counts.
    """
    sizes, times, counts = (
        {name: scalars(name, values) for name, values in given.items()}
        for given in (contacts, seconds, multiplications)
    )
    for name, c in sizes.items():
        if c.ndim != 1 or c.size < 3:
            raise failure(name, "at least three numbers of contacts", f"{c.size}")
        for what in (times, counts):
            shaped(name, what.get(name, np.empty(0)), c.shape)
    exponent = {
        name: float(np.polyfit(np.log(c[-3:]), np.log(counts[name][-3:]), 1)[0])
        for name, c in sizes.items()
    }
    return MatrixGrowth(sizes, times, counts, exponent)


def exact_matrix(bodies: Bodies, contacts: Contacts) -> Array:
    """A by rational arithmetic from the numbers as they are stored, rounded once at the end, (c, c) [1/kg].

    The world inverse inertias are taken as given. For small scenes: each entry is a sum of fractions.
    """
    exact = np.vectorize(Fraction, otypes=[object])
    weight = exact(np.where(bodies.fixed, 0.0, bodies.mass))
    inverse_mass = np.array([1 / m if m else Fraction(0) for m in weight], dtype=object)
    inverse = exact(bodies.world_inverse_inertia)
    point, normal, position = (
        exact(contacts.point),
        exact(contacts.normal),
        exact(bodies.position),
    )
    sides = [(contacts.body_a, 1), (contacts.body_b, -1)]
    lever = [_cross(point - position[body], normal) for body, _ in sides]
    c = len(contacts)
    a = np.zeros((c, c))
    for i in range(c):
        for j in range(i + 1):
            total = Fraction(0)
            for (body_i, sign_i), w_i in zip(sides, lever, strict=True):
                for (body_j, sign_j), w_j in zip(sides, lever, strict=True):
                    k = body_i[i]
                    if k == body_j[j]:
                        turning = w_i[i] @ (inverse[k] @ w_j[j])
                        total += (
                            sign_i
                            * sign_j
                            * (inverse_mass[k] * (normal[i] @ normal[j]) + turning)
                        )
            a[i, j] = a[j, i] = float(total)
    return a


def _carried_gaps(start: Bodies, now: Bodies, contacts: Contacts) -> Array:
    """The gaps (c,) when points and normals are carried along by the bodies from where they were at the start."""

    def carried(body: IntArray, arrow: Array) -> Array:
        turn = now.rotation[body] @ np.swapaxes(start.rotation[body], 1, 2)
        return np.asarray(np.einsum("cij,cj->ci", turn, arrow))

    a, b = contacts.body_a, contacts.body_b
    p_a = now.position[a] + carried(a, contacts.point_a - start.position[a])
    p_b = now.position[b] + carried(b, contacts.point_b - start.position[b])
    return np.asarray(np.sum((p_a - p_b) * carried(b, contacts.normal), axis=1))


def _cross(x: Array, y: Array) -> Array:
    """x cross y of object arrays, (c, 3); numpy's own wants numbers."""
    return np.stack([x[:, (k + 1) % 3] * y[:, (k + 2) % 3] - x[:, (k + 2) % 3] * y[:, (k + 1) % 3] for k in range(3)],
                    axis=1)  # fmt: skip
