"""Two balls that fly past or into each other: where they are, how far apart, and when a function stops them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array
from course.study.asking import asked

#: Of A and B [m].
RADII = (0.3, 0.5)
#: Where B is at the start [m], and how long they are followed [s].
PLACE_B, HORIZON = np.array([1.0, 0.0, 0.0]), 2.0


@dataclass(frozen=True, eq=False)
class Throw:
    """Two balls until a function says that they meet.

    Args:
        times: (t,) [s].
        a, b: centres, (t, 3) [m].
        gap: (t,) [m].
        stop: when they were stopped [s], inf if never.
    """

    times: Array
    a: Array
    b: Array
    gap: Array
    stop: float


def thrown(
    start: Array,
    velocity_a: Array,
    velocity_b: Array,
    times: Array,
    function: Callable[..., Any] = formulas.swept_spheres_time,
) -> Throw:
    """A from its start (3,) [m] and B from ``PLACE_B``, both in straight lines [m/s].

    Both stand still from the time of impact on that a ``swept_spheres_time`` gives.
    """
    r, s = RADII
    (found,) = asked(
        function, [()], start, r, velocity_a, PLACE_B, s, velocity_b, HORIZON, never=True
    )  # fmt: skip
    stop = max(float(found), 0.0)
    flown = np.minimum(times, stop)[:, None]
    a, b = start + flown * velocity_a, PLACE_B + flown * velocity_b
    gap = np.linalg.norm(a - b, axis=-1) - r - s
    return Throw(times, a, b, gap, stop)
