"""The flat arrays of rounded polytopes: what bounds what, for every kind, flat or not."""

import numpy as np
import pytest
from campaigns import drawn_of
from shapes.drawn_shapes import CONVEX, drawn, rotations

from course.shapes import (
    AABB,
    KDOP,
    OBB,
    Capsule,
    Compound,
    ConvexHull,
    HalfSpace,
    Polytopes,
    Sphere,
    k_dop,
    polytopes,
)

pytestmark = pytest.mark.slow  # with its like, left out of --quick

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)


def counts(solids):
    """Vertices, faces and edges of each solid."""
    starts = solids.vertex_start, solids.face_start, solids.edge_start
    return list(zip(*(np.diff(start).tolist() for start in starts), strict=True))


def loops(solids):
    cuts = solids.loop_start[1:-1]
    return np.split(solids.loop, cuts) if solids.loop_start.size > 1 else []


def require_sound(solids, rounding=1e-12):
    """Everything that the layout promises, looked at solid by solid."""
    faces = loops(solids)
    assert solids.loop_start[-1] == solids.loop.size
    assert solids.vertex_start[-1] == len(solids.vertices)
    assert solids.face_start[-1] == len(solids.normals) == len(faces)
    assert solids.edge_start[-1] == len(solids.edges) == len(solids.edge_faces)
    for i in range(len(solids)):
        own = slice(*solids.vertex_start[i : i + 2])
        points = solids.vertices[own]
        runs = {}
        for f in range(*solids.face_start[i : i + 2]):
            n, loop = solids.normals[f], faces[f]
            assert loop.min() >= own.start and loop.max() < own.stop
            assert abs(n @ n - 1) < 1e-12
            assert (points @ n <= solids.offsets[f] + rounding).all()
            assert (solids.vertices[loop] @ n >= solids.offsets[f] - rounding).all()
            corner = solids.vertices[loop]
            area = sum(np.cross(a - corner[0], b - corner[0])
                       for a, b in zip(corner[1:], corner[2:], strict=False))  # fmt: skip
            # Where a face is but a sliver, only the hull says which way it faces.
            if (
                rounding < 1e-10
                and np.linalg.norm(area) > 1e-3 * np.square(corner - corner[0]).max()
            ):
                assert area @ n > 0.999 * np.linalg.norm(area)
            for a, b in zip(loop, np.roll(loop, -1), strict=True):
                assert (a, b) not in runs
                runs[int(a), int(b)] = f
        edges = range(*solids.edge_start[i : i + 2])
        if runs:
            seen = set()
            for e in edges:
                a, b = map(int, solids.edges[e])
                assert runs[a, b] == solids.edge_faces[e, 0]
                assert runs[b, a] == solids.edge_faces[e, 1]
                seen |= {(a, b), (b, a)}
            assert seen == set(runs)
            assert len(points) - len(edges) + len(range(*solids.face_start[i : i + 2])) == 2  # fmt: skip
        else:
            assert len(points) == len(edges) + 1 <= 2
            assert (solids.edge_faces[edges] == -1).all()


@pytest.mark.parametrize("kind", CONVEX)
def test_layout_of_drawn_shapes_standing_and_moved(kind):
    rng = np.random.default_rng(1)
    shapes = drawn(kind, rng, 3, 2)
    moved = shapes.moved(rotations(rng, 3, 2), rng.normal(size=(3, 2, 3)))
    for some in (shapes, moved, shapes[1], moved[:, :1], shapes[0, 0]):
        solids = polytopes(some)
        assert len(solids) == some.count
        require_sound(solids)
    order = [polytopes(shapes[i, j]) for i in range(3) for j in range(2)]
    joined, whole = Polytopes.concatenate(order), polytopes(shapes)
    for name in vars(whole):
        np.testing.assert_array_equal(getattr(joined, name), getattr(whole, name), name)


def test_spheres_are_points_and_capsules_edges():
    sphere = polytopes(Sphere([[1, 2, 3], [4, 5, 6]], [0.5, 0]))
    assert counts(sphere) == [(1, 0, 0)] * 2
    assert sphere.radius.tolist() == [0.5, 0]
    capsule = polytopes(Capsule(np.zeros((2, 3)), [[1, 0, 0], [0, 0, 0]], 0.25))
    assert counts(capsule) == [(2, 0, 1), (1, 0, 0)]
    assert capsule.vertices.tolist() == [[0, 0, 0], [1, 0, 0], [0, 0, 0]]


