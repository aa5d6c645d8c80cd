"""Places far from the origin, stored in few bytes: what becomes of the verdict on two spheres."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import astuple, dataclass, replace
from typing import Any

import numpy as np

from course.arrays import Array, BoolArray

#: ``spheres_overlap``: centre and radius of A, then of B.
SpheresVerdict = Callable[..., Any]
#: Gaps of drawn pairs lie between these, on either side of 0 [m].
CLEAR, WITHIN = 0.01, 0.5
DTYPES: dict[int, Any] = {2: np.float16, 4: np.float32, 8: np.float64}


@dataclass(frozen=True, eq=False)
class SpherePairs:
    """p pairs of spheres.

    Args:
        center_a, center_b: (p, 3) [m].
        radius_a, radius_b: (p,) [m].
        gap: as they were drawn, (p,) [m].
    """

    center_a: Array
    radius_a: Array
    center_b: Array
    radius_b: Array
    gap: Array

    def __len__(self) -> int:
        return len(self.gap)

    @property
    def arguments(self) -> tuple[Array, ...]:
        """As ``spheres_overlap`` takes them."""
        return astuple(self)[:4]

    @property
    def overlap(self) -> BoolArray:
        """The truth, (p,)."""
        return np.asarray(self.gap <= 0)


def spacing(distance: float, size: int = 4) -> float:
    """The step from a number to the next larger one that is stored in so many bytes [m]."""
    return float(np.spacing(DTYPES[size](distance)))


def sphere_pairs(
    count: int, distance: float, *, seed: int, clear: float = CLEAR
) -> SpherePairs:
    """Pairs about the place (D, D, D), close to touching; small gaps are as frequent as large ones.

    Args:
        count: of pairs.
        distance: D [m].
        clear: the least gap, or depth; the largest is 50 cm [m].
    """
    rng = np.random.default_rng(seed)
    center = distance + rng.uniform(0.0, 64.0, (count, 3))
    r_a, r_b = rng.uniform(0.5, 1.5, (2, count))
    gap = clear * (WITHIN / clear) ** rng.uniform(size=count)
    gap *= rng.choice([-1.0, 1.0], count)
    way = rng.normal(size=(count, 3))
    way /= np.linalg.norm(way, axis=-1, keepdims=True)
    return SpherePairs(center, r_a, center + (r_a + r_b + gap)[:, None] * way, r_b, gap)


def stored(pairs: SpherePairs, size: int) -> SpherePairs:
    """The same, every number rounded to so many bytes."""
    kind = DTYPES[size]
    with np.errstate(over="ignore"):
        x_a, r_a, x_b, r_b = (np.asarray(v, dtype=kind) for v in pairs.arguments)
    return SpherePairs(x_a, r_a, x_b, r_b, pairs.gap)


def seen_from_a(pairs: SpherePairs) -> SpherePairs:
    """The same question of fewer numbers: B's centre as it is seen from A's, and the sum of the radii."""
    nothing = np.zeros_like(pairs.center_a)
    return replace(
        pairs,
        center_a=nothing,
        radius_a=pairs.radius_a + pairs.radius_b,
        center_b=pairs.center_b - pairs.center_a,
        radius_b=nothing[:, 0],
    )


def wrong_verdicts(verdict: SpheresVerdict, pairs: SpherePairs) -> float:
    """Share of wrong verdicts, 0 to 1; infinities and what comes of them are not warned of."""
    with np.errstate(all="ignore"):
        return float(np.mean(verdict(*pairs.arguments) != pairs.overlap))


def wrong_far_out(
    verdict: SpheresVerdict,
    distances: Sequence[float],
    *,
    first_from_a: bool = False,
    size: int = 4,
    count: int = 10_000,
    seed: int = 4,
) -> Array:
    """Share of wrong verdicts at each distance D, with numbers of so many bytes.

    Args:
        verdict: ``spheres_overlap``.
        distances: D [m].
        first_from_a: whether places are subtracted before they are rounded.
    """
    shares = []
    for distance in distances:
        pairs = sphere_pairs(count, distance, seed=seed)
        pairs = seen_from_a(pairs) if first_from_a else pairs
        shares.append(wrong_verdicts(verdict, stored(pairs, size)))
    return np.array(shares)


def steps_say(
    distances: Sequence[float], *, size: int = 4, count: int = 10_000, seed: int = 5
) -> Array:
    """The shares that steps alone predict: places are multiples of the spacing, all else is exact."""
    shares = []
    for distance in distances:
        pairs, step = sphere_pairs(count, 0.0, seed=seed), spacing(distance, size)
        on_steps = (np.rint(x / step) * step for x in (pairs.center_a, pairs.center_b))
        apart = np.linalg.norm(np.subtract(*on_steps), axis=-1)
        said = apart <= pairs.radius_a + pairs.radius_b
        shares.append(np.mean(said != pairs.overlap))
    return np.array(shares)


def safe_until(gap: float, size: int = 4) -> float:
    """The D up to which no verdict can be wrong on spheres that are a gap away from touching [m].

    Each coordinate is off by up to half a step, so each difference by up to a step u, and
    the distance by up to sqrt(3) u. The first power of 2 with a step above gap/sqrt(3).
    """
    digits = np.finfo(DTYPES[size]).nmant
    return float(2.0 ** (np.floor(np.log2(gap / np.sqrt(3.0))) + 1 + digits))
