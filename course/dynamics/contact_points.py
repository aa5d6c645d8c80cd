"""What dynamics reads of contacts, which live in a room it does not import."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from course.arrays import Array, IntArray


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
    def require_bodies(self, count: int) -> None: ...
