"""Mass, centre of mass and inertia: of one solid, moved, weighed anew, or made of several (syllabus row 14)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    BoolArray,
    broadcast,
    failure,
    graded_eigh,
    inertias,
    instances,
    positive,
    read_only,
    rotations,
    vectors,
)

#: Overflow is refused by name at the end (``scaled_solid``); no warning on the way there.
QUIET = np.errstate(over="ignore", invalid="ignore", divide="ignore")
#: How far rounding of an inertia tensor may move its least moment.
LOST = 0.1


@dataclass(frozen=True, eq=False)
class MassProperties:
    """Mass, centre and inertia of one solid or of a batch of them.

    Args:
        mass: (...) [kg].
        centre: of mass, (..., 3) [m].
        inertia: about that centre, in the axes of the arrays it came from,
            (..., 3, 3) [kg m^2].
    """

    mass: Array
    centre: Array
    inertia: Array

    def __post_init__(self) -> None:
        mass, centre = positive("mass", self.mass), vectors("centre", self.centre)
        inertia = inertias("inertia", self.inertia)
        batch = broadcast(mass=(mass, 0), centre=(centre, 1), inertia=(inertia, 2))
        object.__setattr__(self, "mass", read_only(np.broadcast_to(mass, batch)))
        object.__setattr__(
            self, "centre", read_only(np.broadcast_to(centre, (*batch, 3)))
        )
        object.__setattr__(
            self, "inertia", read_only(np.broadcast_to(inertia, (*batch, 3, 3)))
        )

    def inertia_about(self, point: ArrayLike) -> Array:
        """Inertia about another point, (..., 3, 3) [kg m^2].

        I + m (|c|^2 1 - c c'), with c from that point to the centre: the
        parallel-axis theorem (Goldstein, *Classical Mechanics*, section 5.3).
        """
        x = vectors("point", point)
        broadcast(centre=(self.centre, 1), point=(x, 1))
        c = self.centre - x
        return self.inertia + self.mass[..., None, None] * inertia_of_second_moment(
            outer(c)
        )

    @QUIET
    def with_mass(self, mass: ArrayLike) -> MassProperties:
        """The same solid with another mass, (...) [kg].

        Inertia scales with the mass.
        """
        m = positive("mass", mass)
        broadcast(solid=(self.mass, 0), mass=(m, 0))
        return scaled_solid("mass", self.mass, self.centre, self.inertia, ("mass", m))

    def moved(self, rotation: ArrayLike, translation: ArrayLike) -> MassProperties:
        """The solid rotated, then translated: centre R c + t, inertia R I R'.

        Args:
            rotation: R, (..., 3, 3).
            translation: t, (..., 3) [m].
        """
        turn, shift = (
            rotations("rotation", rotation),
            vectors("translation", translation),
        )
        broadcast(solid=(self.mass, 0), rotation=(turn, 2), translation=(shift, 1))
        centre = np.einsum("...ij,...j->...i", turn, self.centre) + shift
        inertia = symmetric(turn @ self.inertia @ np.swapaxes(turn, -1, -2))
        return scaled_solid("rotation", self.mass, centre, inertia)


def principal_axes(inertia: ArrayLike) -> tuple[Array, Array]:
    """Principal moments, smallest first, and their axes: I = A diag(moments) A'.

    Args:
        inertia: (..., 3, 3) [kg m^2].
    Returns:
        Moments (..., 3) [kg m^2] and rotation matrices A (..., 3, 3) whose
        columns are the axes, right-handed. Axes of equal moments may be any
        orthogonal ones in their plane.
    Raises:
        ValueError: inertia is not symmetric and positive definite.
    """
    moments, axes = graded_eigh(inertias("inertia", inertia))
    # The last axis is turned round where the three are left-handed.
    sign = np.where(np.linalg.det(axes) < 0, -1.0, 1.0)
    axes[..., 2] *= sign[..., None]
    return moments, axes


@QUIET
def combined_mass_properties(parts: Iterable[MassProperties]) -> MassProperties:
    """One rigid solid made of several.

    M = sum m, c = sum m c / M, I = sum (I + m (|d|^2 1 - d d')), d = c_part - c,
    by the parallel-axis theorem (Goldstein, *Classical Mechanics*, section
    5.3). Where parts overlap, the common volume counts twice.

    Args:
        parts: at least one; batches broadcast.
    Raises:
        ValueError: no parts, something other than ``MassProperties``, batches that do
            not fit.
    """
    parts = instances("parts", parts, MassProperties)
    broadcast(**{f"parts[{i}]": (part.mass, 0) for i, part in enumerate(parts)})
    mass = np.asarray(sum(part.mass for part in parts))
    centre = sum(part.mass[..., None] * part.centre for part in parts) / mass[..., None]
    inertia = np.asarray(sum(part.inertia_about(centre) for part in parts))
    return scaled_solid("parts", mass, centre, inertia)


def inertia_of_second_moment(second: Array) -> Array:
    """Inertia from the second moment S = sum m x x', (..., 3, 3): trace(S) 1 - S.

    The diagonal is formed as S_jj + S_kk, never as a difference, so that a
    needle's small moment about its axis is as exact as the other two.
    """
    inertia = -second
    i = np.arange(3)
    inertia[..., i, i] = other_two(np.diagonal(second, axis1=-2, axis2=-1))
    return inertia


def outer(v: Array) -> Array:
    """v v', (..., 3, 3)."""
    return v[..., :, None] * v[..., None, :]


def other_two(x: Array) -> Array:
    """x_j + x_k for each i of the last axis, (..., 3)."""
    return x[..., [1, 2, 0]] + x[..., [2, 0, 1]]


def symmetric(matrix: Array) -> Array:
    """The symmetric part, (M + M')/2."""
    return 0.5 * (matrix + np.swapaxes(matrix, -1, -2))


def scaled_solid(
    argument: str,
    mass: Array,
    centre: Array,
    inertia: Array,
    given: tuple[str, Array] = ("density", np.ones(())),
) -> MassProperties:
    """The solid scaled to the density or the mass given.

    Args:
        argument: what mass and inertia were computed from, for the messages.
        mass, inertia: at density 1, or at any density where a mass is given.
        given: "density" or "mass", and its value (...).
    Raises:
        ValueError: a result that float64 cannot hold; names the argument, or
            what was given.
    """
    name, amount = given
    factor = amount if name == "density" else amount / mass
    m = amount * mass if name == "density" else np.broadcast_to(amount, factor.shape)
    tensor = factor[..., None, None] * inertia
    if not np.all(held := _held(m, tensor)):
        guilty = argument if not np.all(_held(mass, inertia)) else name
        got = f"a mass of {m[~held].flat[0]:g} kg with an inertia of "
        got += f"{np.abs(tensor[~held][0]).max():g} kg m^2"
        raise failure(guilty, "a solid whose mass and inertia float64 can hold", got)
    unit = np.ldexp(inertia, -np.frexp(np.abs(inertia).max((-2, -1), keepdims=True))[1])
    values, axes = graded_eigh(unit)
    # What rounding of the entries does to the least moment: nothing in the axes of a needle, all of it in others.
    slim = np.abs(axes[..., 0])
    lost = np.einsum("...i,...ij,...j->...", slim, np.abs(unit), slim)
    if not np.all(lost * np.finfo(float).eps < LOST * values[..., 0]):
        raise failure(
            argument,
            "a solid whose least moment of inertia survives rounding beside its largest",
            "one too thin for float64 in these axes (aligned with an axis it is exact)",
        )
    return MassProperties(m, centre, tensor)


def _held(mass: Array, inertia: Array) -> BoolArray:
    """Which of them are positive and finite."""
    size = np.abs(inertia).max(axis=(-2, -1))
    return np.asarray((mass > 0) & np.isfinite(mass) & (size > 0) & np.isfinite(size))