def test_a_box_flat_in_some_axes_is_a_rectangle_a_segment_or_a_point():
    extents = [[(solid >> axis) & 1 for axis in range(3)] for solid in range(8)]
    wanted = {3: (8, 6, 12), 2: (4, 2, 4), 1: (2, 0, 1), 0: (1, 0, 0)}
    wanted = [wanted[sum(row)] for row in extents]
    aabb = AABB(np.zeros((8, 3)), np.array(extents, float))
    for shapes in (aabb, OBB(0.0 * aabb.lower, np.eye(3), extents)):
        solids = polytopes(shapes)
        assert counts(solids) == wanted
        require_sound(solids)
    turned = polytopes(aabb.moved(rotations(np.random.default_rng(2), 8), [1.0, 2, 3]))
    assert counts(turned) == wanted
    require_sound(turned)


def test_coplanar_triangles_are_one_face_and_points_inside_leave_no_trace():
    more = np.concatenate([
        CUBE, CUBE, [[0.5, 0.5, 0.5]],      # twice, and inside
        [[0.5, 0, 0], [1, 0.25, 1]],        # on edges
        [[0.5, 0.25, 0], [1, 0.3, 0.6]],    # on faces
    ])  # fmt: skip
    for points in (CUBE, more, more @ rotations(np.random.default_rng(3), 1)[0] + 7):
        solids = polytopes(ConvexHull(points))
        assert counts(solids) == [(8, 6, 12)]
        require_sound(solids)


@pytest.mark.parametrize("away", [0.0, 1e3, 1e8])
@pytest.mark.parametrize(
    "points, wanted",
    [
        ([[0, 0, 0]] * 3, (1, 0, 0)),
        ([[0, 0, 0], [1, 2, 3], [0.5, 1, 1.5], [0.1, 0.2, 0.3]], (2, 0, 1)),
        ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], (3, 2, 3)),
        ([*CUBE[[0, 1, 2, 3]], [0, 0.5, 0.5], [0, 0.5, 0]], (4, 2, 4)),
        (CUBE[[0, 1, 2, 4]], (4, 4, 6)),
        ([[0, 0, 1], [0, 0, -1], *[[np.cos(a), np.sin(a), 0] for a in range(6)]], (8, 12, 18)),
    ],
    ids=["point", "segment", "triangle", "square", "tetrahedron", "bipyramid"],
)  # fmt: skip
def test_hulls_of_any_dimension(points, wanted, away):
    turn = rotations(np.random.default_rng(4), 1)[0]
    hull = ConvexHull(np.array(points, float) @ turn.T + away)
    solids = polytopes(hull)
    assert counts(solids) == [wanted]
    require_sound(solids, rounding=1e-12 + 64 * np.finfo(float).eps * away)


def test_a_thin_plate_is_a_solid_and_a_thinner_one_a_polygon():
    for thickness, wanted in ((1e-8, (8, 6, 12)), (1e-12, (4, 2, 4))):
        points = CUBE * [1, 2, thickness]
        assert counts(polytopes(ConvexHull(points))) == [wanted]


@pytest.mark.parametrize("size", [1e-150, 1e-9, 1e9, 1e150])
def test_size_changes_nothing(size):
    points = np.random.default_rng(5).normal(size=(20, 3))
    one, other = polytopes(ConvexHull(points)), polytopes(ConvexHull(size * points))
    assert counts(one) == counts(other)
    np.testing.assert_allclose(other.normals, one.normals, atol=1e-13)


def test_the_corners_of_a_k_dop_are_those_of_its_hull():
    """An octahedron cut by a cube: 14 faces, as a truncated octahedron has."""
    diagonal = np.array([[1, 1, 1], [1, 1, -1], [1, -1, 1], [1, -1, -1]]) / 3**0.5
    solids = polytopes(KDOP(np.concatenate([np.eye(3), diagonal]), -np.ones(7), np.ones(7)))  # fmt: skip
    assert counts(solids) == [(24, 14, 36)]
    require_sound(solids)


def test_a_slack_plane_of_a_k_dop_is_no_face():
    d = np.concatenate([np.eye(3), [[0.6, 0.8, 0]]])
    for reach, wanted in ((1.5, (8, 6, 12)), (1.4, (8, 6, 12)), (1.3, (12, 8, 18))):
        upper = np.array([1, 1, 1, reach])
        assert counts(polytopes(KDOP(d, -upper, upper))) == [wanted]


def test_flat_k_dops():
    upper = np.array([[1, 2, 0], [0, 0, 3], [0, 0, 0]], float)
    solids = polytopes(KDOP(np.eye(3), -upper, upper).moved(np.eye(3), [3, 4, 5]))
    assert counts(solids) == [(4, 2, 4), (2, 0, 1), (1, 0, 0)]
    require_sound(solids)


def test_slabs_without_a_common_point_are_refused():
    d = np.concatenate([np.eye(3), [[1 / 3**0.5] * 3]])
    kdop = KDOP(d, [0, 0, 0, 5], [1, 1, 1, 6])
    with pytest.raises(ValueError, match="slabs that have a point in common"):
        polytopes(kdop)


