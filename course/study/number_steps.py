"""How far a stored number is from the next one, over where it lies."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import Array
from course.study.far_places import spacing

#: Up to which place there are numbers of so many bytes, or are shown [m].
LAST = {2: 6.5e4, 4: 1e12, 8: 1e12}


@dataclass(frozen=True, eq=False)
class NumberSteps:
    """The step from a number to the next larger one.

    Args:
        curves: by bytes, place and step, (p, 2) [m].
        marked, marked_step: a place, and its step in 4 bytes [m].
    """

    curves: dict[int, Array]
    marked: float
    marked_step: float


def steps_of_numbers(*, marked: float = 1e8, count: int = 600) -> NumberSteps:
    """The steps of numbers of 2, 4 and 8 bytes at places from 1 m on, evenly in their logarithm.

    Args:
        marked: a place of which the step in 4 bytes is told [m].
        count: of places of each curve.
    """
    curves = {
        size: np.array([(x, spacing(x, size)) for x in np.geomspace(1.0, last, count)])
        for size, last in LAST.items()
    }
    return NumberSteps(curves, marked, spacing(marked))
