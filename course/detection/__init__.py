"""Which of many boxes overlap: the broad phases, each the same question answered another way; and the
world of colliders, which says where they touch."""

from course.detection.brute_force import all_pairs
from course.detection.choosing import broad_phase, method_for
from course.detection.grid import uniform_grid
from course.detection.hierarchy import BVH, bvh
from course.detection.partitions import Partition, bsp_tree, kd_tree
from course.detection.spheres import SphereTree, sphere_tree
from course.detection.sweeping import CoherentSweep, sweep_and_prune
from course.detection.world import CollisionWorld, Counters

__all__ = [
    "BVH",
    "CoherentSweep",
    "CollisionWorld",
    "Counters",
    "Partition",
    "SphereTree",
    "all_pairs",
    "broad_phase",
    "bsp_tree",
    "bvh",
    "kd_tree",
    "method_for",
    "sphere_tree",
    "sweep_and_prune",
    "uniform_grid",
]
