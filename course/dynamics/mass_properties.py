"""Mass, centre of mass and inertia of homogeneous solids, from plain arrays.

Syllabus row 14. A solid is given its density or its mass.
"""

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
    written,
)
from course.dynamics.convex_faces import closed_faces, hull_faces, require_solid

#: Overflow is refused by name at the end (``_solid``); no warning on the way there.
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
            _outer(c)
        )

    @QUIET
    def with_mass(self, mass: ArrayLike) -> MassProperties:
        """The same solid with another mass, (...) [kg].

        Inertia scales with the mass.
        """
        m = positive("mass", mass)
        broadcast(solid=(self.mass, 0), mass=(m, 0))
        return _solid("mass", self.mass, self.centre, self.inertia, ("mass", m))

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
        inertia = _symmetric(turn @ self.inertia @ np.swapaxes(turn, -1, -2))
        return _solid("rotation", self.mass, centre, inertia)


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
def sphere_mass_properties(
    center: ArrayLike,
    radius: ArrayLike,
    *,
    density: ArrayLike | None = None,
    mass: ArrayLike | None = None,
) -> MassProperties:
    """A solid sphere: m = 4/3 pi r^3 rho, I = 2/5 m r^2.

    Source: Goldstein, *Classical Mechanics*, section 5.3.

    Args:
        center: (..., 3) [m].
        radius: (...) [m].
        density, mass: rho, (...) [kg/m^3], or m, (...) [kg]; exactly one of them.
    Raises:
        ValueError: a radius, density or mass that is not positive, both or neither
            of density and mass, a wrong shape.
    """
    c, r = vectors("center", center), positive("radius", radius)
    given = name, amount = _density_or_mass(density, mass)
    broadcast(center=(c, 1), radius=(r, 0), **{name: (amount, 0)})
    volume = 4 / 3 * np.pi * r**3
    inertia = (0.4 * volume * r**2)[..., None, None] * np.eye(3)
    return _solid("radius", volume, c, inertia, given)


@QUIET
def box_mass_properties(
    center: ArrayLike,
    rotation: ArrayLike,
    half_extents: ArrayLike,
    *,
    density: ArrayLike | None = None,
    mass: ArrayLike | None = None,
) -> MassProperties:
    """A solid box: m = 8 e1 e2 e3 rho, I = R diag(m/3 (e_j^2 + e_k^2)) R'.

    Source: Goldstein, *Classical Mechanics*, section 5.3.

    Args:
        center: (..., 3) [m].
        rotation: R, columns the box's axes, (..., 3, 3).
        half_extents: e, (..., 3) [m].
        density, mass: rho, (...) [kg/m^3], or m, (...) [kg]; exactly one of them.
    Raises:
        ValueError: an extent, density or mass that is not positive, both or neither
            of density and mass, axes that are not orthonormal, a wrong shape.
    """
    c, turn = vectors("center", center), rotations("rotation", rotation)
    e = positive("half_extents", vectors("half_extents", half_extents))
    given = name, amount = _density_or_mass(density, mass)
    batch = dict(center=(c, 1), rotation=(turn, 2), half_extents=(e, 1))
    broadcast(**batch, **{name: (amount, 0)})
    volume = 8 * np.prod(e, axis=-1)
    moments = volume[..., None] / 3 * _other_two(e**2)
    inertia = _symmetric((turn * moments[..., None, :]) @ np.swapaxes(turn, -1, -2))
    return _solid("half_extents", volume, c, inertia, given)


