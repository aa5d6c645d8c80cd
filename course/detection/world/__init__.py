"""The collision world: who is in it (members, shelves), what finds their contacts (phases), what it
remembers (coherence) and says of itself (counters), what else it is asked (queries and rays; first_hits and flights).
"""

from course.detection.world.collision_world import CollisionWorld
from course.detection.world.counters import Counters, Phase
from course.detection.world.first_hits import FirstHit
from course.detection.world.queries import Nearest, RayHits

__all__ = ["CollisionWorld", "Counters", "FirstHit", "Nearest", "Phase", "RayHits"]
