"""Spheres that touch, or nearly: what rounding makes of the verdict."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np

from course.arrays import Array
from course.study.far_places import SpherePairs, SpheresVerdict

#: Half the distance of two neighbouring numbers near 1.
ROUNDING = 0.5 * float(np.finfo(float).eps)
#: No verdict is wrong where the gap, over the sum of the radii, is larger than this.
#: The square of the distance has at most five roundings: two of the differences, whose
#: square it is, one of the square and two of the sum; that of the radii has three. A
#: square that is off by 8 u belongs to a length that is off by 4 u.
DECIDED = 4 * ROUNDING


def tenths(count: int = 50) -> SpherePairs:
    """Spheres with radii of whole tenths of a metre, from 0.1 on, that touch along x."""
    i, j = (g.ravel() for g in np.mgrid[1 : count + 1, 1 : count + 1])
    center_b = ((i + j) / 10)[:, None] * [1.0, 0.0, 0.0]
    touching = np.zeros(i.size)
    return SpherePairs(np.zeros((i.size, 3)), i / 10, center_b, j / 10, touching)


def nearly_touching(count: int = 4000, *, seed: int = 4) -> SpherePairs:
    """Spheres a few roundings away from touching, with their gap to the last digit."""
    rng = np.random.default_rng(seed)
    x_a, x_b = rng.uniform(-4.0, 4.0, (2, count, 3))
    distance = np.linalg.norm(x_b - x_a, axis=-1)
    r_a = distance * rng.uniform(0.2, 0.8, count)
    r_b = distance * (1 + rng.uniform(-12, 12, count) * ROUNDING) - r_a
    gap = [_gap(*pair) for pair in zip(x_a, r_a, x_b, r_b, strict=True)]
    return SpherePairs(x_a, r_a, x_b, r_b, np.array(gap))


def _gap(x_a: Array, r_a: float, x_b: Array, r_b: float) -> float:
    """The gap of two spheres that nearly touch, in fractions: (s - R^2)/(2 R)."""
    apart = [Fraction(p) - Fraction(q) for p, q in zip(x_a, x_b, strict=True)]
    reach = Fraction(float(r_a)) + Fraction(float(r_b))
    return float((sum(d * d for d in apart) - reach * reach) / (2 * reach))


def called_touching(
    verdict: SpheresVerdict, pairs: SpherePairs, edges: Array
) -> tuple[Array, Array]:
    """Of pairs by their gap, over the sum of the radii: the middle of each bin, and the share called overlapping.

    Args:
        edges: of the bins, ascending, (k + 1,).
    """
    relative = pairs.gap / (pairs.radius_a + pairs.radius_b)
    said = np.asarray(verdict(*pairs.arguments), dtype=float)
    bins = np.digitize(relative, edges) - 1
    share = [said[bins == k].mean() for k in range(len(edges) - 1)]
    return 0.5 * (edges[1:] + edges[:-1]), np.array(share)


def with_margin(verdict: SpheresVerdict, margin: float) -> Callable[..., Any]:
    """A verdict on spheres that are this much larger together [m]."""
    return lambda x_a, r_a, x_b, r_b: verdict(x_a, r_a + margin, x_b, r_b)
