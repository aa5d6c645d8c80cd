"""Shapes that collide, and how they are fitted to points.

Spheres, capsules, boxes, k-DOPs, hulls, compounds, half spaces: every kind has
``support``, ``bounds``, ``moved``, ``volume``, a ``batch`` of any shape that is indexed as
NumPy does, and arrays that nobody writes to. ``polytopes`` gives corners, faces and edges.
"""

from course.shapes.aabb import AABB
from course.shapes.capsule import Capsule
from course.shapes.compound import Compound
from course.shapes.convex_hull import ConvexHull
from course.shapes.fitting import (
    bounding_box,
    bounding_sphere,
    capsule_around,
    compound_around,
    hull_around,
    k_dop,
    k_dop_directions,
    oriented_box,
    rotated_box_extents,
)
from course.shapes.half_space import HalfSpace
from course.shapes.kdop import KDOP
from course.shapes.meshes import Mesh, mesh_colliders, read_mesh
from course.shapes.obb import OBB
from course.shapes.rounded_polytopes import Polytopes, polytopes
from course.shapes.shape import Shape
from course.shapes.sphere import Sphere

__all__ = [
    "AABB",
    "KDOP",
    "OBB",
    "Capsule",
    "Compound",
    "ConvexHull",
    "HalfSpace",
    "Mesh",
    "Polytopes",
    "Shape",
    "Sphere",
    "bounding_box",
    "bounding_sphere",
    "capsule_around",
    "compound_around",
    "hull_around",
    "k_dop",
    "k_dop_directions",
    "mesh_colliders",
    "oriented_box",
    "polytopes",
    "read_mesh",
    "rotated_box_extents",
]
