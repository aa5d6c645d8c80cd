"""What contact does to bodies: collisions at an instant, and the forces of resting contact."""

from course.contact.assembly import (
    contact_jacobian,
    contact_system,
    contact_wrench,
    inverse_mass_matrix,
)
from course.contact.collisions import CollisionsUnresolved, resolve_collisions
from course.contact.gaps import (
    normal_rate,
    resting,
    separation,
    separation_acceleration,
    separation_acceleration_terms,
    separation_rate,
)
from course.contact.solution import ContactSolution, NoContactForce, NotConverged
from course.contact.solving import solve
from course.contact.systems import ContactSystem

__all__ = [
    "CollisionsUnresolved",
    "ContactSolution",
    "ContactSystem",
    "NoContactForce",
    "NotConverged",
    "contact_jacobian",
    "contact_system",
    "contact_wrench",
    "inverse_mass_matrix",
    "normal_rate",
    "resolve_collisions",
    "resting",
    "separation",
    "separation_acceleration",
    "separation_acceleration_terms",
    "separation_rate",
    "solve",
]
