"""Which broad phase serves: one call for all of them."""

from __future__ import annotations

from collections.abc import Callable
from types import MappingProxyType

import numpy as np

from course.arrays import IntArray, choice
from course.detection.brute_force import all_pairs, bounds_of, size_of
from course.detection.grid import WIDE, uniform_grid, widths_of
from course.detection.hierarchy import bvh
from course.detection.partitions import bsp_tree, kd_tree
from course.detection.spheres import sphere_tree
from course.detection.sweeping import sweep_and_prune
from course.shapes import AABB

#: Every broad phase, by its name.
METHODS: MappingProxyType[str, Callable[[AABB], IntArray]] = MappingProxyType(
    {
        "all_pairs": all_pairs,
        "sweep_and_prune": sweep_and_prune,
        "uniform_grid": uniform_grid,
        "kd_tree": kd_tree,
        "bsp_tree": bsp_tree,
        "sphere_tree": sphere_tree,
        "bvh": bvh,
    }
)
#: Up to so many boxes a sweep is quickest: it builds nothing.
FEW = 100
#: The grid serves where at most this part of the boxes is wider than its cells.
ODD = 0.01


def broad_phase(boxes: AABB, *, method: str = "auto") -> IntArray:
    """The pairs of boxes that overlap or touch, by the method named or by one that suits them.

    All methods give the same pairs; ``method_for`` says what "auto" takes.

    Args:
        boxes: AABB of batch (n,) [m]; they may reach to infinity.
        method: "auto", "all_pairs", "sweep_and_prune", "uniform_grid", "kd_tree",
            "bsp_tree", "sphere_tree" or "bvh".
    Returns:
        (m, 2) ints, i < j, sorted by i, then j.
    Raises:
        ValueError: anything else than boxes with one batch axis, another method.
    """
    chosen = choice("method", method, ("auto", *METHODS))
    return METHODS[method_for(boxes) if chosen == "auto" else chosen](boxes)


def method_for(boxes: AABB) -> str:
    """The method that "auto" takes for these boxes.

    A sweep for a few; a grid where nearly all boxes are at most twice as wide as the
    median, so that cells of one size suit them; else a bounding volume hierarchy, to
    which sizes do not matter.
    """
    bounds = bounds_of(boxes)
    if len(bounds) <= FEW:
        return "sweep_and_prune"
    if not np.isfinite(size_of(bounds)):
        return "bvh"
    widths = widths_of(bounds / 2)
    wide = np.count_nonzero(widths > WIDE * np.median(widths))
    return "uniform_grid" if wide <= ODD * len(bounds) else "bvh"
