"""Lesson 04, Overlap tests: spheres, upright boxes and capsules, asked in the fewest steps.

Shapes are closed: touching counts as overlapping. A sphere is its centre (..., 3) [m]
and radius (...) [m]; an upright box its lowest and highest corner (..., 3) [m]; a capsule
all that is within its radius of a segment, which is given by its ends (..., 3) [m].
"""

import numpy as np


def point_in_sphere(point, center, radius):
    """Whether a point lies in a sphere, without a square root.

    |p - x|^2 <= r^2    (syllabus row 9)

    point p and centre x (..., 3) [m], radius r (...) [m]; returns (...) of bool.
    Source: Ericson, "Real-Time Collision Detection", section 4.3.
    """
    away = point - center
    return np.sum(away * away, axis=-1) <= radius**2


def spheres_overlap(center_a, radius_a, center_b, radius_b):
    """Whether two spheres overlap, without a square root.

    |x_A - x_B|^2 <= (r_A + r_B)^2    (syllabus row 9)

    centres (..., 3) [m], radii (...) [m]; returns (...) of bool.
    Source: Ericson, "Real-Time Collision Detection", section 4.3.1.
    """
    apart = center_a - center_b
    return np.sum(apart * apart, axis=-1) <= (radius_a + radius_b) ** 2


def boxes_overlap(lower_a, upper_a, lower_b, upper_b):
    """Whether two axis-aligned boxes overlap: their intervals do on all three axes.

    l_A <= u_B and l_B <= u_A in x, y and z    (syllabus rows 4 and 11)

    corners (..., 3) [m], lower <= upper; returns (...) of bool.
    Source: Ericson, "Real-Time Collision Detection", section 4.2.1.
    """
    return np.all((lower_a <= upper_b) & (lower_b <= upper_a), axis=-1)


def foot_share(p_1, p_2, p_3, b_1, b_2, b_3):
    """Which share of the way to b is nearest to p, seen from a, as an expression.

    |p - s b|^2 is least at s = p.b / b.b    (syllabus row 3)

    places p and b [m], the segment's other end being the origin; returns s [1].
    Source: the derivative 2 (s b.b - p.b) set to 0; Ericson, section 5.1.2.
    """
    return (p_1 * b_1 + p_2 * b_2 + p_3 * b_3) / (b_1**2 + b_2**2 + b_3**2)


def closest_point_on_segment(point, start, end):
    """The point of a segment that is nearest to a point.

    q = a + s (b - a),  s = clamp((p - a).(b - a) / |b - a|^2, 0, 1)    (syllabus row 3)

    point p, start a, end b (..., 3) [m]; a itself where the segment is only a point;
    returns q (..., 3) [m].
    Source: Ericson, "Real-Time Collision Detection", section 5.1.2.
    """
    way = end - start
    square = np.sum(way * way, axis=-1, keepdims=True)
    along = np.sum((point - start) * way, axis=-1, keepdims=True)
    share = along / np.where(square == 0, 1.0, square)
    return start + np.clip(share, 0.0, 1.0) * way


def sphere_capsule_gap(center, radius, start, end, capsule_radius):
    """Signed gap of a sphere and a capsule; below 0 they overlap.

    d = |x - q| - r - R, q the point of the segment nearest to x    (syllabus row 3)

    centre x, start and end (..., 3) [m], radii r and R (...) [m]; returns (...) [m].
    Source: Ericson, "Real-Time Collision Detection", section 4.5.1.
    """
    nearest = closest_point_on_segment(center, start, end)
    return np.linalg.norm(center - nearest, axis=-1) - radius - capsule_radius


def capsule_gap(start_a, end_a, radius_a, start_b, end_b, radius_b):
    """Signed gap of two capsules: the distance of their segments less both radii.

    nearest are the feet of the line across both, n = u x v, s = (w x v).n / n.n,
    t = (w x u).n / n.n, where both lie inside; else an end of one, and the point of the
    other that is nearest to it    (syllabus row 3)

    ends (..., 3) [m], radii (...) [m]; returns (...) [m], below 0 they overlap.
    Source: Ericson, "Real-Time Collision Detection", sections 4.5.1 and 5.1.9.
    """
    ends_a, ends_b = (start_a, end_a), (start_b, end_b)
    u, v, w = end_a - start_a, end_b - start_b, start_b - start_a
    n = np.cross(u, v)
    square = np.sum(n * n, axis=-1, keepdims=True)
    square = np.where(square == 0, np.inf, square)
    s = np.sum(np.cross(w, v) * n, axis=-1, keepdims=True) / square
    t = np.sum(np.cross(w, u) * n, axis=-1, keepdims=True) / square
    between = [np.clip(s, 0.0, 1.0) * u - w - np.clip(t, 0.0, 1.0) * v]
    between += [p - closest_point_on_segment(p, *ends_b) for p in ends_a]
    between += [p - closest_point_on_segment(p, *ends_a) for p in ends_b]
    distance = np.min([np.linalg.norm(x, axis=-1) for x in between], axis=0)
    return distance - radius_a - radius_b


def sphere_box_gap(center, radius, lower, upper):
    """Signed gap of a sphere and an axis-aligned box, also with the centre inside.

    outside d = |x - clamp(x, l, u)| - r;  inside the way out is past the nearest face,
    d = -min_i(x_i - l_i, u_i - x_i) - r    (syllabus rows 3 and 4)

    centre x (..., 3), corners l and u (..., 3) [m], radius r (...) [m]; returns (...) [m].
    Source: Ericson, "Real-Time Collision Detection", sections 5.1.3 and 5.2.5.
    """
    outside = np.linalg.norm(center - np.clip(center, lower, upper), axis=-1)
    inset = np.min(np.minimum(center - lower, upper - center), axis=-1)
    return np.where(inset > 0, -inset, outside) - radius
