"""Inputs and wrong versions for exercises on the contact matrix.

Bodies lie turned, with inertia that is not round and arms that differ, and a body may be A of one contact and B of
another: each of these tells apart mistakes that agree where it is missing. Normals and rotations have two decimals:
they come from whole quaternions of squared length 25.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from course.exercises.definitions.turning import inverse_moments, rotation_matrices

Arms = Callable[..., tuple[Any, Any]]
#: (pairs of bodies) one contact after the other, A first.
Pairs = Sequence[tuple[int, int]]


def drawn_contacts(
    rng: np.random.Generator, pairs: Pairs, *, fixed: bool = False
) -> tuple[tuple[np.ndarray, ...], tuple[np.ndarray, ...]]:
    """(contacts, bodies) as the exercises take them; with ``fixed`` the last body does not move."""
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
    """2 kg on 4 kg on the floor, all contacts under the centres: A = [[1/4, -1/4], [-1/4, 3/4]]."""
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


def own_arms(p_i: Any, p_j: Any, x: Any, *_: Any) -> tuple[Any, Any]:
    return p_i - x, p_j - x


def response(
    *,
    arms: Callable[[Any, Any], tuple[Any, Any]] = lambda arm, push_arm: (arm, push_arm),
    turning: float = 1.0,
    moving: float = 1.0,
    crossed: bool = True,
    divided: bool = True,
    axis: bool = True,
    apply: Callable[[Any, Any], Any] = lambda matrix, vector: np.einsum(
        "...ij,...j->...i", matrix, vector
    ),
) -> Callable[..., Any]:
    """The acceleration of a point of a pushed body, with the slips that the options say."""

    def function(
        mass: Any, inverse_inertia: Any, arm: Any, push_arm: Any, push: Any
    ) -> Any:
        answering, pushed = arms(np.asarray(arm), np.asarray(push_arm))
        spin = apply(np.asarray(inverse_inertia), np.cross(pushed, push))
        linear = np.asarray(push)
        if divided:
            linear = linear / (np.asarray(mass)[..., None] if axis else mass)
        return moving * linear + turning * (
            np.cross(spin, answering) if crossed else spin
        )

    return function


def entry(
    *,
    sign_b: float = -1.0,
    meet: Callable[[int, int], bool] = lambda side, other: True,
    arms: Arms = own_arms,
    normals: Callable[[Any, Any], tuple[Any, Any]] = lambda n_i, n_j: (n_i, n_j),
    frame: str = "world",
    whole: float = 1.0,
    dotted: bool = True,
    **options: Any,
) -> Callable[..., Any]:
    """a_ij with the slips that the options say; ``meet(side of i, side of j)`` picks the terms, 0 for A and 1 for B."""
    answer = response(**options)

    def function(i: Any, j: Any, contacts: Any, bodies: Any) -> Any:
        body_a, body_b, point, normal = contacts
        mass, inverse, rotation, position = bodies
        n_i, n_j = normals(normal[i], normal[j])
        total = 0.0
        for side, (body, sign) in enumerate(((body_a[i], 1.0), (body_b[i], sign_b))):
            for other, (pushed, push_sign) in enumerate(
                ((body_a[j], 1.0), (body_b[j], sign_b))
            ):
                if body == pushed and meet(side, other):
                    turn = {
                        "world": rotation[body],
                        "body": np.eye(3),
                        "back": rotation[body].T,
                    }[frame]
                    arm, push_arm = arms(
                        point[i],
                        point[j],
                        position[body],
                        position[body_a[i]],
                        position[body_a[j]],
                    )
                    world = turn @ inverse[body] @ turn.T
                    total += sign * (
                        n_i @ answer(mass[body], world, arm, push_arm, push_sign * n_j)
                    )
                    total += (
                        0.0
                        if dotted
                        else sign * push_sign * (1 - n_i @ n_j) / mass[body]
                    )
        return whole * total

    return function


def matrix(
    *, shown: Callable[[Any], Any] = lambda a: a, **options: Any
) -> Callable[..., Any]:
    """A with the slips that the options say, the same in every entry; ``shown`` changes the whole at the end."""
    one = entry(**options)

    def function(contacts: Any, bodies: Any) -> Any:
        c = range(len(contacts[0]))
        return shown(np.array([[one(i, j, contacts, bodies) for j in c] for i in c]))

    return function


def by_product(contacts: Any, bodies: Any) -> Any:
    """A = J M^-1 J'."""
    return weighed(contacts, bodies, lambda mass, inverse: (1 / mass, inverse))


def without_masses(contacts: Any, bodies: Any) -> Any:
    """J J'."""
    return weighed(
        contacts,
        bodies,
        lambda mass, inverse: (
            np.ones_like(mass),
            np.tile(np.eye(3), (len(mass), 1, 1)),
        ),
    )


def with_masses(contacts: Any, bodies: Any) -> Any:
    """J M J': masses and inertias for their inverses."""
    return weighed(
        contacts, bodies, lambda mass, inverse: (mass, np.linalg.pinv(inverse))
    )


def transposed_throughout(contacts: Any, bodies: Any) -> Any:
    """The world's I^-1 by ``rotation.T`` of the whole batch, which turns round all three axes."""
    mass, inverse, rotation, position = bodies
    world = np.asarray(rotation) @ inverse @ np.asarray(rotation).T
    return weighed(
        contacts,
        (mass, world, np.tile(np.eye(3), (len(mass), 1, 1)), position),
        lambda m, i: (1 / m, i),
    )


def weighed(
    contacts: Any, bodies: Any, weigh: Callable[[Any, Any], tuple[Any, Any]]
) -> Any:
    """J W J' with the blocks that ``weigh`` makes of masses and inverse inertias in world axes."""
    body_a, body_b, point, normal = contacts
    mass, inverse, rotation, position = bodies
    c, n = len(body_a), len(mass)
    rows = np.zeros((c, n, 6))
    for body, sign in ((body_a, 1.0), (body_b, -1.0)):
        lever = np.cross(point - position[body], normal)
        rows[np.arange(c), body] += sign * np.concatenate([normal, lever], axis=1)
    linear, angular = weigh(
        np.asarray(mass), rotation @ inverse @ np.swapaxes(rotation, 1, 2)
    )
    moved = np.concatenate(
        [
            rows[..., :3] * linear[:, None],
            np.einsum("nij,cnj->cni", angular, rows[..., 3:]),
        ],
        axis=-1,
    )
    return rows.reshape(c, -1) @ moved.reshape(c, -1).T
