"""The moving part of n bodies during a step, and the principal frames it turns in."""

from __future__ import annotations

import weakref
from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from course import rotations
from course.arrays import Array, ArrayLike, BoolArray, failure, scalar, vectors, written
from course.dynamics.bodies import Bodies
from course.dynamics.integrators.components import (
    conjugated,
    multiplied,
    normalized,
    rotated,
    turn_about,
)
from course.dynamics.mass_properties import principal_axes

#: ``wrench(bodies, time) -> (force, torque)``, each (n, 3), in world axes,
#: the torque about each centre of mass. None where nothing acts.
Wrench = Callable[[Bodies, float], tuple[Array, Array]]


@dataclass(frozen=True)
class PrincipalFrames:
    """What rotation needs to know about n inertias, once for a whole motion.

    Args:
        inverse_moments: (3, n), 1/I1 >= 1/I2 >= 1/I3; zero for a fixed body.
        moments: (3, n), I1 <= I2 <= I3; 1 for a fixed body.
        axes: (4, n) quaternions, principal axes to body axes; None where all of them
            are the identity.
    """

    inverse_moments: Array
    moments: Array
    axes: Array | None


_known_frames: dict[
    tuple[int, int], tuple[weakref.ref[Any], weakref.ref[Any], PrincipalFrames]
] = {}


def principal_frames(bodies: Bodies) -> PrincipalFrames:
    """The frames of these bodies, computed once per pair of (read-only) inertia and
    mass.
    """
    inertia, mass = bodies.inertia, bodies.mass
    key = id(inertia), id(mass)
    found = _known_frames.get(key)
    if found is not None and found[0]() is inertia and found[1]() is mass:
        return found[2]
    free = np.isfinite(mass)
    moments, axes = principal_axes(np.where(free[:, None, None], inertia, np.eye(3)))
    same = np.array_equal(axes, np.broadcast_to(np.eye(3), axes.shape))
    frames = PrincipalFrames(
        np.ascontiguousarray(np.where(free[:, None], 1.0 / moments, 0.0).T),
        np.ascontiguousarray(moments.T),
        None if same else np.ascontiguousarray(rotations.from_matrix(axes).T),
    )

    def forget(_: Any) -> None:
        _known_frames.pop(key, None)

    _known_frames[key] = weakref.ref(inertia, forget), weakref.ref(mass, forget), frames
    return frames


@dataclass(frozen=True)
class Motion:
    """Position, orientation and momenta of n bodies, components first: (3, n) or (4,
    n).
    """

    bodies: Bodies
    frames: PrincipalFrames
    inverse_mass: Array
    fixed: BoolArray | None
    position: Array
    orientation: Array
    momentum: Array
    angular_momentum: Array

    @classmethod
    def of(cls, bodies: Bodies) -> Motion:
        """The motion of these bodies.

        Views of their arrays, which are never written to.
        """
        if not isinstance(bodies, Bodies):
            raise failure("bodies", "Bodies", type(bodies).__name__)
        fixed = np.isinf(bodies.mass)
        return cls(
            bodies,
            principal_frames(bodies),
            1.0 / bodies.mass,
            fixed if fixed.any() else None,
            bodies.position.T,
            bodies.orientation.T,
            bodies.momentum.T,
            bodies.angular_momentum.T,
        )

    def moved(self, **changed: Any) -> Motion:
        """The same bodies with another position, orientation or momentum."""
        return replace(self, **changed)

    @property
    def velocity(self) -> Array:
        """p/m, (3, n)."""
        return self.momentum * self.inverse_mass

    @property
    def principal_orientation(self) -> Array:
        """Principal axes to world axes, (4, n)."""
        axes = self.frames.axes
        return self.orientation if axes is None else multiplied(self.orientation, axes)

    @property
    def angular_velocity(self) -> Array:
        """omega = R I^-1 R' L, computed in the principal axes, (3, n)."""
        q = self.principal_orientation
        return rotated(
            q,
            self.frames.inverse_moments * rotated(conjugated(q), self.angular_momentum),
        )

    def turned(self, rotation_vector: Array) -> Array:
        """The orientations turned by a rotation vector in world axes, exp(theta/2) q,
        (4, n).
        """
        q = normalized(multiplied(turn_about(rotation_vector), self.orientation))
        return q if self.fixed is None else np.where(self.fixed, self.orientation, q)

    def wrench(self, wrench: Wrench | None, time: float) -> tuple[Array, Array]:
        """Force and torque, (3, n) or (3, 1) for all; those of fixed bodies are not
        read.
        """
        if wrench is None:
            return np.zeros((3, 1)), np.zeros((3, 1))
        answer = wrench(self.to_bodies(), time)
        if not isinstance(answer, tuple) or len(answer) != 2:
            raise failure("wrench", "a pair (force, torque)", written(answer))
        return self._checked("wrench force", answer[0]), self._checked(
            "wrench torque", answer[1]
        )

    def _checked(self, name: str, value: Any) -> Array:
        try:
            array = np.asarray(value, dtype=np.float64)
        except (TypeError, ValueError):
            raise failure(name, "real numbers", written(value)) from None
        if array.shape != self.bodies.position.shape:
            raise failure(
                name, f"shape {self.bodies.position.shape}", f"shape {array.shape}"
            )
        if self.fixed is not None:
            array = np.where(self.fixed[:, None], 0.0, array)
        if not np.isfinite(array).all():
            vectors(name, array)
        return array.T

    def to_bodies(self) -> Bodies:
        """Bodies in this state.

        The constructor's checks are left out: mass and inertia were checked
        when the first ``Bodies`` were made, and a step keeps shapes and unit
        quaternions.
        """
        moved = object.__new__(Bodies)
        for field in fields(Bodies):
            value = getattr(self, field.name, None)
            if value is None:
                value = getattr(self.bodies, field.name)
            else:
                value.flags.writeable = False
                value = value.T
            object.__setattr__(moved, field.name, value)
        return moved


def step_and_time(step: ArrayLike, time: ArrayLike) -> tuple[float, float]:
    """Both as floats; a negative step goes back in time."""
    return scalar("step", step), scalar("time", time)


def uniform_gravity(gravity: ArrayLike) -> Wrench:
    """The wrench of a uniform field: force m g, no torque.

    Args:
        gravity: g, (3,) [m/s^2], for instance (0, 0, -9.81).
    """
    g = vectors("gravity", gravity)
    if g.shape != (3,):
        raise failure("gravity", "shape (3,)", f"shape {g.shape}")

    def wrench(bodies: Bodies, time: float) -> tuple[Array, Array]:
        mass = np.where(np.isfinite(bodies.mass), bodies.mass, 0.0)
        return mass[:, None] * g, np.zeros(bodies.position.shape)

    return wrench
