"""Mass, centre of mass and inertia of homogeneous solids, from plain arrays (syllabus row 14).

A solid is given its density or its mass.
"""

from __future__ import annotations

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    broadcast,
    failure,
    positive,
    rotations,
    vectors,
    written,
)
from course.dynamics.convex_faces import closed_faces, hull_faces, require_solid
from course.dynamics.mass_properties import (
    QUIET,
    MassProperties,
    inertia_of_second_moment,
    other_two,
    outer,
    scaled_solid,
    symmetric,
)


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
    return scaled_solid("radius", volume, c, inertia, given)


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
    moments = volume[..., None] / 3 * other_two(e**2)
    inertia = symmetric((turn * moments[..., None, :]) @ np.swapaxes(turn, -1, -2))
    return scaled_solid("half_extents", volume, c, inertia, given)


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
    projector = outer(axis)
    rest = np.where(
        length[..., None, None] > 0, inertia_of_second_moment(projector), np.eye(3)
    )
    inertia = along[..., None, None] * projector + across[..., None, None] * rest
    return scaled_solid("radius", cylinder + sphere, a + (b - a) / 2, inertia, given)


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
    central = second - total[..., None, None] * outer(centre)
    inertia = np.ldexp(symmetric(inertia_of_second_moment(central)), 5 * unit)
    volume, shift = np.ldexp(total, 3 * unit), np.ldexp(centre, unit)
    return scaled_solid("vertices", volume, origin[..., 0, :] + shift, inertia, given)


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
