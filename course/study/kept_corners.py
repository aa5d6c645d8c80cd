"""What of a face still carries when a manifold keeps only some of its corners."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course.arrays import Array
from course.overlap import contacts
from course.shapes import ConvexHull, HalfSpace


def regular_prism(sides: int) -> ConvexHull:
    """A prism on a regular polygon of radius 1 m about the origin, standing on z = 0."""
    angle = 2 * np.pi * np.arange(sides) / sides
    ring = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=-1)
    return ConvexHull(np.concatenate([ring, ring + [0.0, 0.0, 0.5]]))


def kept_support(sides: int, limits: Sequence[int]) -> Array:
    """Area that the contacts of a standing prism span, over that of its base, (k,).

    Only a load whose line of action meets that area is carried by forces that push: the
    rest of the base tips (syllabus row 21).

    Args:
        sides: of the regular polygon it stands on.
        limits: how many contacts are kept at most, ``limit`` of ``contacts``, (k,).
    """
    floor = HalfSpace(np.array([0.0, 0.0, 1.0]), np.array(0.0))
    whole = 0.5 * sides * np.sin(2 * np.pi / sides)
    prism = regular_prism(sides)
    return np.array([_area(contacts(prism, floor, limit=k).point) / whole for k in limits])  # fmt: skip


def largest_share(sides: int, kept: Sequence[int]) -> Array:
    """The largest polygon of ``kept`` corners of a regular one, over the whole.

    k sin(2 pi/k)/(n sin(2 pi/n)) where k divides n; between, its sides span floor(n/k) or
    one more of the n sides, each triangle with the centre sin(2 pi s/n)/2.
    """
    count = np.minimum(kept, sides)
    short, more = sides // count, sides % count
    angle = 2 * np.pi / sides
    parts = (count - more) * np.sin(short * angle) + more * np.sin((short + 1) * angle)
    return np.asarray(parts / (sides * np.sin(angle)))


def _area(points: Array) -> float:
    """Of the polygon that points around the origin span [m^2], by the shoelace formula."""
    flat = points[np.argsort(np.arctan2(points[:, 1], points[:, 0])), :2]
    after = np.roll(flat, -1, axis=0)
    return 0.5 * abs(float(np.sum(flat[:, 0] * after[:, 1] - flat[:, 1] * after[:, 0])))
