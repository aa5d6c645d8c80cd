"""Lesson 05, Separating axis: two convex shapes are apart exactly where some shadow is.

The shadow of a shape on an axis is the interval from its lowest to its highest place
along it. Shapes are closed: touching counts as overlapping. A polygon is its vertices
(..., n, 2) [m], counter-clockwise; a box is its centre (..., 3) [m], its rotation
(..., 3, 3), whose columns are the box's axes, and its half extents (..., 3) [m].
"""

import numpy as np


def project(vertices, axes):
    """Shadows of a shape on k axes: the lowest and the highest place along each.

    lower = min_i v_i.n,  upper = max_i v_i.n    (syllabus row 10)

    vertices (..., m, d) [m], axes n (..., k, d), unit vectors; returns two (..., k) [m].
    Source: Ericson, "Real-Time Collision Detection", section 5.2.1.
    """
    along = axes @ np.swapaxes(vertices, -1, -2)
    return np.min(along, axis=-1), np.max(along, axis=-1)


def shadow_gap(lower_a, upper_a, lower_b, upper_b):
    """Gap between two intervals; below 0 the least shift that parts them, negative.

    gap = max(lower_B - upper_A, lower_A - upper_B)    (syllabus rows 5 and 10)

    ends (...) [m], lower <= upper; returns (...) [m], > 0 apart, 0 touching.
    Source: Ericson, "Real-Time Collision Detection", section 4.2.1.
    """
    return np.maximum(lower_b - upper_a, lower_a - upper_b)


def edge_normals(vertices):
    """Outward unit normals of a polygon's edges, from vertex i to vertex i + 1.

    n_i = (y, -x)/|(x, y)|,  (x, y) = v_{i+1} - v_i    (syllabus rows 6 and 10)

    vertices (..., n, 2) [m], counter-clockwise; returns (..., n, 2).
    Source: a quarter turn to the right; counter-clockwise means: inside on the left.
    """
    edges = np.roll(vertices, -1, axis=-2) - vertices
    normals = np.stack([edges[..., 1], -edges[..., 0]], axis=-1)
    return normals / np.linalg.norm(normals, axis=-1, keepdims=True)


def polygons_overlap(vertices_a, vertices_b):
    """Whether two convex polygons overlap, by the normals of their edges.

    overlap <=> gap <= 0 on each of the n + m axes    (syllabus rows 6 and 10, misprint 1)

    vertices_a (..., n, 2), vertices_b (..., m, 2) [m], counter-clockwise; returns (...)
    of bool.
    Source: Ericson, "Real-Time Collision Detection", section 5.2.1.
    """
    axes = [edge_normals(vertices_a), edge_normals(vertices_b)]
    axes = np.concatenate(axes, axis=-2)
    shadow_a, shadow_b = project(vertices_a, axes), project(vertices_b, axes)
    return np.all(shadow_gap(*shadow_a, *shadow_b) <= 0, axis=-1)


def half_shadow(e_1, e_2, e_3, c_1, c_2, c_3):
    """Half the shadow of a box on a unit axis n, as an expression.

    r = e_1 |c_1| + e_2 |c_2| + e_3 |c_3|,  c_i = n.r_i    (syllabus rows 4 and 10)

    half extents e_i [m], cosines c_i between n and the box's axes r_i; returns [m].
    Source: Ericson, "Real-Time Collision Detection", section 4.4.1.
    """
    return e_1 * abs(c_1) + e_2 * abs(c_2) + e_3 * abs(c_3)


def box_axes(rotation_a, rotation_b):
    """The 15 axes on which two boxes have to be compared.

    3 face normals of A, 3 of B, 9 products a_i x b_j of their edges; the products are
    not of unit length, and 0 where edges are parallel    (syllabus rows 4 and 10)

    rotations (..., 3, 3) [1]; returns (..., 15, 3) [1].
    Source: Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996.
    """
    a, b = np.swapaxes(rotation_a, -1, -2), np.swapaxes(rotation_b, -1, -2)
    edges = np.cross(a[..., :, None, :], b[..., None, :, :])
    edges = edges.reshape(*edges.shape[:-3], 9, 3)
    return np.concatenate([a, b, edges], axis=-2)


def oriented_boxes_overlap(
    center_a, rotation_a, half_extents_a, center_b, rotation_b, half_extents_b
):
    """Whether two oriented boxes overlap, by the 15 axes.

    overlap <=> |n.(x_B - x_A)| <= r_A + r_B on each axis n, r = sum_i e_i |n.r_i|
    (syllabus rows 4 and 10)

    centres and half extents (..., 3) [m], rotations (..., 3, 3); returns (...) of bool.
    Source: Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996.
    """
    axes = box_axes(rotation_a, rotation_b)
    between = np.sum(axes * (center_b - center_a)[..., None, :], axis=-1)
    e_a, e_b = half_extents_a[..., None, :], half_extents_b[..., None, :]
    half_a = np.sum(np.abs(axes @ rotation_a) * e_a, axis=-1)
    half_b = np.sum(np.abs(axes @ rotation_b) * e_b, axis=-1)
    return np.all(np.abs(between) <= half_a + half_b, axis=-1)


def least_translation(vertices_a, vertices_b):
    """The shortest shift of A that parts two convex polygons; 0 where they are apart.

    on each axis n out by (upper_B - lower_A) n or by (lower_B - upper_A) n: the shortest
    of all, along +n or -n    (syllabus rows 6 and 10)

    vertices_a (..., n, 2), vertices_b (..., m, 2) [m], counter-clockwise; returns
    (..., 2) [m].
    Source: Ericson, "Real-Time Collision Detection", section 5.5.
    """
    axes = [edge_normals(vertices_a), edge_normals(vertices_b)]
    axes = np.concatenate(axes, axis=-2)
    lower_a, upper_a = project(vertices_a, axes)
    lower_b, upper_b = project(vertices_b, axes)
    ahead, back = upper_b - lower_a, lower_b - upper_a
    shift = np.where(ahead < -back, ahead, back)
    best = np.argmin(np.abs(shift), axis=-1)[..., None, None]
    least = np.take_along_axis(shift[..., None] * axes, best, axis=-2)[..., 0, :]
    apart = np.any((ahead < 0) | (back > 0), axis=-1, keepdims=True)
    return np.where(apart, 0.0, least)


def hulls_overlap(vertices_a, normals_a, edges_a, vertices_b, normals_b, edges_b):
    """Whether two convex polytopes overlap, by their faces and pairs of edges.

    overlap <=> gap <= 0 on f_A + f_B + e_A e_B axes    (syllabus rows 6 and 10)

    vertices (n, 3) [m], normals of the faces (f, 3), directions of the edges (e, 3), and
    as many of B as it has; returns a bool.
    Source: Ericson, "Real-Time Collision Detection", section 5.2.1.
    """
    products = np.cross(edges_a[:, None], edges_b[None]).reshape(-1, 3)
    axes = np.concatenate([normals_a, normals_b, products])
    shadow_a, shadow_b = project(vertices_a, axes), project(vertices_b, axes)
    return np.all(shadow_gap(*shadow_a, *shadow_b) <= 0)
