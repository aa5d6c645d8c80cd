"""Planted mistakes as single edits of a formula's source."""

from __future__ import annotations

import linecache
import sys
from collections.abc import Callable
from types import FunctionType
from typing import Any

from course.exercises.formula_source import signature_and_code


def slip(formula: Callable[..., Any], *edits: str) -> Callable[..., Any]:
    """The formula with one edit of its code, slip(formula, old, new).

    ``old`` is replaced by ``new``; further pairs are further edits, each made after
    those before it. The docstring is left as it is. The result is a function like any
    other: its source can be read, so it may be given to ``slip`` again, and an error in
    it shows its lines.

    Args:
        formula: a function of ``course.formulas``, or a slip of one.
        edits: old and new in turn; each old one occurs exactly once in the code.
    Raises:
        ValueError: an old text that does not occur once, or a new one equal to it.
        SyntaxError: the changed text is no Python.
    Example:
        >>> from course import formulas
        >>> slip(formulas.p_hat, "1 + e", "1 - e")(1.0, 1.0, -1.0, 1.0, 1.0)
        0.0
    """
    name = formula.__name__
    head, code = signature_and_code(formula)
    if not edits or len(edits) % 2:
        raise ValueError(
            f"edits: expected pairs of old and new; got {len(edits)} texts"
        )
    for old, new in zip(edits[::2], edits[1::2], strict=True):
        code = _edited(code, old, new, name)
    text, told = head + code, " -> ".join(" ".join(edit.split()) for edit in edits)
    file = f"<slip of {name}: {told}>"
    linecache.cache[file] = (len(text), None, text.splitlines(keepends=True), file)
    made: dict[str, Any] = {}
    exec(compile(text, file, "exec"), vars(sys.modules[formula.__module__]), made)
    changed = made[name]
    assert isinstance(changed, FunctionType)
    return changed


def _edited(code: str, old: str, new: str, name: str) -> str:
    if code.count(old) != 1:
        raise ValueError(
            f"old: expected a text that occurs once in {name}; got {old!r}, which "
            f"occurs {code.count(old)} times"
        )
    if new == old:
        raise ValueError(f"new: expected another text than old; got {new!r} for both")
    return code.replace(old, new)
