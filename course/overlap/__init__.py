"""One question asked of two shapes: do they overlap, how far apart are they, where do
they touch, when do they meet.
"""

from course.overlap.box_faces import stacked_box_contacts
from course.overlap.closest import Closest, closest_points, least_translation
from course.overlap.contact_arrays import FEATURES, Contacts
from course.overlap.feature_pairs import FeaturePair
from course.overlap.oriented_boxes import oriented_boxes_overlap
from course.overlap.impact_times import swept_bounds, time_of_impact
from course.overlap.spheres import Spheres, sphere_contacts, sphere_plane_contacts

__all__ = [
    "FEATURES",
    "Closest",
    "Contacts",
    "FeaturePair",
    "Spheres",
    "closest_points",
    "least_translation",
    "oriented_boxes_overlap",
    "sphere_contacts",
    "sphere_plane_contacts",
    "stacked_box_contacts",
    "swept_bounds",
    "time_of_impact",
]
