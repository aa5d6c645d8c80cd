"""The collision world: who is in it (members, shelves), what finds their contacts (phases), what it
remembers (coherence) and says of itself (counters), what else it is asked (queries).
"""

from course.detection.world.collision_world import CollisionWorld
from course.detection.world.counters import Counters, Phase

__all__ = ["CollisionWorld", "Counters", "Phase"]
