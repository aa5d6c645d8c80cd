"""What proves a gap of two rounded polytopes right, without the algorithms that found it.

Apart, two bounds do: the witness points are in the solids, so that these are no further
apart, and along the normal no vertex of A is nearer to B than the gap says. Overlapping,
the separation along every face normal and every product of two edges does (C. Ericson,
*Real-Time Collision Detection*, section 5.2.1), all vertices asked, none left out.
"""

import numpy as np
from scipy.spatial.transform import Rotation

from course.shapes import AABB, OBB, Capsule, ConvexHull, Sphere

EPS = np.finfo(float).eps


def core(solids, i):
    """Vertices, face normals and edge vectors of solid i."""
    vertices = solids.vertices[solids.vertex_start[i] : solids.vertex_start[i + 1]]
    normals = solids.normals[solids.face_start[i] : solids.face_start[i + 1]]
    edges = solids.edges[solids.edge_start[i] : solids.edge_start[i + 1]]
    return vertices, normals, solids.vertices[edges[:, 1]] - solids.vertices[edges[:, 0]]  # fmt: skip


def separations(x, y, axes):
    """min N.x - max N.y for each N of axes, (n, 3)."""
    return (x @ axes.T).min(axis=0) - (y @ axes.T).max(axis=0)


def all_axes(a, b):
    """Face normals and products of edges of two cores, both ways round, unit vectors out of B toward A."""
    (_, normals_a, edges_a), (_, normals_b, edges_b) = a, b
    axes = [normals_b, -normals_a]
    if len(edges_a) and len(edges_b):
        unit = [e / np.linalg.norm(e, axis=1)[:, None] for e in (edges_a, edges_b)]
        product = np.cross(unit[0][:, None], unit[1]).reshape(-1, 3)
        sine = np.linalg.norm(product, axis=1)
        product = product[sine > 1e-14] / sine[sine > 1e-14, None]
        axes += [product, -product]
    return np.concatenate(axes)


def errors(found, a, b, i, j):
    """By how much found contradicts itself or the truth, in what is allowed: (p,), at most 1 if it is right.

    Allowed is 1e-12 of the pair's size and 32 eps of its largest coordinate.
    """
    return np.array([_error(found, a, b, i, j, p) for p in range(len(i))])


def _error(found, a, b, i, j, p):
    solid_a, solid_b = core(a, i[p]), core(b, j[p])
    origin, r_a, r_b = solid_a[0][0], a.radius[i[p]], b.radius[j[p]]
    x, y = solid_a[0] - origin, solid_b[0] - origin
    normal, apart = found.normal[p], found.gap[p] + r_a + r_b
    in_a = found.point_a[p] + r_a * normal - origin
    in_b = found.point_b[p] - r_b * normal - origin
    size = max(np.abs(x).max(), np.abs(y).max()) + r_a + r_b
    allowed = 1e-12 * size + 32 * EPS * max(np.abs(solid_a[0]).max(), np.abs(solid_b[0]).max(), size)  # fmt: skip
    wrong = [
        abs(np.linalg.norm(normal) - 1) / (8 * EPS) * allowed,
        abs((found.point_a[p] - found.point_b[p]) @ normal - found.gap[p]),
        abs(separations(x, y, normal[None])[0] - apart),
        *(outside(v, n, point) for (v, n), point in zip(((x, solid_a[1]), (y, solid_b[1])), (in_a, in_b), strict=True)),
        abs(in_a @ normal - (x @ normal).min()),
        abs(in_b @ normal - (y @ normal).max()),
    ]  # fmt: skip
    if apart > allowed:
        wrong.append(abs(np.linalg.norm(in_a - in_b) - apart))
    else:
        axes = all_axes(solid_a, solid_b)
        wrong.append(separations(x, y, axes).max(initial=-np.inf) - apart)
    worst = max(wrong)
    return np.inf if np.isnan(wrong).any() else worst / allowed


def outside(vertices, normals, point):
    """How far a point is outside a core, by its faces and bounds."""
    beyond = max((vertices.min(axis=0) - point).max(), (point - vertices.max(axis=0)).max())  # fmt: skip
    if len(normals):
        height = point @ normals.T - (vertices @ normals.T).max(axis=0)
        beyond = max(beyond, height.max())
    return beyond


def drawn(kind, count, rng):
    """A batch of shapes of a kind that is hard in its own way; those on a lattice touch and are parallel often."""

    def lattice(points, cells=3):
        return rng.integers(0, cells, (count, points, 3)).astype(float)

    turned = Rotation.from_quat(rng.normal(size=(count, 4))).as_matrix()
    places = rng.uniform(-1, 1, (count, 1, 3))
    if kind == "boxes":
        return OBB(1.5 * places[:, 0], turned, rng.uniform(0.1, 1, (count, 3)))
    if kind == "lattice boxes":
        low = lattice(1)[:, 0]
        return AABB(low, low + rng.integers(0, 3, (count, 3)))
    if kind == "tilted boxes":
        turn = 10.0 ** rng.uniform(-17, -5, (count, 1)) * rng.normal(size=(count, 3))
        off = 1e-9 * rng.integers(0, 2, (count, 1)) * rng.normal(size=(count, 3))
        axes = Rotation.from_rotvec(turn).as_matrix()
        return OBB(lattice(1)[:, 0] + off, axes, rng.integers(1, 3, (count, 3)) / 2)
    if kind == "hulls":
        points = rng.normal(size=(count, rng.integers(4, 12), 3))
        return ConvexHull(points + 2 * places)
    if kind == "lattice hulls":
        return ConvexHull(lattice(rng.integers(4, 10)))
    if kind == "flat hulls":
        return ConvexHull((rng.normal(size=(count, 6, 3)) * [1, 1, 0]) @ turned + places)  # fmt: skip
    if kind == "lattice polygons":
        return ConvexHull(lattice(5) * [1, 1, 0])
    if kind == "needles":
        thin = 10.0 ** rng.integers(-9, 0, (2,))
        points = rng.normal(size=(count, 6, 3)) * [1, *thin]
        return ConvexHull(points @ turned + 0.3 * places)
    if kind == "lattice segments":
        return Capsule(lattice(1)[:, 0], lattice(1)[:, 0], 0.3 * rng.integers(0, 2, count))  # fmt: skip
    if kind == "segments":
        return Capsule(*rng.normal(size=(2, count, 3)), rng.uniform(0, 0.3, count))
    if kind == "points":
        return Sphere(lattice(1)[:, 0], 0.3 * rng.integers(0, 2, count))
    raise KeyError(kind)


KINDS = ("boxes", "lattice boxes", "tilted boxes", "hulls", "lattice hulls", "flat hulls",
         "lattice polygons", "needles", "lattice segments", "segments", "points")  # fmt: skip