@pytest.mark.parametrize(
    "shape, said",
    [
        (Compound((Sphere([0, 0, 0], 1),)), "a compound"),
        (HalfSpace([0, 0, 1], 0), "a half_space"),
        (np.zeros(3), "ndarray"),
    ],
)
def test_other_kinds_are_refused(shape, said):
    with pytest.raises(ValueError, match=f"shape: expected a convex .*{said}"):
        polytopes(shape)


def test_topology_goes_along():
    """What was found once is not looked for again when hulls move, are picked or joined."""
    rng = np.random.default_rng(6)
    hulls, more = drawn("convex_hull", rng, 4), drawn("convex_hull", rng, 2)
    polytopes(hulls)
    moved = hulls.moved(rotations(rng, 4), np.ones(3))
    joined = ConvexHull.concatenate([moved[::-1], more])
    assert [f is g for f, g in zip(joined.forms[:4], hulls.forms[::-1], strict=True)]
    assert "topology" in vars(joined.forms[0]) and "topology" not in vars(more.forms[0])
    require_sound(polytopes(joined))


# Campaigns: sets of points that break hulls, and k-DOPs around such sets.


def hard_points(rng):
    """Lattices, clusters, needles, plates, prisms, points within others' hulls."""
    kind, m = rng.integers(7), int(rng.integers(1, 60))
    lattice = rng.integers(0, 3, size=(m, 3)).astype(float)
    normal = rng.normal(size=(m, 3))
    if kind == 0:
        return lattice
    if kind == 1:
        return lattice * rng.choice([1, 0.1, 1e-3, 1e-6, 1e-9, 1e-11], 3)
    if kind == 2:
        return normal / np.linalg.norm(normal, axis=1, keepdims=True)
    if kind == 3:
        return normal * 10.0 ** rng.uniform(-13, 0, 3)
    if kind == 4:
        angle = np.arange(m) * 2 * np.pi / m
        ring = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
        return np.concatenate([ring, ring + [0, 0, 10.0 ** rng.uniform(-13, 1)]])
    if kind == 5:
        near = normal[rng.integers(0, m, 30)]
        noise = rng.normal(size=(30, 3)) * 10.0 ** rng.uniform(-17, -5)
        return np.concatenate([normal, near + noise])
    return np.concatenate([lattice, rng.dirichlet(np.ones(m), 20) @ lattice])


def slack_of(points):
    """1e-9 of the size, and 64 eps of the largest coordinate."""
    eps = np.finfo(float).eps
    return 1e-9 * np.ptp(points, axis=0).max() + 64 * eps * np.abs(points).max()


@pytest.mark.parametrize(
    "count",
    [25, pytest.param(drawn_of(3000, 300), marks=pytest.mark.long)],
    ids=["few", "many"],
)
def test_hulls_of_hard_points(count):
    """All points below all faces, all supports at a corner, the layout whole."""
    rng = np.random.default_rng(7)
    for _ in range(count):
        away = rng.choice([0, 1, 1e4, 1e8])
        points = hard_points(rng) @ rotations(rng, 1)[0].T + away
        solids, slack = polytopes(ConvexHull(points)), slack_of(points)
        assert (points @ solids.normals.T <= solids.offsets + slack).all()
        u = rng.normal(size=(30, 3))
        u /= np.linalg.norm(u, axis=1, keepdims=True)
        most = ((points - away) @ u.T).max(axis=0)
        kept = ((solids.vertices - away) @ u.T).max(axis=0)
        np.testing.assert_allclose(kept, most, atol=slack, rtol=0)
        require_sound(solids, slack)


@pytest.mark.parametrize(
    "count",
    [10, pytest.param(drawn_of(1500, 150), marks=pytest.mark.long)],
    ids=["few", "many"],
)
def test_k_dops_around_hard_points(count):
    """All corners within all slabs, each slab touched, the layout whole."""
    rng = np.random.default_rng(8)
    for _ in range(count):
        points = hard_points(rng) + rng.choice([0, 1, 1e4, 1e8])
        kdop = k_dop(points, int(rng.choice([14, 18, 26])))
        solids, slack = polytopes(kdop), slack_of(points)
        along = solids.vertices @ kdop.directions.T
        np.testing.assert_allclose(along.max(axis=0), kdop.upper, atol=slack, rtol=0)
        np.testing.assert_allclose(along.min(axis=0), kdop.lower, atol=slack, rtol=0)
        require_sound(solids, 4 * slack)


@pytest.mark.parametrize("seed", range(5))
def test_volume_of_a_hull_is_qhulls(seed):
    from scipy.spatial import ConvexHull as Qhull

    points = np.random.default_rng(seed).normal(size=(40, 3)) * [1, 3, 0.1]
    assert ConvexHull(points).volume() == pytest.approx(Qhull(points).volume, rel=1e-12)
