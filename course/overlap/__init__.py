"""One question asked of two shapes: do they overlap, how far apart are they, where do
they touch.
"""

from course.overlap.contact_arrays import Contacts

__all__ = ["Contacts"]
