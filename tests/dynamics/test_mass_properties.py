"""Mass, centre and inertia against closed forms, quadrature, chance, and trimesh."""

import itertools
import re
import warnings
from fractions import Fraction

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.spatial import ConvexHull, Delaunay
from scipy.spatial.transform import Rotation

from course.dynamics import (
    MassProperties,
    box_mass_properties,
    capsule_mass_properties,
    combined_mass_properties,
    hull_mass_properties,
    principal_axes,
    sphere_mass_properties,
)

SEEDS = [0, 1, 2]


def box_corners(half_extents):
    signs = np.array(
        [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float
    )
    return signs * half_extents


def assert_same(one, other, tolerance=1e-12):
    assert np.allclose(one.mass, other.mass, rtol=tolerance, atol=0)
    assert np.allclose(one.centre, other.centre, rtol=tolerance, atol=tolerance)
    size = np.abs(other.inertia).max()
    assert np.allclose(
        one.inertia, other.inertia, rtol=tolerance, atol=tolerance * size
    )


def test_one_worked_number_each():
    # Box 2 x 4 x 6 m of 1 kg/m^3: 48 kg, m/12 (b^2 + c^2) with edges b, c.
    box = box_mass_properties([1, 2, 3], np.eye(3), [1, 2, 3], density=1.0)
    assert box.mass == pytest.approx(48) and np.allclose(box.centre, [1, 2, 3])
    assert np.allclose(box.inertia, np.diag([4 * 52, 4 * 40, 4 * 20]))
    # Sphere of radius 1: 2/5 m.
    sphere = sphere_mass_properties([0, 0, 0], 1.0, density=3.0)
    assert sphere.mass == pytest.approx(4 * np.pi) and np.allclose(
        sphere.inertia, 0.4 * 4 * np.pi * np.eye(3)
    )
    # Corner tetrahedron 0, e1, e2, e3: V = 1/6, centre 1/4, I = V (3/40) on the diagonal about the
    # centre, V/80 off it, with the sign of -(xy - x y) (second moments 1/60 and 1/120 about the corner).
    corner = hull_mass_properties(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], density=6.0
    )
    assert corner.mass == pytest.approx(1) and np.allclose(corner.centre, 0.25)
    expected = np.full((3, 3), 1 / 16 - 1 / 20) + np.diag(
        [2 * (1 / 10 - 1 / 16) - (1 / 16 - 1 / 20)] * 3
    )
    assert np.allclose(corner.inertia, expected, atol=1e-15)


@pytest.mark.parametrize("length", [0.0, 0.7, 30.0])
def test_capsule_by_quadrature_over_slices(length):
    r, rho = 0.4, 2.5

    def square(z):  # of the radius of the slice at height z
        return r**2 - max(abs(z) - length / 2, 0.0) ** 2

    def over_slices(f):
        ends = [-length / 2 - r, -length / 2, length / 2, length / 2 + r]
        return sum(
            quad(f, a, b, epsabs=0, epsrel=1e-12)[0]
            for a, b in zip(ends, ends[1:], strict=False)
            if b > a
        )

    mass = rho * np.pi * over_slices(square)
    along = rho * np.pi / 2 * over_slices(lambda z: square(z) ** 2)
    across = rho * np.pi * over_slices(lambda z: square(z) ** 2 / 4 + square(z) * z * z)
    axis = np.array([2.0, -1.0, 2.0]) / 3
    middle = np.array([1.0, 5.0, -3.0])
    capsule = capsule_mass_properties(
        middle - length / 2 * axis, middle + length / 2 * axis, r, density=rho
    )
    assert capsule.mass == pytest.approx(mass, rel=1e-11)
    assert np.allclose(capsule.centre, middle)
    expected = across * np.eye(3) + (along - across) * np.outer(axis, axis)
    assert np.allclose(capsule.inertia, expected, rtol=1e-11, atol=1e-11 * across)


def test_capsule_of_length_0_is_a_sphere():
    point = [1.0, 2.0, 3.0]
    assert_same(
        capsule_mass_properties(point, point, 0.3, density=7.0),
        sphere_mass_properties(point, 0.3, density=7.0),
    )


@pytest.mark.parametrize("seed", SEEDS)
def test_a_box_is_the_hull_of_its_corners_wherever_it_is(seed):
    rng = np.random.default_rng(seed)
    e, turn = rng.uniform(0.1, 3, 3), Rotation.random(random_state=rng).as_matrix()
    for far in (0.0, 1.0, 1e6):
        center = far * rng.normal(size=3)
        hull = hull_mass_properties(box_corners(e) @ turn.T + center, density=3.0)
        box = box_mass_properties(center, turn, e, density=3.0)
        assert_same(
            hull, box, 1e-12 if far <= 1 else 1e-8
        )  # corners at 1e6 m are rounded by 1e-10 m


