"""What contact does to bodies: collisions at an instant, and the forces of resting contact."""

from course.contact.collisions import CollisionsUnresolved, resolve_collisions
from course.contact.contact_system import ContactSystem, contact_system, contact_wrench
from course.contact.separation import (
    normal_rate,
    resting,
    separation,
    separation_acceleration,
    separation_acceleration_terms,
    separation_rate,
)
from course.contact.solution import ContactSolution, NoContactForce, NotConverged
from course.contact.solve import solve

__all__ = [
    "CollisionsUnresolved",
    "ContactSolution",
    "ContactSystem",
    "NoContactForce",
    "NotConverged",
    "contact_system",
    "contact_wrench",
    "normal_rate",
    "resolve_collisions",
    "resting",
    "separation",
    "separation_acceleration",
    "separation_acceleration_terms",
    "separation_rate",
    "solve",
]
