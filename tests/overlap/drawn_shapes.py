"""Shapes of every kind, drawn by seed, and what is true of a pair, found in another way."""

import numpy as np
from scipy.optimize import lsq_linear, nnls
from scipy.spatial.transform import Rotation

from course.shapes import (
    AABB,
    KDOP,
    OBB,
    Capsule,
    Compound,
    ConvexHull,
    HalfSpace,
    Sphere,
    polytopes,
)

#: Normals of the 14-DOP: the axes, and the diagonals of the cube.
SEVEN = np.array([(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1), (1, 1, -1), (1, -1, 1), (-1, 1, 1)])  # fmt: skip
SEVEN = SEVEN / np.linalg.norm(SEVEN, axis=1, keepdims=True)


def turns(rng, count):
    return Rotation.from_quat(rng.normal(size=(count, 4))).as_matrix()


def spheres(rng, count, spread=2.0):
    return Sphere(rng.normal(0, spread, (count, 3)), rng.uniform(0.1, 1, count))


def capsules(rng, count, spread=2.0):
    middle, half = rng.normal(0, spread, (count, 3)), rng.normal(0, 0.8, (count, 3))
    return Capsule(middle - half, middle + half, rng.uniform(0.1, 0.8, count))


def upright_boxes(rng, count, spread=2.0):
    middle, half = rng.normal(0, spread, (count, 3)), rng.uniform(0.2, 1.5, (count, 3))
    return AABB(middle - half, middle + half)


def boxes(rng, count, spread=2.0):
    middle, half = rng.normal(0, spread, (count, 3)), rng.uniform(0.2, 1.5, (count, 3))
    return OBB(middle, turns(rng, count), half)


def k_dops(rng, count, spread=2.0):
    """14-DOPs around drawn points, turned."""
    along = rng.normal(0, 0.8, (count, 12, 3)) @ SEVEN.T
    upright = KDOP(np.broadcast_to(SEVEN, (count, 7, 3)), along.min(1), along.max(1))
    return upright.moved(turns(rng, count), rng.normal(0, spread, (count, 3)))


def hulls(rng, count, spread=2.0):
    points = rng.normal(0, 0.9, (count, 12, 3))
    return ConvexHull(points + rng.normal(0, spread, (count, 1, 3)))


