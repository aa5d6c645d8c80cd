"""Two boxes turned almost alike: the short form of the 15 axes, and what rounding does to it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course.arrays import Array, BoolArray
from course.study.box_verdicts import BoxPairs, random_turns

#: Half the distance of two neighbouring numbers near 1.
ROUNDING = 0.5 * float(np.finfo(float).eps)


def relative_verdict(pairs: BoxPairs, epsilon: float = 0.0) -> BoolArray:
    """Whether boxes overlap by the 15 axes, in the short form that lives in A's frame.

    With R = R_A' R_B and t = R_A' (x_B - x_A) the axis a_i x b_j needs four products:
    |t_k R_lj - t_l R_kj| <= e_Al |R_kj| + e_Ak |R_lj| + e_Bm |R_in| + e_Bn |R_im|,
    where (i, l, k) and (j, m, n) follow each other. It is exact as long as R is.
    Source: Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996.

    Args:
        pairs: p pairs of boxes.
        epsilon: added to each |R_ij|, so that rounding cannot call them apart.
    Returns:
        (p,) of bool.
    """
    R = np.swapaxes(pairs.rotation_a, -1, -2) @ pairs.rotation_b
    t = np.einsum("pji,pj->pi", pairs.rotation_a, pairs.center_b - pairs.center_a)
    return verdict_of_relative(
        R, t, pairs.half_extents_a, pairs.half_extents_b, epsilon
    )


def verdict_of_relative(
    R: Array, t: Array, e_a: Array, e_b: Array, epsilon: float = 0.0
) -> BoolArray:
    """The same, from R (p, 3, 3), t, e_A and e_B, (p, 3) each [m]."""
    size = np.abs(R) + epsilon
    ok = np.all(np.abs(t) <= e_a + np.einsum("pij,pj->pi", size, e_b), axis=-1)
    along_b = np.abs(np.einsum("pi,pij->pj", t, R))
    ok &= np.all(along_b <= e_b + np.einsum("pij,pi->pj", size, e_a), axis=-1)
    for i in range(3):
        l, k = (i + 1) % 3, (i + 2) % 3  # noqa: E741
        for j in range(3):
            m, n = (j + 1) % 3, (j + 2) % 3
            between = np.abs(t[:, k] * R[:, l, j] - t[:, l] * R[:, k, j])
            half_a = e_a[:, l] * size[:, k, j] + e_a[:, k] * size[:, l, j]
            half_b = e_b[:, m] * size[:, i, n] + e_b[:, n] * size[:, i, m]
            ok &= between <= half_a + half_b
    return np.asarray(ok)


def tilted_pairs(tilt: float, count: int, seed: int) -> BoxPairs:
    """Pairs that overlap: B's centre in reach of A's, B turned against A by the tilt [rad]."""
    rng = np.random.default_rng(seed)
    rotation_a = random_turns(rng, count)
    e = rng.uniform(0.2, 1.0, (2, count, 3))
    inside = rng.uniform(-1.0, 1.0, (count, 3)) * (e[0] + e[1]) * (1 - 1e-6)
    center_a = rng.normal(size=(count, 3))
    center_b = center_a + np.einsum("pij,pj->pi", rotation_a, inside)
    turned = rotation_a @ (np.eye(3) + tilt * _cross_matrices(_directions(rng, count)))
    return BoxPairs(center_a, rotation_a, e[0], center_b, turned, e[1])


def called_apart(
    tilts: Sequence[float], *, count: int = 20_000, seed: int = 5, epsilon: float = 0.0
) -> Array:
    """Share of the overlapping pairs that the short form calls apart, for each tilt."""
    return np.array(
        [
            1.0 - np.mean(relative_verdict(tilted_pairs(t, count, seed), epsilon))
            for t in tilts
        ]
    )


def rounding_says(
    tilts: Sequence[float], *, count: int = 20_000, seed: int = 6
) -> Array:
    """The share that rounding alone predicts: R is right but for a random error in each entry.

    An entry of R is a sum of three products, each about a third, of factors that were
    rounded before: about eleven roundings, which add up to a scatter of 0.7 u.
    """
    rng = np.random.default_rng(seed)
    shares = []
    for tilt in tilts:
        e = rng.uniform(0.2, 1.0, (2, count, 3))
        t = rng.uniform(-1.0, 1.0, (count, 3)) * (e[0] + e[1]) * (1 - 1e-6)
        error = 0.7 * ROUNDING * rng.normal(size=(count, 3, 3))
        R = np.eye(3) + (tilt * _cross_matrices(_directions(rng, count)) + error)
        shares.append(1.0 - np.mean(verdict_of_relative(R, t, e[0], e[1])))
    return np.array(shares)


def _directions(rng: np.random.Generator, count: int) -> Array:
    way = rng.normal(size=(count, 3))
    return np.asarray(way / np.linalg.norm(way, axis=-1, keepdims=True))


def _cross_matrices(v: Array) -> Array:
    """[v]x of each, (p, 3, 3): a small turn about v is 1 + [v]x."""
    return np.cross(v[:, None], np.eye(3)[None]).swapaxes(-1, -2)
