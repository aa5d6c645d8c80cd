"""Shapes that collide: spheres, capsules, boxes, k-DOPs, hulls, compounds, half spaces.

Every kind has ``support``, ``bounds``, ``moved``, ``volume``, a ``batch`` of any shape
that is indexed as NumPy does, and arrays that nobody writes to.
"""

from course.shapes.aabb import AABB
from course.shapes.capsule import Capsule
from course.shapes.compound import Compound
from course.shapes.convex_hull import ConvexHull
from course.shapes.half_space import HalfSpace
from course.shapes.kdop import KDOP
from course.shapes.obb import OBB
from course.shapes.rounded_polytopes import Polytopes, polytopes
from course.shapes.shape import Shape
from course.shapes.sphere import Sphere

__all__ = [
    "AABB",
    "OBB",
    "KDOP",
    "Capsule",
    "Compound",
    "ConvexHull",
    "HalfSpace",
    "Polytopes",
    "Shape",
    "Sphere",
    "polytopes",
]
