"""One question asked of two shapes: do they overlap, how far apart are they, where do
they touch, when do they meet.
"""

from course.overlap.asking import contacts, gap, nearest_points, overlaps
from course.overlap.box_faces import stacked_box_contacts
from course.overlap.boxes import boxes_overlap, sphere_box_gap
from course.overlap.contact_arrays import FEATURES, Contacts
from course.overlap.convex.closest import Closest, closest_points, least_translation
from course.overlap.curved.capsules import (
    capsule_gap,
    closest_point_on_segment,
    sphere_capsule_gap,
)
from course.overlap.curved.spheres import (
    Spheres,
    sphere_contacts,
    sphere_plane_contacts,
    spheres_overlap,
)
from course.overlap.feature_pairs import FeaturePair
from course.overlap.impact_times import swept_bounds, time_of_impact
from course.overlap.oriented_boxes import oriented_boxes_overlap

__all__ = [
    "FEATURES",
    "Closest",
    "Contacts",
    "FeaturePair",
    "Spheres",
    "boxes_overlap",
    "capsule_gap",
    "closest_point_on_segment",
    "closest_points",
    "contacts",
    "gap",
    "least_translation",
    "nearest_points",
    "oriented_boxes_overlap",
    "overlaps",
    "sphere_box_gap",
    "sphere_capsule_gap",
    "sphere_contacts",
    "sphere_plane_contacts",
    "spheres_overlap",
    "stacked_box_contacts",
    "swept_bounds",
    "time_of_impact",
]