@QUIET
def capsule_mass_properties(
    start: ArrayLike,
    end: ArrayLike,
    radius: ArrayLike,
    *,
    density: ArrayLike | None = None,
    mass: ArrayLike | None = None,
) -> MassProperties:
    """A solid capsule: a cylinder of length l and two hemispheres.

    With masses m_c = pi r^2 l rho and m_s = 4/3 pi r^3 rho: along the axis
    m_c r^2/2 + 2/5 m_s r^2, across it m_c (l^2/12 + r^2/4) +
    m_s (2/5 r^2 + l^2/4 + 3/8 l r). A hemisphere's centre of mass lies 3/8 r from
    its face; the rest follows from the parallel-axis theorem (D. Eberly,
    "Polyhedral mass properties (revisited)", for solids in general). A capsule of
    length 0 is a sphere.

    Args:
        start, end: of the axis, the centres of the hemispheres, (..., 3) [m].
        radius: (...) [m].
        density, mass: rho, (...) [kg/m^3], or m, (...) [kg]; exactly one of them.
    Raises:
        ValueError: a radius, density or mass that is not positive, both or neither
            of density and mass, a wrong shape.
    """
    a, b = vectors("start", start), vectors("end", end)
    r, given = positive("radius", radius), _density_or_mass(density, mass)
    name, amount = given
    batch = broadcast(start=(a, 1), end=(b, 1), radius=(r, 0), **{name: (amount, 0)})
    r = np.broadcast_to(r, batch)
    length = np.broadcast_to(np.linalg.norm(b - a, axis=-1), batch)
    axis = np.divide(
        b - a, length[..., None], out=np.zeros((*batch, 3)), where=length[..., None] > 0
    )
    cylinder, sphere = np.pi * r**2 * length, 4 / 3 * np.pi * r**3
    along = cylinder * r**2 / 2 + 0.4 * sphere * r**2
    across = cylinder * (length**2 / 12 + r**2 / 4) + sphere * (
        0.4 * r**2 + length**2 / 4 + 3 / 8 * length * r
    )
    # along nn' + across (1 - nn'), where 1 - n_i^2 is formed as the sum of the other
    # two squares, so that nothing cancels.
    projector = _outer(axis)
    rest = np.where(
        length[..., None, None] > 0, inertia_of_second_moment(projector), np.eye(3)
    )
    inertia = along[..., None, None] * projector + across[..., None, None] * rest
    return _solid("radius", cylinder + sphere, a + (b - a) / 2, inertia, given)


@QUIET
def hull_mass_properties(
    vertices: ArrayLike,
    *,
    density: ArrayLike | None = None,
    mass: ArrayLike | None = None,
    triangles: ArrayLike | None = None,
) -> MassProperties:
    """A solid convex hull, by exact integrals over tetrahedra.

    Each face and a point inside span one. A tetrahedron with corners 0, a, b, c has
    volume V = a.(b x c)/6, centre (a + b + c)/4 and second moment V/20 (aa' + bb' + cc'
    + ss'), s = a + b + c (F. Tonon, J. Math. Stat. 1, 2005; B. Mirtich, J. Graphics
    Tools 1, 1996).

    Args:
        vertices: (k, 3) [m]; (..., k, 3) where triangles are given.
        density, mass: rho, (...) [kg/m^3], or m, (...) [kg]; exactly one of them.
        triangles: (t, 3) rows of vertices, counterclockwise seen from outside, that
            enclose the solid, which need not be convex. Default: the faces of
            ``scipy.spatial.ConvexHull``.
    Raises:
        ValueError: points that span no volume, triangles that leave a hole or face
            inward, both or neither of density and mass.
    """
    points, given = vectors("vertices", vertices), _density_or_mass(density, mass)
    if points.ndim < 2 or points.shape[-2] < 4:
        raise failure(
            "vertices", "at least 4 points, shape (..., k, 3)", f"shape {points.shape}"
        )
    broadcast(vertices=(points, 2), **{given[0]: (given[1], 0)})
    origin = points.mean(axis=-2, keepdims=True)
    require_solid(points - origin)
    faces = (
        hull_faces(points)
        if triangles is None
        else closed_faces(triangles, points.shape[-2])
    )
    # In a unit near the solid's width, so that its volume neither over- nor underflows.
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
    return _solid("vertices", volume, origin[..., 0, :] + shift, inertia, given)


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
    return _solid("parts", mass, centre, inertia)


def _outer(v: Array) -> Array:
    return v[..., :, None] * v[..., None, :]


def inertia_of_second_moment(second: Array) -> Array:
    """Inertia from the second moment S = sum m x x', (..., 3, 3): trace(S) 1 - S.

    The diagonal is formed as S_jj + S_kk, never as a difference, so that a
    needle's small moment about its axis is as exact as the other two.
    """
    inertia = -second
    i = np.arange(3)
    inertia[..., i, i] = _other_two(np.diagonal(second, axis1=-2, axis2=-1))
    return inertia


def _other_two(x: Array) -> Array:
    """x_j + x_k for each i of the last axis, (..., 3)."""
    return x[..., [1, 2, 0]] + x[..., [2, 0, 1]]


def _density_or_mass(
    density: ArrayLike | None, mass: ArrayLike | None
) -> tuple[str, Array]:
    """Which of the two is given, by name, and its checked value (...)."""
    expected = "exactly one of density and mass"
    if density is None and mass is None:
        raise failure("density", expected, "neither")
    if density is not None and mass is not None:
        raise failure("density", expected, "both")
    if density is not None:
        return "density", positive("density", density)
    assert mass is not None
    return "mass", positive("mass", mass)


def _solid(
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


def _symmetric(matrix: Array) -> Array:
    return 0.5 * (matrix + np.swapaxes(matrix, -1, -2))
