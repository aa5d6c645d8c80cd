"""What an answer is asked: nothing in it shows what is right."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any


@dataclass(frozen=True)
class Question:
    """An exercise as whoever answers it sees it: the answer's name and kind, the declared arguments, how many results,
    the arguments of every case. ``most`` is how many numbers each case may give at most, ``index`` the exercise's place
    in its lesson; both are for answers that are given in another process."""

    name: str
    kind: str
    arguments: tuple[str, ...]
    results: int
    cases: tuple[Mapping[str, Any], ...]
    most: tuple[int, ...] = ()
    index: int = 0

    def as_plain(self) -> dict[str, Any]:
        """The question as values that can be sent (``course.sandbox.wire``)."""
        plain = {field.name: getattr(self, field.name) for field in fields(self)}
        return {**plain, "cases": tuple(dict(case) for case in self.cases)}