def half_spaces(rng, count, spread=2.0):
    normal = rng.normal(size=(count, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    return HalfSpace(normal, rng.normal(0, spread, count))


def compounds(rng, count, spread=2.0):
    """A sphere, a box and a capsule about one place."""
    shift = rng.normal(0, spread, (count, 3))
    parts = [draw(rng, count, 0.7) for draw in (spheres, boxes, capsules)]
    return Compound(tuple(part.moved(np.eye(3), shift) for part in parts))


DRAW = {
    "sphere": spheres,
    "capsule": capsules,
    "aabb": upright_boxes,
    "obb": boxes,
    "kdop": k_dops,
    "convex_hull": hulls,
    "half_space": half_spaces,
    "compound": compounds,
}


def core(shape):
    """Origin, directions and bounds of weights of one shape's core, and its radius:
    all of origin + sum of weights times directions; of hulls the weights add up to 1."""
    if isinstance(shape, Sphere):
        return shape.center, np.empty((3, 0)), np.empty((2, 0)), float(shape.radius)
    if isinstance(shape, Capsule):
        way = (shape.end - shape.start)[:, None]
        return shape.start, way, np.array([[0.0], [1.0]]), float(shape.radius)
    if isinstance(shape, AABB):
        return np.zeros(3), np.eye(3), np.stack([shape.lower, shape.upper]), 0.0
    e = shape.half_extents
    return shape.center, shape.rotation, np.stack([-e, e]), 0.0


def distance_by_least_squares(a, b):
    """The distance of the cores of one sphere, capsule or box and another, by a bounded least-squares solve."""
    (o_a, d_a, w_a, _), (o_b, d_b, w_b, _) = core(a), core(b)
    matrix, low, high = np.hstack([d_a, -d_b]), *np.hstack([w_a, w_b])
    if not matrix.shape[1]:
        return np.linalg.norm(o_a - o_b)
    high = np.maximum(high, low + 1e-15)
    # Of an edge and a point "bvls" has ended at the wrong end; an interior way does not.
    ways = [
        lsq_linear(matrix, o_b - o_a, (low, high), method=method, tol=1e-15)
        for method in ("bvls", "trf")
    ]
    return min(np.linalg.norm(matrix @ way.x - (o_b - o_a)) for way in ways)


def depth_inside(shape, point):
    """How far a point is inside the surface of each shape of a batch (negative: outside),
    by the shape's own definition; (...)."""
    if isinstance(shape, Sphere):
        return shape.radius - np.linalg.norm(point - shape.center, axis=-1)
    if isinstance(shape, Capsule):
        way, offset = shape.end - shape.start, point - shape.start
        square = np.sum(way**2, axis=-1)
        t = np.sum(offset * way, axis=-1) / np.where(square > 0, square, 1)
        nearest = np.clip(t, 0, 1)[..., None] * way
        return shape.radius - np.linalg.norm(offset - nearest, axis=-1)
    if isinstance(shape, AABB):
        return np.minimum(point - shape.lower, shape.upper - point).min(axis=-1)
    if isinstance(shape, OBB):
        own = np.einsum("...ji,...j", shape.rotation, point - shape.center)
        return (shape.half_extents - np.abs(own)).min(axis=-1)
    if isinstance(shape, KDOP):
        along = np.einsum("...ki,...i->...k", shape.directions, point)
        return np.minimum(along - shape.lower, shape.upper - along).min(axis=-1)
    if isinstance(shape, HalfSpace):
        return shape.offset - np.sum(shape.normal * point, axis=-1)
    if isinstance(shape, Compound):
        return np.max([depth_inside(p, point) for p in shape.parts], axis=0)
    return hull_depth(shape, point)


def hull_depth(hull, point):
    """The same of hulls, by the planes that Qhull finds (of a solid hull)."""
    from scipy.spatial import ConvexHull as Qhull

    points = hull.vertices.reshape(-1, *hull.vertices.shape[-2:])
    spots = np.broadcast_to(point, (*hull.batch, 3)).reshape(-1, 3)
    found = []
    for x, spot in zip(points, spots, strict=True):
        planes = Qhull(x).equations
        found.append(-np.max(planes[:, :3] @ spot + planes[:, 3]))
    return np.reshape(found, hull.batch)


def core_points(shape):
    """The corners of one shape's core, (n, 3), its face normals and edge directions, and its radius."""
    solid = polytopes(shape)
    edges = solid.vertices[solid.edges[:, 1]] - solid.vertices[solid.edges[:, 0]]
    return solid.vertices, solid.normals, edges, float(solid.radius[0])


def separation_by_all_axes(a, b):
    """The greatest separation of two cores along the normals of faces and the products of edges of both."""
    (x_a, n_a, e_a, _), (x_b, n_b, e_b, _) = core_points(a), core_points(b)
    crossed = np.cross(e_a[:, None], e_b[None]).reshape(-1, 3)
    length = np.linalg.norm(crossed, axis=1)
    sure = length > 1e-9 * max(1e-300, length.max(initial=0))
    axes = np.vstack([n_a, n_b, crossed[sure] / length[sure, None]])
    axes = np.vstack([axes, -axes])
    return ((x_a @ axes.T).min(axis=0) - (x_b @ axes.T).max(axis=0)).max(
        initial=-np.inf
    )


def distance_of_hulls(x_a, x_b):
    """The distance of two hulls of points: weights at or above 0 by non-negative least
    squares, then those that are above 0 once more, exactly."""
    sums = np.zeros((2, len(x_a) + len(x_b)))
    sums[0, : len(x_a)], sums[1, len(x_a) :] = 1, 1
    matrix = np.hstack([x_a.T, -x_b.T])
    weights, _ = nnls(np.vstack([matrix, 1e4 * sums]), np.r_[0, 0, 0, 1e4, 1e4])
    used = weights > 1e-9
    some, total = matrix[:, used], sums[:, used]
    kkt = np.block([[some.T @ some, total.T], [total, np.zeros((2, 2))]])
    found = np.linalg.lstsq(kkt, np.r_[np.zeros(used.sum()), 1, 1], rcond=None)[0]
    return np.linalg.norm(some @ found[: used.sum()])


def true_gap(a, b):
    """The gap of two shapes, of which none is a compound, in a slow way that shares nothing with the library's."""
    if isinstance(b, HalfSpace):
        corners, _, _, radius = core_points(a)
        return (corners @ b.normal).min() - float(b.offset) - radius
    if isinstance(a, HalfSpace):
        return true_gap(b, a)
    radii = core_points(a)[3] + core_points(b)[3]
    separation = separation_by_all_axes(a, b)
    if -np.inf < separation < 0:
        return separation - radii
    simple = (Sphere, Capsule, AABB, OBB)
    if isinstance(a, simple) and isinstance(b, simple):
        return distance_by_least_squares(a, b) - radii
    return distance_of_hulls(core_points(a)[0], core_points(b)[0]) - radii