@pytest.mark.parametrize("seed", SEEDS)
def test_a_hull_by_chance(seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(14, 3)) * [2.0, 1.0, 0.5] + [3.0, -1.0, 0.0]
    hull = hull_mass_properties(points, density=1.0)
    low, high = points.min(axis=0), points.max(axis=0)
    count, volume = 200_000, np.prod(high - low)
    sample = rng.uniform(low, high, (count, 3))
    inside = Delaunay(points).find_simplex(sample) >= 0
    r = sample - hull.centre
    integrands = np.stack(
        [
            np.ones(count),
            *r.T,
            *(np.sum(r * r, axis=1) - r.T**2),
            r[:, 0] * r[:, 1],
            r[:, 0] * r[:, 2],
            r[:, 1] * r[:, 2],
        ]
    )
    values = volume * np.where(inside, integrands, 0.0)
    bound = 5 * values.std(axis=1) / np.sqrt(count)  # five standard errors
    inertia = hull.inertia
    expected = [
        hull.mass,
        0,
        0,
        0,
        *np.diag(inertia),
        -inertia[0, 1],
        -inertia[0, 2],
        -inertia[1, 2],
    ]
    assert np.all(np.abs(values.mean(axis=1) - expected) < bound)
    assert hull.mass == pytest.approx(ConvexHull(points).volume, rel=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_turning_and_shifting_commutes_with_integrating(seed):
    rng = np.random.default_rng(seed)
    points, turn, shift = (
        rng.normal(size=(9, 3)),
        Rotation.random(random_state=rng).as_matrix(),
        rng.normal(size=3),
    )
    assert_same(
        hull_mass_properties(points @ turn.T + shift, density=2.0),
        hull_mass_properties(points, density=2.0).moved(turn, shift),
    )


@pytest.mark.parametrize("seed", SEEDS)
def test_the_parts_of_a_box_make_the_box(seed):
    rng = np.random.default_rng(seed)
    e, turn, center = (
        rng.uniform(0.2, 2, 3),
        Rotation.random(random_state=rng).as_matrix(),
        rng.normal(size=3),
    )
    cut = rng.uniform(-0.8, 0.8) * e[0]
    parts = []
    for low, high in ((-e[0], cut), (cut, e[0])):
        middle, half = (
            np.array([(low + high) / 2, 0, 0]),
            np.array([(high - low) / 2, e[1], e[2]]),
        )
        parts.append(
            box_mass_properties(turn @ middle + center, turn, half, density=4.0)
        )
    assert_same(
        combined_mass_properties(parts),
        box_mass_properties(center, turn, e, density=4.0),
    )


def test_a_dumbbell_by_hand():
    # Two balls of 2 kg at +-3 m: along their line 2 * 2/5 m r^2, across it 2 m d^2 more.
    balls = sphere_mass_properties(
        [[-3.0, 0, 0], [3.0, 0, 0]], 0.5, density=1.0
    ).with_mass(2.0)
    both = combined_mass_properties(
        [
            MassProperties(balls.mass[i], balls.centre[i], balls.inertia[i])
            for i in range(2)
        ]
    )
    assert both.mass == pytest.approx(4) and np.allclose(both.centre, 0)
    assert np.allclose(both.inertia, np.diag([0.4, 36.4, 36.4]))
    assert np.allclose(
        both.inertia_about([0, 0, 5.0]), np.diag([0.4 + 100, 36.4 + 100, 36.4])
    )


@pytest.mark.parametrize("seed", SEEDS)
def test_batches_are_loops(seed):
    rng = np.random.default_rng(seed)
    center, e, r = (
        rng.normal(size=(4, 1, 3)),
        rng.uniform(0.1, 1, (5, 3)),
        rng.uniform(0.1, 1, (4, 1)),
    )
    turn, rho = (
        Rotation.random(5, random_state=rng).as_matrix(),
        rng.uniform(1, 2, (4, 5)),
    )
    end = rng.normal(size=(5, 3))
    box = box_mass_properties(center, turn, e, density=rho)
    sphere = sphere_mass_properties(center, r, density=rho)
    capsule = capsule_mass_properties(center, end, r, density=rho)
    points = rng.normal(size=(4, 5, 8, 3))
    triangles = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    flip = np.linalg.det(points[..., 1:4, :] - points[..., :1, :]) < 0
    points[..., 1:3, :] = np.where(
        flip[..., None, None], points[..., 2:0:-1, :], points[..., 1:3, :]
    )
    hull = hull_mass_properties(points, density=rho, triangles=triangles)
    for i in range(4):
        for j in range(5):
            singles = (
                (
                    box,
                    box_mass_properties(center[i, 0], turn[j], e[j], density=rho[i, j]),
                ),
                (
                    sphere,
                    sphere_mass_properties(center[i, 0], r[i, 0], density=rho[i, j]),
                ),
                (
                    capsule,
                    capsule_mass_properties(
                        center[i, 0], end[j], r[i, 0], density=rho[i, j]
                    ),
                ),
                (hull, hull_mass_properties(points[i, j, :4], density=rho[i, j])),
            )
            for batch, single in singles:
                part = MassProperties(
                    batch.mass[i, j], batch.centre[i, j], batch.inertia[i, j]
                )
                assert_same(part, single, 1e-10)


@pytest.mark.parametrize("seed", SEEDS)
def test_principal_axes(seed):
    rng = np.random.default_rng(seed)
    made = rng.uniform(1, 2, (6, 3))
    turn = Rotation.random(6, random_state=rng).as_matrix()
    inertia = (turn * made[:, None, :]) @ np.swapaxes(turn, 1, 2)
    moments, axes = principal_axes(0.5 * (inertia + np.swapaxes(inertia, 1, 2)))
    assert np.allclose(moments, np.sort(made, axis=1), rtol=1e-13)
    assert np.allclose(
        (axes * moments[:, None, :]) @ np.swapaxes(axes, 1, 2), inertia, atol=1e-13
    )
    assert np.allclose(np.linalg.det(axes), 1)


def test_a_given_surface_need_not_be_convex():
    # A box with a pyramid cut into its top: the box less the pyramid.
    corners = box_corners([1.0, 1.0, 1.0])
    faces = [t for t in _box_triangles(corners) if not np.all(corners[t, 2] > 0)]
    top = [1, 5, 7, 3]
    faces += [[a, b, 8] for a, b in zip(top, top[1:] + top[:1], strict=True)]
    dented = hull_mass_properties(
        np.vstack([corners, [0, 0, 0.5]]), density=1.0, triangles=faces
    )
    assert dented.mass == pytest.approx(8 - 4 * 0.5 / 3)


def _box_triangles(corners):
    hull, triangles = ConvexHull(corners), []
    for simplex, normal in zip(hull.simplices, hull.equations[:, :3], strict=True):
        a, b, c = corners[simplex]
        triangles.append(
            list(simplex if np.cross(b - a, c - a) @ normal > 0 else simplex[::-1])
        )
    return triangles


def test_inputs_are_not_written_and_results_cannot_be():
    points = np.random.default_rng(0).normal(size=(9, 3))
    before = points.copy()
    hull = hull_mass_properties(points, density=1.0)
    assert np.array_equal(points, before)
    with pytest.raises(ValueError, match="read-only"):
        hull.inertia[0, 0] = 1


CUBE = box_corners([1.0, 1.0, 1.0])


def solid(points, triangles=None):
    return hull_mass_properties(points, density=1, triangles=triangles)


CUBE_FACES = _box_triangles(CUBE)
REFUSED = [
    (lambda: sphere_mass_properties([0, 0, 0], -1, density=1), "radius: expected positive numbers; got -1.0"),
    (lambda: sphere_mass_properties([0, 0, 0], 1, density=0), "density: expected positive numbers; got 0.0"),
    (lambda: sphere_mass_properties([0, 0], 1, density=1), "center: expected vectors of shape (..., 3)"),
    (lambda: box_mass_properties([0, 0, 0], np.ones((3, 3)), [1, 1, 1], density=1), "rotation: expected rotation"),
    (lambda: box_mass_properties([0, 0, 0], np.eye(3), [1, 0, 1], density=1), "half_extents: expected positive"),
    (lambda: capsule_mass_properties([0, 0, np.nan], [0, 0, 1], 1, density=1), "start: expected finite vectors"),
    (lambda: solid(CUBE[:3]), "vertices: expected at least 4 points"),
    (lambda: solid(CUBE * [1, 1, 0]), "vertices: expected points that span a volume; got flat"),
    (lambda: solid(CUBE * [1, 1, 1e-14] + 1), "vertices: expected points that span a volume"),
    (lambda: solid(np.zeros((8, 3))), "vertices: expected points that span a volume; got flat"),
    (lambda: solid(CUBE, CUBE_FACES[1:]), "triangles: expected a closed surface"),
    (lambda: solid(CUBE, [t[::-1] for t in CUBE_FACES]), "triangles: expected counterclockwise rows"),
    (lambda: solid(CUBE, [[0, 1, 8]]), "triangles: expected whole numbers from 0 to 7; got 8"),
    (lambda: solid(np.stack([CUBE, CUBE])), "vertices: expected shape (k, 3) where no triangles are given"),
    (lambda: combined_mass_properties([]), "parts: expected at least one MassProperties; got none"),
    (lambda: combined_mass_properties([1.0]), "parts[0]: expected MassProperties; got float"),
    (lambda: principal_axes(np.diag([1.0, -1, 1])), "inertia: expected symmetric positive definite"),
]  # fmt: skip


@pytest.mark.parametrize("call,message", REFUSED, ids=[m[:40] for _, m in REFUSED])
def test_bad_input_is_refused_by_name(call, message):
    with pytest.raises(ValueError, match=re.escape(message)):
        call()


@pytest.mark.parametrize("thin", [1e-3, 1e-7, 1e-10])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_every_moment_of_a_needle_is_exact(thin, axis):
    """Along an axis: box e = (1, a, a) m/3 (2 a^2, 1 + a^2, 1 + a^2), in rational numbers; the hull of its corners
    is the same; a capsule by its formula."""
    e = np.full(3, thin)
    e[axis] = 1.0
    a = Fraction(thin)
    mass = 8 * a * a
    right = [float(mass / 3 * m) for m in (2 * a * a, 1 + a * a, 1 + a * a)]
    box = box_mass_properties([0, 0, 0], np.eye(3), e, density=1)
    corners = np.array(list(itertools.product([-1, 1], repeat=3))) * e
    hull = hull_mass_properties(corners, density=1)
    for solid in (box, hull):
        moments = principal_axes(solid.inertia)[0]
        np.testing.assert_allclose(moments, right, rtol=1e-13, atol=0)
    end = np.zeros(3)
    end[axis] = 1.0
    capsule = capsule_mass_properties(-end, end, thin, density=1)
    m_c, m_s = 2 * np.pi * thin**2, 4 / 3 * np.pi * thin**3
    along = m_c * thin**2 / 2 + 0.4 * m_s * thin**2
    assert principal_axes(capsule.inertia)[0][0] == pytest.approx(along, rel=1e-14)
    assert capsule.inertia_about(end)[axis, axis] == pytest.approx(along, rel=1e-14)


TURNED = np.array([[0.6, -0.8, 0], [0.8, 0.6, 0], [0, 0, 1.0]])
NEEDLE = box_mass_properties([0, 0, 0], np.eye(3), [1, 1e-9, 1e-9], density=1)


@pytest.mark.parametrize(
    "name,call",
    [
        ("radius", lambda: sphere_mass_properties([0, 0, 0], 1e-120, density=1)),
        ("radius", lambda: sphere_mass_properties([0, 0, 0], 1e120, density=1)),
        ("density", lambda: sphere_mass_properties([0, 0, 0], 10, density=1e308)),
        ("half_extents", lambda: box_mass_properties([0, 0, 0], TURNED, [1, 1e-9, 1e-9], density=1)),
        ("radius", lambda: capsule_mass_properties([0, 0, 0], [0.6, 0.8, 0], 1e-9, density=1)),
        ("vertices", lambda: solid(1e-120 * CUBE)),
        ("vertices", lambda: solid(1e120 * CUBE)),
        ("rotation", lambda: NEEDLE.moved(TURNED, [0, 0, 0])),
    ],
)  # fmt: skip
def test_what_float64_cannot_hold_is_refused_by_the_name_of_the_argument(name, call):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(ValueError, match=f"^{name}: expected a solid whose"):
            call()


@pytest.mark.peers
@pytest.mark.parametrize("seed", SEEDS)
def test_trimesh_agrees(seed):
    trimesh = pytest.importorskip("trimesh")
    rng = np.random.default_rng(seed)
    for points in (
        rng.normal(size=(30, 3)),
        trimesh.creation.capsule(1.0, 0.3).vertices + rng.normal(size=3),
    ):
        mesh = trimesh.convex.convex_hull(points)
        mesh.density = 2.0
        hull = hull_mass_properties(points, density=2.0)
        assert hull.mass == pytest.approx(mesh.mass, rel=1e-9)
        assert np.allclose(hull.centre, mesh.center_mass, atol=1e-9)
        assert np.allclose(
            hull.inertia, mesh.moment_inertia, rtol=1e-8, atol=1e-8 * hull.inertia.max()
        )
    box = trimesh.creation.box((1, 2, 3))
    ours = box_mass_properties([0, 0, 0], np.eye(3), [0.5, 1, 1.5], density=1.0)
    assert np.allclose(ours.inertia, box.moment_inertia)
    given = hull_mass_properties(box.vertices, density=1.0, triangles=box.faces)
    assert np.allclose(given.inertia, box.moment_inertia)
