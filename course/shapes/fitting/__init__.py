"""Colliders of each kind fitted to points."""

from course.shapes.fitting.bounding_boxes import (
    bounding_box,
    oriented_box,
    rotated_box_extents,
)
from course.shapes.fitting.bounding_capsules import capsule_around
from course.shapes.fitting.bounding_polytopes import (
    compound_around,
    hull_around,
    k_dop,
    k_dop_directions,
)
from course.shapes.fitting.bounding_spheres import bounding_sphere

__all__ = [
    "bounding_box",
    "bounding_sphere",
    "capsule_around",
    "compound_around",
    "hull_around",
    "k_dop",
    "k_dop_directions",
    "oriented_box",
    "rotated_box_extents",
]
