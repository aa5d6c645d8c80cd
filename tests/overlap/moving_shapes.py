"""Shapes in motion, and what brute force proves of when two of them meet."""

import numpy as np
from overlap.drawn_shapes import DRAW
from scipy.spatial.transform import Rotation

from course.overlap.asking import gap
from course.shapes import AABB

STILL = np.zeros(3)


def at(shape, times, velocity, spin=STILL, pivot=STILL):
    """One shape at several times, a batch."""
    times = np.asarray(times, dtype=float)
    way = velocity * times[:, None]
    if isinstance(shape, AABB) and not np.any(spin):
        return AABB(shape.lower + way, shape.upper + way)
    turn = Rotation.from_rotvec(spin * times[:, None]).as_matrix()
    return shape.moved(turn, pivot + way - turn @ pivot)


def gaps(a, b, motion_a, motion_b, times):
    """The gap of two shapes at several times."""
    return np.atleast_1d(gap(at(a, times, *motion_a), at(b, times, *motion_b)))


def middle(shape):
    """Where a shape is: the middle of its bounds, or the foot of a plane."""
    if shape.kind == "half_space":
        return shape.normal * shape.offset[..., None]
    return shape.bounds().center


def drawn_pair(kind_a, kind_b, rng, count):
    """Pairs that mostly meet: shapes of two kinds and their velocities."""
    a, b = DRAW[kind_a](rng, count, 4.0), DRAW[kind_b](rng, count, 4.0)
    velocity_b = rng.normal(size=(count, 3))
    toward = rng.normal(0, 0.7, (count, 3))
    if "half_space" not in (kind_a, kind_b):
        return a, b, velocity_b + toward + (middle(b) - middle(a)) / 2, velocity_b
    if kind_a != "half_space":
        a, toward = lifted(a, b), toward - 2.0 * b.normal
    elif kind_b != "half_space":
        b, toward = lifted(b, a), toward + 2.0 * a.normal
    return a, b, velocity_b + toward, velocity_b


def lifted(shape, plane):
    """Each shape with its middle 3 above its plane or more."""
    height = np.sum(middle(shape) * plane.normal, axis=-1) - plane.offset
    way = (np.abs(height) + 3.0 - height)[:, None] * plane.normal
    if isinstance(shape, AABB):
        return AABB(shape.lower + way, shape.upper + way)
    return shape.moved(np.eye(3), way)


def speed_bound(a, b, motion_a, motion_b):
    """How fast the gap of two bounded shapes can change: |v_A - v_B| and of each |omega|
    times the distance of its farthest corner of bounds from its pivot."""
    bound = np.linalg.norm(motion_a[0] - motion_b[0])
    for shape, (_, spin, pivot) in (a, motion_a), (b, motion_b):
        if np.any(spin):
            box = shape.bounds()
            far = np.maximum(np.abs(box.lower - pivot), np.abs(box.upper - pivot))
            bound += np.linalg.norm(spin) * np.linalg.norm(far)
    return bound


def stays_above(level, a, b, motion_a, motion_b, end):
    """Whether the gap is proved to stay above a level until the end.

    The gap changes no faster than mu: above the level throughout an interval of length h
    if its values at both ends add up to more than 2 level + mu h. Others are halved.
    """
    mu = speed_bound(a, b, motion_a, motion_b) * (1 + 1e-9)
    start, width = np.linspace(0, end, 9)[:-1], end / 8
    for _ in range(40):
        left = gaps(a, b, motion_a, motion_b, start)
        right = gaps(a, b, motion_a, motion_b, start + width)
        if min(left.min(), right.min()) <= level:
            return False
        open_ones = start[left + right - 2 * level <= mu * width]
        if not open_ones.size:
            return True
        width /= 2
        start = np.concatenate([open_ones, open_ones + width])
        if start.size > 4000:
            break
    return False


def least_gap(a, b, velocity_a, velocity_b, end):
    """The least gap of two convex shapes in straight motion: of a convex function of time."""
    low, high = 0.0, end
    for _ in range(45):
        times = low + (high - low) * np.array([1, 2]) / 3
        one, other = gaps(a, b, (velocity_a,), (velocity_b,), times)
        low, high = (low, times[1]) if one < other else (times[0], high)
    return min(gaps(a, b, (velocity_a,), (velocity_b,), [0.0, low, end]))
