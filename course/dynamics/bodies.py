"""Rigid bodies as arrays: what they are, where they are, how they move."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np

from course import rotations
from course.arrays import (
    Array,
    ArrayLike,
    BoolArray,
    broadcast,
    failure,
    inertias,
    instances,
    positive,
    read_only,
    selection,
    shaped,
    unit_quaternions,
    vectors,
)


@dataclass(frozen=True, eq=False)
class Bodies:
    """n rigid bodies; every field an array whose first axis counts the bodies.

    Momenta are stored and velocities derived, v = p/m and omega = I^-1 L
    (syllabus rows 14 and 22). A fixed body has mass infinity: its inverse
    mass and inverse inertia are zero, its velocities are zero, its inertia is
    not read, and it carries no momentum. Fields are copied on the way in and
    cannot be written to; ``dataclasses.replace`` makes a changed set.

    Args:
        mass: (n,) [kg], positive, infinity for a fixed body.
        inertia: (n, 3, 3) about the centre of mass in body axes [kg m^2],
            symmetric and positive definite.
        position: (n, 3) centre of mass [m].
        orientation: (n, 4) unit quaternion, scalar last, body axes to world axes.
        momentum: (n, 3) [kg m/s], world axes.
        angular_momentum: (n, 3) about the centre of mass [kg m^2/s], world axes.
    Raises:
        ValueError: a field of another shape or kind, or momentum in a fixed body.
    """

    mass: Array
    inertia: Array
    position: Array
    orientation: Array
    momentum: Array
    angular_momentum: Array

    def __post_init__(self) -> None:
        mass = positive("mass", self.mass, infinite=True)
        if mass.ndim != 1:
            raise failure("mass", "shape (n,)", f"shape {mass.shape}")
        n, free = mass.size, np.isfinite(mass)
        inertia = np.asarray(self.inertia)
        shaped("inertia", inertia, (n, 3, 3))
        # A fixed body's inertia is not read, so anything may stand there.
        inertias("inertia", np.where(free[:, None, None], inertia, np.eye(3)))
        checked = {
            "mass": mass,
            "inertia": inertia.astype(np.float64, copy=False),
            "position": vectors("position", self.position),
            "orientation": unit_quaternions("orientation", self.orientation),
            "momentum": vectors("momentum", self.momentum),
            "angular_momentum": vectors("angular_momentum", self.angular_momentum),
        }
        for name, array in checked.items():
            if name not in ("mass", "inertia"):
                shaped(name, array, (n, 4 if name == "orientation" else 3))
            if name.endswith("momentum"):
                _require_none_if_fixed(name, array, ~free)
            object.__setattr__(self, name, read_only(array))

    @classmethod
    def balls(
        cls,
        mass: ArrayLike,
        radius: ArrayLike,
        position: ArrayLike,
        velocity: ArrayLike = (0.0, 0.0, 0.0),
    ) -> Bodies:
        """Solid balls that do not spin: I = 2/5 m r^2.

        Args:
            mass: scalar or (n,) [kg], infinity for a fixed ball.
            radius: scalar or (n,) [m].
            position: (n, 3) [m].
            velocity: (3,) or (n, 3) [m/s]; zero for a fixed ball.
        """
        m = positive("mass", mass, infinite=True)
        r = positive("radius", radius)
        x, v = vectors("position", position), vectors("velocity", velocity)
        batch = broadcast(mass=(m, 0), radius=(r, 0), position=(x, 1), velocity=(v, 1))
        if len(batch) != 1:
            raise failure("position", "shape (n, 3)", f"shape {x.shape}")
        m, r = np.broadcast_to(m, batch), np.broadcast_to(r, batch)
        x, v = np.broadcast_to(x, (*batch, 3)), np.broadcast_to(v, (*batch, 3))
        fixed = np.isinf(m)
        _require_none_if_fixed("velocity", v, fixed)
        finite_mass = np.where(fixed, 0.0, m)
        inertia = np.where(fixed, 1.0, 0.4 * finite_mass * r * r)[
            :, None, None
        ] * np.eye(3)
        momentum = finite_mass[:, None] * v
        return cls(
            m, inertia, x, rotations.identity(*batch), momentum, np.zeros((*batch, 3))
        )

    @staticmethod
    def concatenate(parts: Iterable[Bodies]) -> Bodies:
        """All bodies of all parts, in order.

        Raises:
            ValueError: no parts, or something other than ``Bodies``.
        """
        rows = [part._arrays() for part in instances("parts", parts, Bodies)]
        return Bodies(*(np.concatenate(column) for column in zip(*rows, strict=True)))

    def __len__(self) -> int:
        return self.mass.size

    def __getitem__(self, which: ArrayLike | slice) -> Bodies:
        """The bodies that a mask, indices or a slice select, in that order.

        An int gives a ``Bodies`` of one. All fields are copies.

        Raises:
            ValueError: a mask of another shape, an index that is no whole number.
            IndexError: an index out of range.
        """
        index = selection("bodies", which, len(self))
        return Bodies(*(array[index] for array in self._arrays()))

    def _arrays(self) -> tuple[Array, ...]:
        return tuple(getattr(self, field.name) for field in fields(self))

    @property
    def fixed(self) -> BoolArray:
        """Which bodies do not move, (n,)."""
        return np.isinf(self.mass)

    @property
    def inverse_mass(self) -> Array:
        """1/m, zero for a fixed body, (n,) [1/kg]."""
        return 1.0 / self.mass

    @cached_property
    def rotation(self) -> Array:
        """Rotation matrices R of the orientations, (n, 3, 3), read-only."""
        return read_only(rotations.to_matrix(self.orientation))

    @property
    def world_inertia(self) -> Array:
        """R I R', (n, 3, 3) [kg m^2]; infinity on the diagonal for a fixed body."""
        rotation, fixed = self.rotation, self.fixed[:, None, None]
        turned = (
            rotation
            @ np.where(fixed, np.eye(3), self.inertia)
            @ np.swapaxes(rotation, -1, -2)
        )
        return np.where(fixed, np.diag([np.inf] * 3), turned)

    @cached_property
    def world_inverse_inertia(self) -> Array:
        """R I^-1 R', zero for a fixed body, (n, 3, 3) [1/(kg m^2)], read-only."""
        rotation, fixed = self.rotation, self.fixed[:, None, None]
        inverse = np.linalg.inv(np.where(fixed, np.eye(3), self.inertia))
        return read_only(
            np.where(fixed, 0.0, rotation @ inverse @ np.swapaxes(rotation, -1, -2))
        )

    @property
    def velocity(self) -> Array:
        """p/m, (n, 3) [m/s]."""
        return self.momentum / self.mass[:, None]

    @property
    def angular_velocity(self) -> Array:
        """I^-1 L, (n, 3) [rad/s]."""
        return np.einsum(
            "nij,nj->ni", self.world_inverse_inertia, self.angular_momentum
        )


def _require_none_if_fixed(name: str, value: Array, fixed: BoolArray) -> None:
    moving = fixed & np.any(value != 0, axis=1)
    if np.any(moving):
        index = int(np.argmax(moving))
        raise failure(
            name, "zero in a body of infinite mass", str(value[index]), (index,)
        )
