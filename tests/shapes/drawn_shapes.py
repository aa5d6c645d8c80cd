"""Shapes of every kind, drawn by seed, for the tests of shapes and of what uses them."""

import numpy as np
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
)

CONVEX = ("sphere", "capsule", "aabb", "obb", "kdop", "convex_hull")


def rotations(rng, *batch):
    count = int(np.prod(batch))
    return Rotation.random(count, random_state=rng).as_matrix().reshape(*batch, 3, 3)


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def drawn(kind, rng, *batch):
    """Shapes of a kind, about 1 in size and near the origin."""
    center, size = rng.normal(size=(*batch, 3)), rng.uniform(0.2, 1.5, (*batch, 3))
    if kind == "sphere":
        return Sphere(center, size[..., 0])
    if kind == "capsule":
        return Capsule(center, center + rng.normal(size=(*batch, 3)), size[..., 0])
    if kind == "aabb":
        return AABB(center - size, center + size)
    if kind == "obb":
        return OBB(center, rotations(rng, *batch), size)
    if kind == "kdop":
        d = unit(np.concatenate([np.eye(3), rng.normal(size=(4, 3))]))
        along = center @ d.T
        reach = np.abs(d @ size[..., None])[..., 0] + rng.uniform(0.1, 0.4, along.shape)
        return KDOP(d, along - reach, along + reach)
    if kind == "convex_hull":
        return ConvexHull(center[..., None, :] + rng.normal(size=(*batch, 12, 3)))
    if kind == "compound":
        kinds = ("sphere", "obb", "convex_hull")
        return Compound(tuple(drawn(each, rng, *batch) for each in kinds))
    return HalfSpace(unit(rng.normal(size=(*batch, 3))), rng.normal(size=batch))
