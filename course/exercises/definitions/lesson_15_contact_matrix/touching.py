"""Inputs for exercises on the contact matrix.

Bodies lie turned, with inertia that is not round and arms that differ, and a body may
be A of one contact and B of another: each of these tells apart mistakes that agree
where it is missing. Normals and rotations have two decimals: they come from whole
quaternions of squared length 25.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course.exercises.definitions.turning import inverse_moments, rotation_matrices

#: (pairs of bodies) one contact after the other, A first.
Pairs = Sequence[tuple[int, int]]


def drawn_contacts(
    rng: np.random.Generator, pairs: Pairs, *, fixed: bool = False
) -> tuple[tuple[np.ndarray, ...], tuple[np.ndarray, ...]]:
    """(contacts, bodies) as the exercises take them.

    With ``fixed`` the last body does not move.
    """
    a, b = np.array(pairs).T
    count, c = int(np.max(pairs)) + 1, len(a)
    point, position = (np.round(rng.uniform(-1.5, 1.5, (k, 3)), 2) for k in (c, count))
    mass = np.round(rng.uniform(1.5, 5.0, count), 1)
    inverse = inverse_moments(rng, (count,))[:, None] * np.eye(3)
    if fixed:
        mass[-1], inverse[-1] = np.inf, 0.0
    normal = rotation_matrices(rng, (c,))[:, :, 2]
    return (a, b, point, normal), (
        mass,
        inverse,
        rotation_matrices(rng, (count,)),
        position,
    )


def central_stack() -> tuple[tuple[np.ndarray, ...], tuple[np.ndarray, ...]]:
    """2 kg on 4 kg on the floor, all contacts under the centres: A = [[1/4, -1/4],
    [-1/4, 3/4]].
    """
    point, position = (
        np.array([[0, 0, 0.0], [0, 0, 1]]),
        np.array([[0, 0, 0.5], [0, 0, 1.5], [0, 0, -1]]),
    )
    inverse = np.array([1.5, 3.0, 0.0])[:, None, None] * np.eye(3)
    bodies = (
        np.array([4.0, 2.0, np.inf]),
        inverse,
        np.tile(np.eye(3), (3, 1, 1)),
        position,
    )
    return (
        np.array([0, 1]),
        np.array([2, 0]),
        point,
        np.tile([0, 0, 1.0], (2, 1)),
    ), bodies
