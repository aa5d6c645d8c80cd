"""What dynamics reads of contacts, and the check that their bodies exist."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from course.arrays import Array, IntArray, indices
from course.dynamics.bodies import Bodies


class ContactPoints(Protocol):
    """The part of contacts that an impulse needs.

    ``course.overlap.Contacts`` has it.
    """

    @property
    def body_a(self) -> IntArray: ...
    @property
    def body_b(self) -> IntArray: ...
    @property
    def normal(self) -> Array: ...
    @property
    def sides(self) -> Sequence[tuple[IntArray, Array, float]]: ...


def require_body_indices(contacts: ContactPoints, bodies: Bodies) -> None:
    """Refuse contacts with a body that is not among these.

    Raises:
        ValueError: names ``contacts.body_a`` or ``contacts.body_b``, the largest
            index that exists, and the first entry beyond it.
    """
    indices("contacts.body_a", contacts.body_a, len(bodies))
    indices("contacts.body_b", contacts.body_b, len(bodies))
