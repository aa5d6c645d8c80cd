"""A tree of spheres: a bounding volume hierarchy whose volumes are spheres."""

from __future__ import annotations

from dataclasses import dataclass

from course.arrays import Array, IntArray, failure, written
from course.detection.brute_force import HUGE, bounds_of, pairs_by, size_of
from course.detection.hierarchy import BVH
from course.shapes import AABB, Sphere


def sphere_tree(boxes: AABB) -> IntArray:
    """The pairs of boxes that overlap or touch, by a tree of spheres.

    Two spheres are apart where |c_1 - c_2| > r_1 + r_2: one test, the same however
    they turn, but a sphere holds a box less closely than a box does. At the leaves the
    boxes themselves are tested.

    Source: S. Quinlan, "Efficient distance computation between non-convex objects",
    1994; P. M. Hubbard, "Approximating polyhedra with spheres for time-critical
    collision detection", 1996; syllabus row 13.

    Args:
        boxes: AABB of batch (n,) [m]; they may reach to infinity.
    Returns:
        (m, 2) ints, i < j, sorted by i, then j.
    Raises:
        ValueError: anything else than boxes with one batch axis.
    """
    return pairs_by(_paired, boxes)


def _paired(bounds: Array) -> IntArray:
    return SphereTree.build(AABB(bounds[:, :3], bounds[:, 3:])).pairs()


@dataclass(frozen=True, eq=False)
class SphereTree:
    """The nodes of a ``BVH``, each with a sphere that holds its boxes.

    Attributes:
        tree: the nodes.
        spheres: (nodes, 4), centre and radius [m].
    """

    tree: BVH
    spheres: Array

    @classmethod
    def build(cls, boxes: AABB, *, method: str = "median", leaf_size: int = 4) -> SphereTree:  # fmt: skip
        """A tree of spheres over finite boxes of batch (n,), its splits as ``BVH.build`` has them.

        Raises:
            ValueError: as ``BVH.build``; coordinates beyond 1e100 m.
        """
        from course.detection.sphere_loops import fit_spheres

        tree = BVH.build(boxes, method=method, leaf_size=leaf_size)
        bounds = bounds_of(boxes)
        if size_of(bounds) >= HUGE:
            raise failure("boxes", f"coordinates below {HUGE:g}", written(size_of(bounds)))  # fmt: skip
        spheres = fit_spheres(bounds, tree.reach, tree.order, tree.right, tree.ranges)
        spheres.setflags(write=False)
        return cls(tree, spheres)

    @property
    def volumes(self) -> Sphere:
        """The spheres of the nodes, of batch (nodes,)."""
        return Sphere(self.spheres[:, :3], self.spheres[:, 3])

    def pairs(self) -> IntArray:
        """The pairs of the boxes, as ``sphere_tree`` gives them."""
        from course.detection.pair_loops import sorted_pairs

        return sorted_pairs(self._walked()[0], self.tree.boxes.count)

    def tests(self) -> int:
        """How often ``pairs`` asks whether two spheres overlap."""
        return int(self._walked()[1])

    def _walked(self) -> tuple[IntArray, int]:
        from course.detection.sphere_loops import sphere_pairs

        tree = (self.tree.order, self.tree.right, self.tree.ranges)
        return sphere_pairs(bounds_of(self.tree.boxes), self.spheres, *tree)
