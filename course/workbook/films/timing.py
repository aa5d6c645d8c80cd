"""The moments of a film: evenly spaced, and each jump twice."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course.arrays import Array, BoolArray


def moments(
    last: float, jumps: Sequence[float] = (), *, frames: int = 60
) -> tuple[Array, BoolArray]:
    """Times from 0 to ``last`` [s] with every jump twice, and which are just after one.

    Args:
        last: end of the film [s].
        jumps: times from 0 to ``last`` [s]; others are left out.
        frames: how many evenly spaced moments there are besides.
    Returns:
        times (t,), not descending, and (t,) truths: the second of a pair.
    """
    inside = sorted({float(t) for t in jumps if 0 <= t <= last})
    even = np.setdiff1d(np.linspace(0.0, last, frames), inside)
    times = np.concatenate([even, inside, inside])
    after = np.arange(times.size) >= even.size + len(inside)
    order = np.lexsort((after, times))
    return times[order], after[order]
