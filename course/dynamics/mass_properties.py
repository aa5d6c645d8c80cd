"""Mass, centre of mass and inertia of solids of even density, from plain arrays (syllabus row 14)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    IntArray,
    broadcast,
    failure,
    indices,
    inertias,
    positive,
    read_only,
    rotations,
    vectors,
)

#: A hull this much thinner than wide is called flat: its volume would be rounding.
FLATNESS = 1e-12


@dataclass(frozen=True, eq=False)
class MassProperties:
    """Mass, centre and inertia of one solid or of a batch of them.

    Args:
        mass: (...) [kg].
        centre: of mass, (..., 3) [m].
        inertia: about that centre, in the axes of the arrays it came from, (..., 3, 3) [kg m^2].
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
        """Inertia about another point: I + m (|c|^2 1 - c c'), c from there to the centre, (..., 3, 3).

        The parallel-axis theorem (Goldstein, *Classical Mechanics*, section 5.3).
        """
        x = vectors("point", point)
        broadcast(centre=(self.centre, 1), point=(x, 1))
        c = self.centre - x
        return self.inertia + self.mass[..., None, None] * _about_origin(_outer(c))

    def with_mass(self, mass: ArrayLike) -> MassProperties:
        """The same solid at another density: inertia in proportion to mass, (...) [kg]."""
        m = positive("mass", mass)
        broadcast(solid=(self.mass, 0), mass=(m, 0))
        return MassProperties(
            m, self.centre, self.inertia * (m / self.mass)[..., None, None]
        )

    def moved(self, rotation: ArrayLike, translation: ArrayLike) -> MassProperties:
        """The solid turned, then shifted: centre R c + t, inertia R I R'.

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
        return MassProperties(
            self.mass,
            centre,
            _symmetric(turn @ self.inertia @ np.swapaxes(turn, -1, -2)),
        )


def principal_axes(inertia: ArrayLike) -> tuple[Array, Array]:
    """Principal moments, least first, and the axes they belong to: I = A diag(moments) A'.

    Args:
        inertia: (..., 3, 3) [kg m^2].
    Returns:
        Moments (..., 3) [kg m^2] and rotation matrices A (..., 3, 3) whose
        columns are the axes, right-handed. Axes of equal moments are any in their plane.
    Raises:
        ValueError: inertia is not symmetric and positive definite.
    """
    moments, axes = np.linalg.eigh(inertias("inertia", inertia))
    # The last axis is turned round where the three are left-handed.
    sign = np.where(np.linalg.det(axes) < 0, -1.0, 1.0)
    axes[..., 2] *= sign[..., None]
    return moments, axes


def sphere_mass_properties(
    center: ArrayLike, radius: ArrayLike, *, density: ArrayLike
) -> MassProperties:
    """A solid sphere: m = 4/3 pi r^3 rho, I = 2/5 m r^2 (Goldstein, *Classical Mechanics*, section 5.3).

    Args:
        center: (..., 3) [m].
        radius: (...) [m].
        density: rho, (...) [kg/m^3].
    Raises:
        ValueError: a radius or density that is not positive, a wrong shape.
    """
    c, r, rho = (
        vectors("center", center),
        positive("radius", radius),
        positive("density", density),
    )
    batch = broadcast(center=(c, 1), radius=(r, 0), density=(rho, 0))
    r, rho = np.broadcast_to(r, batch), np.broadcast_to(rho, batch)
    mass = 4 / 3 * np.pi * r**3 * rho
    return MassProperties(mass, c, (0.4 * mass * r**2)[..., None, None] * np.eye(3))


def box_mass_properties(
    center: ArrayLike,
    rotation: ArrayLike,
    half_extents: ArrayLike,
    *,
    density: ArrayLike,
) -> MassProperties:
    """A solid box: m = 8 e1 e2 e3 rho, I = R diag(m/3 (|e|^2 - e_i^2)) R' (Goldstein, section 5.3).

    Args:
        center: (..., 3) [m].
        rotation: R, columns the box's axes, (..., 3, 3).
        half_extents: e, (..., 3) [m].
        density: rho, (...) [kg/m^3].
    Raises:
        ValueError: an extent or density that is not positive, axes not orthonormal, a wrong shape.
    """
    c, turn, rho = (
        vectors("center", center),
        rotations("rotation", rotation),
        positive("density", density),
    )
    e = positive("half_extents", vectors("half_extents", half_extents))
    broadcast(center=(c, 1), rotation=(turn, 2), half_extents=(e, 1), density=(rho, 0))
    mass = 8 * np.prod(e, axis=-1) * rho
    moments = mass[..., None] / 3 * (np.sum(e**2, axis=-1, keepdims=True) - e**2)
    inertia = _symmetric((turn * moments[..., None, :]) @ np.swapaxes(turn, -1, -2))
    return MassProperties(mass, c, inertia)


def capsule_mass_properties(
    start: ArrayLike, end: ArrayLike, radius: ArrayLike, *, density: ArrayLike
) -> MassProperties:
    """A solid capsule: a cylinder of length l and two half spheres.

    With masses m_c = pi r^2 l rho and m_s = 4/3 pi r^3 rho: along the axis
    m_c r^2/2 + 2/5 m_s r^2, across it m_c (l^2/12 + r^2/4) +
    m_s (2/5 r^2 + l^2/4 + 3/8 l r). A half sphere's centre lies 3/8 r from its
    face; the parallel-axis theorem does the rest (D. Eberly, "Polyhedral mass
    properties (revisited)", for solids in general). Length 0 is a sphere.

    Args:
        start, end: of the axis, centres of the half spheres, (..., 3) [m].
        radius: (...) [m].
        density: rho, (...) [kg/m^3].
    Raises:
        ValueError: a radius or density that is not positive, a wrong shape.
    """
    a, b = vectors("start", start), vectors("end", end)
    r, rho = positive("radius", radius), positive("density", density)
    batch = broadcast(start=(a, 1), end=(b, 1), radius=(r, 0), density=(rho, 0))
    r, rho = np.broadcast_to(r, batch), np.broadcast_to(rho, batch)
    length = np.broadcast_to(np.linalg.norm(b - a, axis=-1), batch)
    axis = np.divide(
        b - a, length[..., None], out=np.zeros((*batch, 3)), where=length[..., None] > 0
    )
    cylinder, sphere = np.pi * r**2 * length * rho, 4 / 3 * np.pi * r**3 * rho
    along = cylinder * r**2 / 2 + 0.4 * sphere * r**2
    across = cylinder * (length**2 / 12 + r**2 / 4) + sphere * (
        0.4 * r**2 + length**2 / 4 + 3 / 8 * length * r
    )
    inertia = across[..., None, None] * np.eye(3) + (along - across)[
        ..., None, None
    ] * _outer(axis)
    return MassProperties(cylinder + sphere, a + (b - a) / 2, inertia)


def hull_mass_properties(
    vertices: ArrayLike, *, density: ArrayLike, triangles: ArrayLike | None = None
) -> MassProperties:
    """A solid convex hull, by exact integrals over the tetrahedra between its faces and a point inside.

    A tetrahedron with corners 0, a, b, c has volume V = a.(b x c)/6, centre
    (a + b + c)/4 and second moment V/20 (aa' + bb' + cc' + ss'), s = a + b + c
    (F. Tonon, J. Math. Stat. 1, 2005; B. Mirtich, J. Graphics Tools 1, 1996).

    Args:
        vertices: (k, 3) [m]; (..., k, 3) where triangles are given.
        density: rho, (...) [kg/m^3].
        triangles: (t, 3) rows of vertices, counterclockwise seen from outside, that close the surface. Where
            none are given, the faces of ``scipy.spatial.ConvexHull``. Given ones need not be convex.
    Raises:
        ValueError: points that span no volume, triangles that leave a hole or look inward.
    """
    points, rho = vectors("vertices", vertices), positive("density", density)
    if points.ndim < 2 or points.shape[-2] < 4:
        raise failure(
            "vertices", "at least 4 points, shape (..., k, 3)", f"shape {points.shape}"
        )
    broadcast(vertices=(points, 2), density=(rho, 0))
    origin = points.mean(axis=-2, keepdims=True)
    _require_solid(points - origin)
    faces = (
        _hull_faces(points)
        if triangles is None
        else _closed(triangles, points.shape[-2])
    )
    corners = (points - origin)[..., faces, :]
    volume = np.linalg.det(corners) / 6
    total = volume.sum(axis=-1)
    if np.any(total <= 0):
        expected = (
            "counterclockwise rows seen from outside, around a solid that is not hollow"
        )
        raise failure("triangles", expected, f"volume {total.min()!r}")
    sums = corners.sum(axis=-2)
    centre = np.einsum("...t,...ti->...i", volume, sums) / (4 * total[..., None])
    second = np.einsum("...t,...tki,...tkj->...ij", volume, corners, corners)
    second = (second + np.einsum("...t,...ti,...tj->...ij", volume, sums, sums)) / 20
    central = rho[..., None, None] * (second - total[..., None, None] * _outer(centre))
    return MassProperties(
        rho * total, origin[..., 0, :] + centre, _symmetric(_about_origin(central))
    )


def combined_mass_properties(parts: Sequence[MassProperties]) -> MassProperties:
    """One rigid solid of several: masses add, the centre is their mean, inertias add about it.

    M = sum m, c = sum m c / M, I = sum (I + m (|d|^2 1 - d d')), d = c_part - c,
    by the parallel-axis theorem (Goldstein, *Classical Mechanics*, section
    5.3). Where parts overlap, what they share counts twice.

    Args:
        parts: at least one; batches broadcast.
    Raises:
        ValueError: no parts, something else than ``MassProperties``, batches that do not fit.
    """
    parts = list(parts)
    if not parts:
        raise failure("parts", "at least one MassProperties", "none")
    for i, part in enumerate(parts):
        if not isinstance(part, MassProperties):
            raise failure("parts", "MassProperties", type(part).__name__, (i,))
    broadcast(**{f"parts[{i}]": (part.mass, 0) for i, part in enumerate(parts)})
    mass = np.asarray(sum(part.mass for part in parts))
    centre = sum(part.mass[..., None] * part.centre for part in parts) / mass[..., None]
    return MassProperties(
        mass, centre, np.asarray(sum(part.inertia_about(centre) for part in parts))
    )


def _outer(v: Array) -> Array:
    return v[..., :, None] * v[..., None, :]


def _about_origin(second: Array) -> Array:
    """Inertia of a second moment S = sum m x x': trace(S) 1 - S."""
    return np.trace(second, axis1=-2, axis2=-1)[..., None, None] * np.eye(3) - second


def _symmetric(matrix: Array) -> Array:
    return 0.5 * (matrix + np.swapaxes(matrix, -1, -2))


def _require_solid(centred: Array) -> None:
    widths = np.linalg.svd(centred, compute_uv=False)
    flat = widths[..., 2] <= FLATNESS * widths[..., 0]
    if np.any(flat):
        index = tuple(np.argwhere(flat)[0])
        thin, wide = widths[index][2], widths[index][0]
        what = f"flat ones (thickness to width {thin / wide if wide else 0.0:.1g})"
        raise failure("vertices", "points that span a volume", what, index)


def _hull_faces(points: Array) -> IntArray:
    """The faces of one convex hull, each counterclockwise seen from outside."""
    from scipy.spatial import ConvexHull, QhullError

    if points.ndim != 2:
        raise failure(
            "vertices",
            "shape (k, 3) where no triangles are given",
            f"shape {points.shape}",
        )
    try:
        hull = ConvexHull(points)
    except QhullError as error:
        reason = str(error).splitlines()[0][:60]
        raise failure(
            "vertices", "points that span a volume", f"flat ones ({reason})"
        ) from None
    faces = hull.simplices.astype(np.intp)
    a, b, c = (points[faces[:, i]] for i in range(3))
    inward = np.sum(np.cross(b - a, c - a) * hull.equations[:, :3], axis=1) < 0
    faces[inward] = faces[inward][:, ::-1]
    return faces


def _closed(triangles: ArrayLike, count: int) -> IntArray:
    faces = indices("triangles", triangles, count)
    if faces.ndim != 2 or faces.shape[1] != 3:
        raise failure("triangles", "shape (t, 3)", f"shape {faces.shape}")
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    forward, backward = (
        edges[:, 0] * count + edges[:, 1],
        edges[:, 1] * count + edges[:, 0],
    )
    unique, times = np.unique(forward, return_counts=True)
    lonely = ~np.isin(backward, forward) | (times[np.searchsorted(unique, forward)] > 1)
    if np.any(lonely):
        start, end = (int(i) for i in edges[int(np.argmax(lonely))])
        expected = "a closed surface, each edge once in each direction"
        raise failure(
            "triangles", expected, f"edge {start}-{end} without its match (a hole?)"
        )
    return faces
