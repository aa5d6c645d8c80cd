"""Which normal decides what meets: ties between directions that are as good as each other.

A box whose edge touches another's can be pushed away along either face, or along anything
between; which of these the distance query says is rounding. So where a face of either
solid is as good as what was found, within ``bias`` of depth, the face decides (as
in D. Gregorius, "The separating axis test", GDC 2013), and of several the one that points
most along a fixed direction, either way. That does not depend on which body is A.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.manifold.meeting import upward
from course.overlap.manifold.patches import A, B, ball, height


@compiled
def choose_normal(
    normals: Array,
    begin: int,
    end: int,
    loop: IntArray,
    loop_start: IntArray,
    own: Array,
    other: Array,
    first: int,
    last: int,
    origin: Array,
    side: int,
    least: float,
    best: float,
    normal: Array,
) -> float:
    """Take for N the normal of a face of one solid that is a separating axis as good as any.

    Args:
        normals, begin, end, loop, loop_start, own: the faces and vertices of the solid.
        other, first, last: vertices of the other solid.
        side: B where the solid is B, else A.
        least: the separation of the cores that is as good as any [m].
        best: how far the normal taken before points along ``UPPER``; below 0 if there is none.
        normal: (3,), is written.
    Returns:
        ``best`` of the normal that stands now.
    """
    for f in range(begin, end):
        x, y, z = normals[f, 0], normals[f, 1], normals[f, 2]
        size = abs(upward(normals, f))
        if size <= best:
            continue
        level = height(own, loop[loop_start[f]], origin, x, y, z) + least
        apart = True
        for v in range(first, last):
            if height(other, v, origin, x, y, z) < level:
                apart = False
                break
        if apart:
            sign = 1.0 if side == B else -1.0
            normal[0], normal[1], normal[2] = sign * x, sign * y, sign * z
            best = size
    return best


def warm() -> None:
    """Call the kernel once (``course.jit``)."""
    one = ball()
    choose_normal(one.normals, 0, 0, one.loop, one.loop_start, one.vertices, one.vertices,
                  0, 1, np.zeros(3), A, 0.0, -1.0, np.zeros(3))  # fmt: skip
