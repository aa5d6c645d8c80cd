"""Whether oriented boxes overlap, by their 15 separating axes."""

from __future__ import annotations

import numpy as np

from course.arrays import BoolArray, broadcast
from course.overlap.convex.closest import closest_points
from course.overlap.convex.separating_axis import UNSURE, box_pairs_told
from course.shapes import OBB, polytopes


def oriented_boxes_overlap(a: OBB, b: OBB) -> BoolArray:
    """Whether boxes overlap; touching counts.

    ``box_separation`` <= 0, pair by pair and only until an axis is found along which they are apart
    (S. Gottschalk, M. C. Lin, D. Manocha, "OBBTree", SIGGRAPH 1996). Pairs nearer
    to touching than the axes of a box are exact (BAND) are told by the gap of their vertices.

    Args:
        a, b: boxes, whose batches broadcast.
    Returns:
        (...).
    Raises:
        ValueError: batches that do not broadcast.
    """
    batch = broadcast(a=(np.empty(a.batch), 0), b=(np.empty(b.batch), 0))
    count = int(np.prod(batch))
    first, second = a.broadcast_to(batch), b.broadcast_to(batch)
    first, second = first.reshaped(count), second.reshaped(count)
    arrays = ((box.center, box.rotation, box.half_extents) for box in (first, second))
    verdict = box_pairs_told(*next(arrays), *next(arrays))
    overlap = verdict > 0
    unsure = np.flatnonzero(verdict == UNSURE)
    if unsure.size:
        solids = polytopes(first[unsure]), polytopes(second[unsure])
        each = np.arange(unsure.size)
        overlap[unsure] = closest_points(*solids, each, each).gap <= 0
    return overlap.reshape(batch)
