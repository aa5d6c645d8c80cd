"""What may be done to a resting scene: shake it, weigh it anew, give contacts twice, set it moving."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from course.arrays import ArrayLike, positive, scalar
from course.overlap import Contacts
from course.study.resting_layouts import GRAVITY, UP, RestingScene, contacts_at


def shaken(
    scene: RestingScene, rng: np.random.Generator, *, strength: float = 1.0
) -> RestingScene:
    """The scene with random accelerations added to every body, and angular ones, up to strength times gravity."""
    n, mass = len(scene.bodies), np.where(scene.bodies.fixed, 0.0, scene.bodies.mass)
    inertia = np.where(
        scene.bodies.fixed[:, None, None], 0.0, scene.bodies.world_inertia
    )
    a, alpha = strength * GRAVITY * rng.uniform(-1, 1, (2, n, 3))
    return replace(
        scene,
        name=f"{scene.name}, shaken",
        force=scene.force + mass[:, None] * a,
        torque=scene.torque + np.einsum("nij,nj->ni", inertia, alpha),
    )


def weighed_anew(scene: RestingScene, mass: ArrayLike) -> RestingScene:
    """The scene with other masses (n,), inertia and forces scaled alike; only for scenes without momentum."""
    old, bodies = scene.bodies.mass, scene.bodies
    free = np.isfinite(old)
    factor = np.where(
        free, positive("mass", mass, infinite=True) / np.where(free, old, 1.0), 1.0
    )
    changed = replace(
        bodies,
        mass=np.where(free, mass, np.inf),
        inertia=bodies.inertia * factor[:, None, None],
    )
    force, torque = scene.force * factor[:, None], scene.torque * factor[:, None]
    return replace(scene, bodies=changed, force=force, torque=torque)


def on_a_moving_ground(
    scene: RestingScene,
    velocity: ArrayLike,
    angular_velocity: ArrayLike,
    *,
    mass: float = 1e3,
) -> RestingScene:
    """The scene as one rigid whole that flies and turns, its ground a heavy body that is free as well."""
    bodies, omega = scene.bodies, np.asarray(angular_velocity, dtype=float)
    fixed = bodies.fixed
    heavy = np.where(fixed, positive("mass", mass), bodies.mass)
    inertia = np.where(
        fixed[:, None, None], heavy[:, None, None] * np.eye(3), bodies.inertia
    )
    still = replace(bodies, mass=heavy, inertia=inertia)
    v = np.asarray(velocity, dtype=float) + np.cross(omega, bodies.position)
    moving = replace(
        still, momentum=heavy[:, None] * v, angular_momentum=still.world_inertia @ omega
    )
    return replace(scene, name=f"{scene.name}, on a moving ground", bodies=moving)


def with_duplicates(
    scene: RestingScene, rng: np.random.Generator, share: float = 0.3
) -> RestingScene:
    """The scene with some of its contacts given twice, in another order."""
    c = len(scene.contacts)
    again = (
        rng.choice(c, size=int(np.ceil(share * c)), replace=False)
        if c
        else np.zeros(0, int)
    )
    order = rng.permutation(np.concatenate([np.arange(c), again]))
    return replace(
        scene, name=f"{scene.name}, duplicates", contacts=scene.contacts[order]
    )


def with_redundant_points(
    scene: RestingScene, rng: np.random.Generator, share: float = 0.5
) -> RestingScene:
    """The scene with more points between contacts of the same two faces: support that is not needed."""
    contacts = scene.contacts
    same = np.flatnonzero(
        (contacts.body_a[1:] == contacts.body_a[:-1])
        & (contacts.body_b[1:] == contacts.body_b[:-1])
    )
    alike = np.all(
        np.abs(contacts.normal[same] - contacts.normal[same + 1]) < 1e-12, axis=1
    )
    first = rng.permutation(same[alike])[: int(np.ceil(share * len(contacts)))]
    weight = rng.uniform(0, 1, (first.size, 1))
    point = weight * contacts.point[first] + (1 - weight) * contacts.point[first + 1]
    more = contacts_at(
        contacts.body_a[first], contacts.body_b[first], point, contacts.normal[first]
    )
    return replace(
        scene,
        name=f"{scene.name}, redundant",
        contacts=Contacts.concatenate([contacts, more]),
    )


def about_to_part(scene: RestingScene, acceleration: float = 0.0) -> RestingScene:
    """The scene with every body pulled up by this acceleration instead of its weight; at 0 all b are 0."""
    up = np.where(scene.bodies.fixed, 0.0, scene.bodies.mass) * scalar(
        "acceleration", acceleration
    )
    name = f"{scene.name}, about to part"
    return replace(
        scene, name=name, force=up[:, None] * UP, torque=np.zeros_like(scene.torque)
    )
