"""Contacts of spheres and capsules with anything: the points, and the curvature of both sides.

A sphere touches at one point; so does a capsule, unless it lies along a face, an edge or
another capsule: then at the two ends of the stretch they share, each with its own
separation and normal.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import Array, BoolArray, IntArray
from course.overlap.capsules import parameter
from course.overlap.closest import Closest
from course.overlap.contact_arrays import Contacts
from course.overlap.curvature import (
    SHARP,
    in_all_directions,
    of_radius,
    of_segment,
    perpendicular,
)
from course.shapes import Capsule, HalfSpace, Polytopes, Sphere, polytopes

#: Parts of a segment, or of the size, below this are none.
SMALL = 1e-9
#: The features of a capsule: its two ends, and its side.
START, END, SIDE = 0, 1, 2


def one_contact(a: Any, b: Any, near: Closest) -> Contacts:
    """The contact at the nearest points of each of k pairs of which one side, at least, is a sphere or capsule."""
    bend = np.maximum(roundness(a), roundness(b))
    tensor_a, feature_a = surface(a, -near.normal, near.point_a, bend)
    tensor_b, feature_b = surface(b, near.normal, near.point_b, bend)
    point = near.point_b + 0.5 * near.gap[:, None] * near.normal
    rows = np.arange(len(point))
    return curved(rows, point, near.normal, near.gap, (tensor_a, tensor_b), (feature_a, feature_b))  # fmt: skip
