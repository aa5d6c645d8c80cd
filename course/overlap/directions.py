"""Lengths and unit vectors of differences, where these may be zero."""

from __future__ import annotations

import numpy as np

from course.arrays import Array

#: Lengths below this are none: their squares have lost digits [m].
TINY = 1e-150
#: The direction where none is better than another.
UP = np.array([0.0, 0.0, 1.0])
UP.setflags(write=False)


def directed(difference: Array, otherwise: Array) -> tuple[Array, Array]:
    """Length (...) and direction (..., 3) of vectors; the other direction where they are zero."""
    length = np.sqrt(np.einsum("...i,...i", difference, difference))
    none = (length <= TINY)[..., None]
    if not none.any():
        return length, difference / length[..., None]
    safe = np.where(none, 1.0, length[..., None])
    return length, np.where(none, otherwise, difference / safe)
