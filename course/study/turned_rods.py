"""A rod that turns: the volumes of the colliders around it, over its own."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array
from course.shapes import (
    OBB,
    bounding_box,
    bounding_sphere,
    capsule_around,
    k_dop,
    oriented_box,
)

#: Half the sides of a rod of 1 m by 1 cm by 1 cm [m].
ROD = np.array([0.5, 0.005, 0.005])
CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1.0)])
#: How each kind is fitted to points, by its name in a legend.
KINDS: dict[str, Callable[[Array], Any]] = {
    "AABB": bounding_box,
    "14-DOP": lambda points: k_dop(points, 14),
    "18-DOP": lambda points: k_dop(points, 18),
    "26-DOP": lambda points: k_dop(points, 26),
    "sphere": bounding_sphere,
    "capsule": capsule_around,
    "OBB": lambda points: oriented_box(points, method="face_directions"),
}


def about_z(degrees: Any) -> Array:
    """Rotations about z, from x toward y, (..., 3, 3)."""
    angle = np.radians(np.asarray(degrees, dtype=float))
    c, s, zero = np.cos(angle), np.sin(angle), np.zeros(angle.shape)
    rows = [[c, -s, zero], [s, c, zero], [zero, zero, zero + 1]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def box_corners(half_extents: Any, rotation: Any) -> Array:
    """The corners of boxes about the origin, (..., 8, 3) [m]."""
    placed = CORNERS * np.asarray(half_extents)[..., None, :]
    return np.asarray(placed @ np.swapaxes(rotation, -1, -2))


def predicted_growth(degrees: Any, thinness: float) -> Array:
    """The AABB over the rod, 1 + sin(2 theta) (q + 1/q)/2, q the thickness over the length.

    Source: the product of ``box_growth`` multiplied out; theta between 0 and 90 degrees.
    """
    q = thinness
    twice = np.abs(np.sin(2 * np.radians(np.asarray(degrees, dtype=float))))
    return np.asarray(1 + twice * (q + 1 / q) / 2)


def angle_of_growth(growth: float, thinness: float) -> float:
    """The least angle at which the AABB is so many times the rod [degrees]."""
    q = thinness
    return float(np.degrees(0.5 * np.arcsin(2 * (growth - 1) / (q + 1 / q))))


@dataclass(frozen=True, eq=False)
class TurnedRod:
    """A rod turned about z, and what is around it.

    Args:
        degrees: (t,).
        half_extents: of the rod, (3,) [m].
        extents: half extents of the AABB, (t, 3) [m].
        growth: the volume of the AABB over the rod's, (t,).
    """

    degrees: Array
    half_extents: Array
    extents: Array
    growth: Array


def turned_rod(degrees: Any, half_extents: Any = ROD) -> TurnedRod:
    """A rod at each of these angles, and the box along the axes around it."""
    e, angle = np.asarray(half_extents, dtype=float), np.asarray(degrees, dtype=float)
    extents = formulas.rotated_box_extents(e, about_z(angle))
    return TurnedRod(angle, e, extents, np.prod(extents / e, axis=-1))


def rod_volumes(
    degrees: Any, kinds: Sequence[str] = tuple(KINDS), half_extents: Any = ROD
) -> dict[str, Array]:
    """Volumes of colliders fitted to the turned rod's corners, over the rod's own, (t,) each."""
    e = np.asarray(half_extents, dtype=float)
    points = box_corners(e, about_z(degrees))
    own = float(OBB(np.zeros(3), np.eye(3), e).volume())
    return {kind: np.asarray(KINDS[kind](points).volume()) / own for kind in kinds}
