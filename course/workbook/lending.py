"""``use``: the student's own function where it passes its check, otherwise the reference on loan."""

from __future__ import annotations

import copy
import functools
from collections.abc import Sequence
from typing import Any

from course.exercises.definition import find_exercise
from course.workbook.judging import judge_here

MARK = "__from_use__"
_lent: list[Any] = []  # reference expressions that use() has returned


def use(answer: Any, name: str | None = None, *, symbols: Sequence[Any] = ()) -> Any:
    """Your function (or expression) if it passes its check, otherwise the reference.

    A line says which. The rest of the lesson runs on what this returns. ``check``
    refuses it, as it refuses functions of ``course``; ``use`` returns it unchanged, so
    that ``f = use(f)`` can be run twice. For an expression give its ``name`` and the
    ``symbols`` it is written in, in the exercise's order, so that the reference can be
    written in the same ones.
    """
    name = name_of(answer, name)
    _, exercise = find_exercise(name)
    lent = is_lent(answer)
    if not lent:
        refuse_lent(answer)
    yours = (
        getattr(answer, MARK, "reference") == "yours"
        if lent
        else judge_here(exercise, answer).passed
    )
    print(
        f"{name}: {'yours' if yours else 'the reference for now, until yours passes its check'}"
    )
    if lent or (yours and exercise.kind == "expression"):
        return answer
    if exercise.kind == "expression":
        if len(symbols) != len(exercise.arguments):
            wanted = ", ".join(a.name for a in exercise.arguments)
            raise ValueError(
                f"symbols: expected those for {wanted}, in this order; got {len(symbols)} of them"
            )
        # A copy: SymPy caches what it built, and a student's equal expression would be
        # the very same object.
        _lent.append(copy.copy(exercise.reference(*symbols)))
        return _lent[-1]
    chosen = answer if yours else exercise.reference

    @functools.wraps(chosen)
    def used(*args: Any, **kwargs: Any) -> Any:
        return chosen(*args, **kwargs)

    setattr(used, MARK, "yours" if yours else "reference")
    used.__name__ = name
    return used


def name_of(answer: Any, name: str | None) -> str:
    """The name of the exercise that an answer is for; raises ``ValueError`` where nothing says it."""
    if name is None:
        name = getattr(answer, "__name__", None)
    if not isinstance(name, str):
        raise ValueError(
            'name: expected the exercise\'s name for an expression, as in check(p_hat, "p_hat"); got none'
        )
    return name


def is_lent(answer: Any) -> bool:
    """Whether ``use`` returned it."""
    return hasattr(answer, MARK) or any(answer is lent for lent in _lent)


def refuse_lent(answer: Any) -> None:
    """Raise ``ValueError`` for an answer that is not the student's own."""
    module = getattr(answer, "__module__", "") or ""
    if is_lent(answer):
        raise ValueError(
            "answer: expected a function or an expression of your own; got what use() returned"
        )
    if module == "course" or module.startswith("course."):
        raise ValueError(
            f"answer: expected a function of your own; got one of {module}"
        )
