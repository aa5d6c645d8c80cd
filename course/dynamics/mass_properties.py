"""Mass, centre of mass and inertia of solids of even density, from plain arrays (syllabus row 14)."""

from __future__ import annotations

from collections.abc import Sequence
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
    positive,
    read_only,
    rotations,
    vectors,
    written,
)
from course.dynamics.convex_faces import closed_faces, hull_faces, require_solid

#: What float64 cannot hold is refused by name (``_solid``), not warned of on the way there.
QUIET = np.errstate(over="ignore", invalid="ignore")
#: How far rounding of an inertia tensor may move its least moment.
LOST = 0.1


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
        return self.inertia + self.mass[..., None, None] * inertia_of_second_moment(
            _outer(c)
        )

    @QUIET
    def with_mass(self, mass: ArrayLike) -> MassProperties:
        """The same solid at another density: inertia in proportion to mass, (...) [kg]."""
        m = positive("mass", mass)
        broadcast(solid=(self.mass, 0), mass=(m, 0))
        inertia = self.inertia * (m / self.mass)[..., None, None]
        return _solid("mass", m, self.centre, inertia)

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
        inertia = _symmetric(turn @ self.inertia @ np.swapaxes(turn, -1, -2))
        return _solid("rotation", self.mass, centre, inertia)


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
    moments, axes = graded_eigh(inertias("inertia", inertia))
    # The last axis is turned round where the three are left-handed.
    sign = np.where(np.linalg.det(axes) < 0, -1.0, 1.0)
    axes[..., 2] *= sign[..., None]
    return moments, axes


@QUIET
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
    volume = 4 / 3 * np.pi * r**3
    inertia = (0.4 * volume * r**2)[..., None, None] * np.eye(3)
    return _solid("radius", volume, c, inertia, rho)


@QUIET
def box_mass_properties(
    center: ArrayLike,
    rotation: ArrayLike,
    half_extents: ArrayLike,
    *,
    density: ArrayLike,
) -> MassProperties:
    """A solid box: m = 8 e1 e2 e3 rho, I = R diag(m/3 (e_j^2 + e_k^2)) R' (Goldstein, section 5.3).

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
    volume = 8 * np.prod(e, axis=-1)
    moments = volume[..., None] / 3 * _other_two(e**2)
    inertia = _symmetric((turn * moments[..., None, :]) @ np.swapaxes(turn, -1, -2))
    return _solid("half_extents", volume, c, inertia, rho)


@QUIET
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
    cylinder, sphere = np.pi * r**2 * length, 4 / 3 * np.pi * r**3
    along = cylinder * r**2 / 2 + 0.4 * sphere * r**2
    across = cylinder * (length**2 / 12 + r**2 / 4) + sphere * (
        0.4 * r**2 + length**2 / 4 + 3 / 8 * length * r
    )
    # along nn' + across (1 - nn'), with 1 - n_i^2 as the sum of the other two squares: no difference of the two.
    projector = _outer(axis)
    rest = np.where(
        length[..., None, None] > 0, inertia_of_second_moment(projector), np.eye(3)
    )
    inertia = along[..., None, None] * projector + across[..., None, None] * rest
    return _solid("radius", cylinder + sphere, a + (b - a) / 2, inertia, rho)


@QUIET
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
    require_solid(points - origin)
    faces = (
        hull_faces(points)
        if triangles is None
        else closed_faces(triangles, points.shape[-2])
    )
    # In a unit near their width, so that no volume leaves the range of float64.
    unit = np.frexp(np.abs(points - origin).max())[1]
    corners = np.ldexp(points - origin, -unit)[..., faces, :]
    volume = np.linalg.det(corners) / 6
    total = volume.sum(axis=-1)
    if np.any(total <= 0):
        expected = (
            "counterclockwise rows seen from outside, around a solid that is not hollow"
        )
        got = float(np.ldexp(total.min(), 3 * unit))
        raise failure("triangles", expected, f"volume {written(got)}")
    sums = corners.sum(axis=-2)
    centre = np.einsum("...t,...ti->...i", volume, sums) / (4 * total[..., None])
    second = np.einsum("...t,...tki,...tkj->...ij", volume, corners, corners)
    second = (second + np.einsum("...t,...ti,...tj->...ij", volume, sums, sums)) / 20
    central = second - total[..., None, None] * _outer(centre)
    inertia = np.ldexp(_symmetric(inertia_of_second_moment(central)), 5 * unit)
    volume, shift = np.ldexp(total, 3 * unit), np.ldexp(centre, unit)
    return _solid("vertices", volume, origin[..., 0, :] + shift, inertia, rho)


@QUIET
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
            raise failure(f"parts[{i}]", "MassProperties", type(part).__name__)
    broadcast(**{f"parts[{i}]": (part.mass, 0) for i, part in enumerate(parts)})
    mass = np.asarray(sum(part.mass for part in parts))
    centre = sum(part.mass[..., None] * part.centre for part in parts) / mass[..., None]
    inertia = np.asarray(sum(part.inertia_about(centre) for part in parts))
    return _solid("parts", mass, centre, inertia)


def _outer(v: Array) -> Array:
    return v[..., :, None] * v[..., None, :]


def inertia_of_second_moment(second: Array) -> Array:
    """Inertia of a second moment S = sum m x x', (..., 3, 3): trace(S) 1 - S.

    The diagonal is formed as S_jj + S_kk, never as a difference: of a needle
    that leaves its small moment about its axis as exact as the others.
    """
    inertia = -second
    i = np.arange(3)
    inertia[..., i, i] = _other_two(np.diagonal(second, axis1=-2, axis2=-1))
    return inertia


def _other_two(x: Array) -> Array:
    """x_j + x_k for each i of the last axis, (..., 3)."""
    return x[..., [1, 2, 0]] + x[..., [2, 0, 1]]


def _solid(
    argument: str, mass: Array, centre: Array, inertia: Array, density: ArrayLike = 1.0
) -> MassProperties:
    """Mass and inertia times the density; if float64 cannot hold them, the argument is named, or the density."""
    rho = np.asarray(density)
    m, tensor = rho * mass, rho[..., None, None] * inertia
    if not np.all(held := _held(m, tensor)):
        guilty = argument if not np.all(_held(mass, inertia)) else "density"
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
            "a solid whose least moment of inertia is not lost beside its largest",
            "one too thin for float64 in these axes (along an axis it is held exactly)",
        )
    return MassProperties(m, centre, tensor)


def _held(mass: Array, inertia: Array) -> BoolArray:
    """Which of them are above 0 and finite."""
    size = np.abs(inertia).max(axis=(-2, -1))
    return np.asarray((mass > 0) & np.isfinite(mass) & (size > 0) & np.isfinite(size))


def _symmetric(matrix: Array) -> Array:
    return 0.5 * (matrix + np.swapaxes(matrix, -1, -2))
