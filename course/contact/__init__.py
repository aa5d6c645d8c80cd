"""What contact does to bodies: collisions at an instant."""

from course.contact.collisions import CollisionsUnresolved, resolve_collisions

__all__ = ["CollisionsUnresolved", "resolve_collisions"]
