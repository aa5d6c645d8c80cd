"""Every kind of collider around one mesh, by its outline seen along z."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import Array
from course.shapes import (
    Compound,
    HalfSpace,
    Mesh,
    bounding_box,
    bounding_sphere,
    capsule_around,
    compound_around,
    hull_around,
    k_dop,
    oriented_box,
)
from course.shapes.mesh_makers import dumbbell_mesh
from course.study.turned_rods import about_z

#: Ways in which a support is asked for an outline: none along a side that is drawn.
WAYS = np.radians(np.arange(720) / 2 + 0.137)
DEGREES = 30.0  # by which the dumbbell is turned about z


@dataclass(frozen=True, eq=False)
class Outlined:
    """A collider as it is seen along z.

    Args:
        name: of its kind.
        outlines: of its convex parts, (k, 2) [m] each.
        ratio: its volume over the mesh's; infinity for a half space.
        numbers: how many numbers a program keeps of it.
    """

    name: str
    outlines: tuple[Array, ...]
    ratio: float
    numbers: int


def outline(shape: Any) -> Array:
    """The outline of a convex shape seen along z, from its supports, (k, 2) [m]."""
    around = np.stack([np.cos(WAYS), np.sin(WAYS), 0 * WAYS], axis=-1)
    return np.asarray(shape.support(around)[..., :2])


def flat_dumbbell() -> Mesh:
    """A dumbbell in the plane of x and y, turned by 30 degrees."""
    return dumbbell_mesh(length=0.3).moved(about_z(DEGREES), np.zeros(3))


def seen_parts(mesh: Mesh) -> tuple[Array, ...]:
    """The outlines of a mesh's convex parts, (k, 2) [m] each."""
    return tuple(outline(hull_around(part.vertices)) for part in mesh.parts())


def collider_kinds() -> list[Outlined]:
    """The kinds around one dumbbell: what bounds it, then the compound, then a half space below it."""
    mesh = flat_dumbbell()
    points, own = mesh.vertices, mesh.volume()
    hull = hull_around(points)
    parts = [part.vertices for part in mesh.parts()]
    shapes: list[tuple[str, Any, int]] = [
        ("sphere", bounding_sphere(points), 4),
        ("capsule", capsule_around(points), 7),
        ("AABB", bounding_box(points), 6),
        ("OBB", oriented_box(points), 15),
        ("k-DOP, 14 sides", k_dop(points, 14), 14),
        ("convex hull", hull, hull.vertices.size),
    ]
    found = [
        Outlined(name, (outline(shape),), float(shape.volume()) / own, count)
        for name, shape, count in shapes
    ]
    bar = capsule_around(parts[1])
    three = Compound((bounding_sphere(parts[0]), bar, bounding_sphere(parts[2])))
    pieces = tuple(outline(part) for part in three.parts)
    found.append(Outlined("compound", pieces, float(three.volume()) / own, 4 + 7 + 4))
    level = points[:, 1].min()
    floor = HalfSpace(np.array([0.0, 1.0, 0.0]), np.asarray(level))
    edge = np.array([[-1.0, floor.offset], [1.0, floor.offset]])
    found.append(Outlined("half space", (edge,), np.inf, 4))
    return found


def compound_ratio(kind: str) -> float:
    """Volume of a compound of one kind around the dumbbell's parts, over the mesh's."""
    mesh = flat_dumbbell()
    parts = [part.vertices for part in mesh.parts()]
    return float(compound_around(parts, kind=kind).volume()) / mesh.volume()
