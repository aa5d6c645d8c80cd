"""What a scene is: bodies, what acts on them and between them, and how right an answer about them is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np

from course import formulas
from course.arrays import Array, ArrayLike, failure, read_only, shaped, vectors
from course.contact import ContactSystem, contact_system
from course.dynamics import Bodies
from course.overlap import Contacts

#: Of free fall [m/s^2].
GRAVITY = 9.81
DOWN = (0.0, 0.0, -GRAVITY)
NO_CONTACTS = Contacts(
    np.zeros(0, int), np.zeros(0, int), np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0)
)


class Colliders(Protocol):
    """The shapes of bodies: they find the contacts of the bodies as they lie."""

    def contacts(self, position: Array, rotation: Array) -> Contacts:
        """The contacts at positions (n, 3) [m] and rotations (n, 3, 3)."""
        ...


@dataclass(frozen=True, eq=False)
class Scene:
    """Bodies with what acts on them and between them; whichever of these the scene has.

    Args:
        bodies: n bodies at time 0.
        colliders: their shapes, which find contacts wherever the bodies are.
        contacts: c contacts at time 0.
        gravity: acceleration of free fall, (3,) [m/s^2].
        restitution: of all contacts; None where the scene leaves it open.
        truth: the right answer where it is known in closed form. Of a resting scene the
            contact forces, (c,) [N]; of a moving one a function, time [s] -> ``Bodies``;
            of an impact a function, restitution -> impulses (c,) [N s].
        error: how far an answer is from the truth. Of a resting scene error(force) in
            newtons, or where no truth is known the residual of the contact conditions;
            of a moving one error(bodies, time); of an impact error(impulse, restitution).
        name: what it shows.
        applied_force, torque: on each body besides its weight, world axes, the torque
            about the centre of mass; (n, 3) or what broadcasts to it [N, N m].
        solvable: whether contact forces exist that keep all d_ddot >= 0.

    ``dataclasses.replace`` keeps truth and error as they are; ``resting_again`` renews
    them after a change.
    """

    bodies: Bodies
    colliders: Colliders | None = None
    contacts: Contacts = NO_CONTACTS
    gravity: ArrayLike = (0.0, 0.0, 0.0)
    restitution: float | None = None
    truth: Any = None
    error: Callable[..., float] | None = None
    name: str = ""
    applied_force: Array = (0.0, 0.0, 0.0)  # type: ignore[assignment]
    torque: Array = (0.0, 0.0, 0.0)  # type: ignore[assignment]
    solvable: bool = True

    def __post_init__(self) -> None:
        gravity = vectors("gravity", self.gravity)
        shaped("gravity", gravity, (3,))
        object.__setattr__(self, "gravity", read_only(gravity))
        for name in ("applied_force", "torque"):
            value, shape = vectors(name, getattr(self, name)), (len(self.bodies), 3)
            if value.shape not in (shape, (3,)):
                raise failure(name, f"shape {shape}", f"shape {value.shape}")
            object.__setattr__(self, name, read_only(np.broadcast_to(value, shape)))

    @property
    def force(self) -> Array:
        """The external force on each body, its weight and what is applied, (n, 3) [N]."""
        mass = np.where(self.bodies.fixed, 0.0, self.bodies.mass)
        return np.asarray(mass[:, None] * self.gravity + self.applied_force)

    def system(self) -> ContactSystem:
        """The contact system of a scene that rests; raises ValueError where a contact moves."""
        return contact_system(self.bodies, self.contacts, self.force, self.torque)

    def at(self, time: float) -> Bodies:
        """The bodies of a scene whose motion is known, at a time before or after 0 [s]."""
        if not callable(self.truth):
            raise failure("scene", "one whose motion is known", self.name or "another")
        moved: Bodies = self.truth(time)
        return moved

    def touching(self, bodies: Bodies) -> Contacts:
        """The contacts of the scene's shapes when its bodies lie like this."""
        if self.colliders is None:
            raise failure("scene", "one with colliders", self.name or "another")
        return self.colliders.contacts(bodies.position, bodies.rotation)

    def gap(self, time: float) -> float:
        """The separation of the first contact at this time [m]."""
        return float(self.touching(self.at(time)).separation[0])


def resting(
    name: str,
    bodies: Bodies,
    contacts: Contacts,
    *,
    gravity: ArrayLike = DOWN,
    truth: ArrayLike | None = None,
    **more: Any,
) -> Scene:
    """A scene of resting contact; ``truth`` holds the contact forces where they are known, (c,) [N]."""
    scene = Scene(bodies, contacts=contacts, gravity=gravity, name=name, **more)
    return resting_again(scene, truth=truth)


def resting_again(
    scene: Scene, *, truth: ArrayLike | None = None, **changes: Any
) -> Scene:
    """The scene with these fields changed, its old truth forgotten and its error renewed."""
    changed = replace(scene, **changes)
    known = None if truth is None else np.asarray(truth, dtype=np.float64)

    def error(force: ArrayLike) -> float:
        f = np.asarray(force, dtype=np.float64)
        shaped("force", f, (len(changed.contacts),))
        if known is not None:
            return float(np.abs(f - known).max(initial=0.0))
        system = changed.system()
        return float(formulas.complementarity_residual(system.A.toarray(), f, system.b))

    return replace(changed, truth=known, error=error)
