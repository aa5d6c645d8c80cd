"""Whether an answer leans on what is not here: a command's output, what somebody typed, a file, a package."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import CodeType
from typing import Any

from course.exercises.source import DYNAMIC, closure, facts_of
from course.sandbox.attempts import IN_THE_ANSWER


def leans_on(
    value: Any, name: str, sources: Mapping[int, str], unlike: Mapping[int, str]
) -> str:
    """What is not here of what the answer called ``name`` may need; "" where it needs nothing of it.

    ``sources`` are the cells, ``unlike`` what each of them wanted in vain. Only names are considered; a cell that may
    bind any name counts.
    """
    if not unlike:
        return ""
    if IN_THE_ANSWER in unlike:
        return unlike[IN_THE_ANSWER]
    places = list(sources)
    wanted = frozenset({name, str(getattr(value, "__name__", name)), *_globals_of(value)})  # fmt: skip
    needed = {places[i] for i in closure([sources[p] for p in places], wanted)}
    for place, what in unlike.items():
        facts = facts_of(sources.get(place, ""))
        if place in needed or not facts.parsed or facts.uses & DYNAMIC:
            return what
    return ""


def _globals_of(value: Any) -> Iterator[str]:
    """The names that a function takes from its notebook, or from its values."""
    codes = [getattr(value, "__code__", None)]
    while codes:
        code = codes.pop()
        if isinstance(code, CodeType):
            yield from code.co_names
            codes += code.co_consts
