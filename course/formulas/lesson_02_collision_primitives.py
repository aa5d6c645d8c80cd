"""Lesson 02, Collision primitives: what a collider is to a program, and how tight it is.

A convex shape is known by its farthest point along any direction, its support; boxes and
k-DOPs around it are made of supports. A set of points is (..., n, 3) [m]; a turned box
is its rotation (..., 3, 3), whose columns are the box's axes, and its half extents
(..., 3) [m].
"""

import numpy as np


def bounding_box(points):
    """The least box along the axes around points: its lowest and its highest corner.

    lower_i = min over points of x_i,  upper_i = max of x_i    (syllabus row 4)

    points (..., n, 3) [m]; returns two (..., 3) [m].
    Source: Ericson, "Real-Time Collision Detection", section 4.2.
    """
    return np.min(points, axis=-2), np.max(points, axis=-2)


def box_growth(e_1, e_2, theta):
    """Volume of the upright box around a turned rod over the rod's own, as an expression.

    (e_1 |c| + e_2 |s|) (e_1 |s| + e_2 |c|) / (e_1 e_2),  c = cos(theta), s = sin(theta)
    (syllabus row 4)

    half extents [m] in the plane of the turn, by theta [rad]; returns [1].
    Source: rotated_box_extents, for a turn about the third axis of the box.
    """
    import sympy as sp

    c, s = abs(sp.cos(theta)), abs(sp.sin(theta))
    return (e_1 * c + e_2 * s) * (e_1 * s + e_2 * c) / (e_1 * e_2)


def support(points, direction):
    """The farthest of some points along a direction, the first of them where several are.

    s(n) = argmax over points x of x.n    (syllabus rows 3 and 6)

    points (..., m, 3) [m], direction n (..., 3), of any length but 0; returns (..., 3) [m].
    Source: Ericson, "Real-Time Collision Detection", section 3.3.
    """
    along = np.sum(points * direction[..., None, :], axis=-1)
    best = np.argmax(along, axis=-1)[..., None, None]
    return np.take_along_axis(points, best, axis=-2)[..., 0, :]


def rotated_box_extents(half_extents, rotation):
    """Half extents, along the world's axes, of the upright box around a turned box.

    sum_j |R_ij| e_j    (syllabus row 4)

    half_extents e (..., 3) [m], rotation R (..., 3, 3); returns (..., 3) [m].
    Source: Ericson, "Real-Time Collision Detection", section 4.2.6.
    """
    return np.sum(np.abs(rotation) * half_extents[..., None, :], axis=-1)


def k_dop(points, directions):
    """Intervals of a k-DOP around points: the lowest and highest place on each direction.

    lower_j = min over points x of x.n_j,  upper_j = max of x.n_j    (syllabus row 5)

    points (..., n, 3) [m], directions n_j (h, 3), unit vectors, h = k/2; returns two
    (..., h) [m].
    Source: Klosowski et al., IEEE TVCG 4, 1998.
    """
    along = points @ directions.T
    return np.min(along, axis=-2), np.max(along, axis=-2)


def compound_support(points, rotation, translation, direction):
    """The farthest point of a compound along a direction: of its m parts' own, the farthest.

    s(n) = the farthest of R_i s_i(R_i' n) + t_i    (syllabus row 7)

    points of each part in its own axes (..., m, k, 3) [m], where the parts stand,
    rotation R (..., m, 3, 3), translation t (..., m, 3) [m], direction n (..., 3);
    returns (..., 3) [m].
    Source: Ericson, "Real-Time Collision Detection", section 3.3.
    """
    inward = np.sum(rotation * direction[..., None, :, None], axis=-2)
    own = support(points, inward)
    placed = np.sum(rotation * own[..., None, :], axis=-1) + translation
    return support(placed, direction)


def bounding_sphere(points):
    """Ritter's sphere around points: centre and radius.

    from the most distant of the pairs that are extreme in x, y, z; then for each point x
    outside, at distance d > r: r' = (r + d)/2, c' = c + (1 - r'/d) (x - c)
    (syllabus row 3)

    points (n, 3) [m]; returns (3,) [m] and a number [m].
    Source: Ritter, "An efficient bounding sphere", Graphics Gems, 1990.
    """
    low, high = points[np.argmin(points, axis=0)], points[np.argmax(points, axis=0)]
    widest = np.argmax(np.linalg.norm(high - low, axis=-1))
    center = 0.5 * (low[widest] + high[widest])
    radius = 0.5 * np.linalg.norm(high[widest] - low[widest])
    for point in points:
        distance = np.linalg.norm(point - center)
        if distance > radius:
            radius = 0.5 * (radius + distance)
            center = center + (1 - radius / distance) * (point - center)
    return center, radius


def principal_box(points):
    """The box around points along the principal axes of their covariance.

    C r_i = lambda_i r_i,  C = mean of (x - m)(x - m)'    (syllabus row 4)

    points (n, 3) [m]; returns the centre (3,) [m], the rotation (3, 3), right-handed,
    whose columns are the box's axes r_i, and the half extents (3,) [m].
    Source: Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996.
    """
    middle = np.mean(points, axis=0)
    axes = np.linalg.eigh(np.cov(points.T))[1]
    axes = axes * np.sign(np.linalg.det(axes))
    along = (points - middle) @ axes
    lower, upper = np.min(along, axis=0), np.max(along, axis=0)
    return middle + axes @ (0.5 * (lower + upper)), axes, 0.5 * (upper - lower)
