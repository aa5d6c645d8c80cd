"""What may be done to a resting scene: shake it, weigh it anew, give contacts twice, set it moving."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from course.arrays import ArrayLike, indices, positive, scalar
from course.overlap import Contacts
from course.scenes.layout import UP, contacts_at
from course.scenes.scene import GRAVITY, Scene, resting_again


def shaken(scene: Scene, rng: np.random.Generator, *, strength: float = 1.0) -> Scene:
    """The scene with random accelerations added to every body, and angular ones, up to strength times gravity."""
    fixed, n = scene.bodies.fixed, len(scene.bodies)
    mass = np.where(fixed, 0.0, scene.bodies.mass)
    inertia = np.where(fixed[:, None, None], 0.0, scene.bodies.world_inertia)
    a, alpha = strength * GRAVITY * rng.uniform(-1, 1, (2, n, 3))
    return resting_again(
        scene,
        name=f"{scene.name}, shaken",
        applied_force=scene.applied_force + mass[:, None] * a,
        torque=scene.torque + np.einsum("nij,nj->ni", inertia, alpha),
    )


def weighed_anew(scene: Scene, mass: ArrayLike) -> Scene:
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
    force, torque = scene.applied_force, scene.torque
    return resting_again(
        scene,
        bodies=changed,
        applied_force=force * factor[:, None],
        torque=torque * factor[:, None],
    )


def on_a_moving_ground(
    scene: Scene,
    velocity: ArrayLike,
    angular_velocity: ArrayLike,
    *,
    mass: float = 1e3,
) -> Scene:
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
    return resting_again(
        scene,
        name=f"{scene.name}, on a moving ground",
        bodies=moving,
        # What was fixed had no weight, and gets none.
        applied_force=scene.applied_force
        - np.where(fixed, heavy, 0.0)[:, None] * scene.gravity,
    )


def with_duplicates(
    scene: Scene, rng: np.random.Generator, share: float = 0.3
) -> Scene:
    """The scene with some of its contacts given twice, in another order."""
    c = len(scene.contacts)
    again = (
        rng.choice(c, size=int(np.ceil(share * c)), replace=False)
        if c
        else np.zeros(0, int)
    )
    order = rng.permutation(np.concatenate([np.arange(c), again]))
    return resting_again(
        scene, name=f"{scene.name}, duplicates", contacts=scene.contacts[order]
    )


def with_redundant_points(
    scene: Scene, rng: np.random.Generator, share: float = 0.5
) -> Scene:
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
    bodies = {"a": contacts.body_a[first], "b": contacts.body_b[first]}
    more = contacts_at(point, contacts.normal[first], **bodies)
    return resting_again(
        scene,
        name=f"{scene.name}, redundant",
        contacts=Contacts.concatenate([contacts, more]),
    )


def about_to_part(scene: Scene, acceleration: float = 0.0) -> Scene:
    """The scene with every body pulled up by this acceleration instead of its weight; at 0 all b are 0."""
    return resting_again(
        without_forces(scene),
        name=f"{scene.name}, about to part",
        gravity=scalar("acceleration", acceleration) * UP,
    )


def without_forces(scene: Scene) -> Scene:
    """The scene without external forces: what remains under contact forces is A f alone, where nothing spins."""
    none = np.zeros(3)
    return resting_again(scene, gravity=none, applied_force=none, torque=none)


def tilted_foot(scene: Scene, foot: int, angle: float) -> Scene:
    """The scene with the normal of one contact tilted by an angle about y, toward +x [rad]."""
    which = int(indices("foot", foot, len(scene.contacts)))
    normal = scene.contacts.normal.copy()
    tilt = scalar("angle", angle)
    normal[which] = np.cos(tilt) * normal[which] + np.sin(tilt) * np.array(
        [1.0, 0.0, 0.0]
    )
    normal[which] /= np.linalg.norm(normal[which])
    return resting_again(scene, contacts=replace(scene.contacts, normal=normal))
