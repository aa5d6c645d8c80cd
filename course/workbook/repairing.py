"""After a verdict that names no cause: look for the one change that makes the answer right, and say where it is."""

from __future__ import annotations

import builtins
import dis
import importlib
import inspect
import sys
import textwrap
from collections.abc import Callable, Iterator
from types import CodeType
from typing import Any

import numpy as np

from course.exercises.definition import Exercise
from course.exercises.inputs import Inputs
from course.exercises.message import Message, Part
from course.exercises.repair.explanation import repair_parts
from course.exercises.repair.recipe import Recipe, expression_recipe
from course.exercises.repair.search import Repair
from course.exercises.verdict import Verdict

#: What was found, by exercise: ``hint`` shows the change.
found: dict[str, Repair] = {}


def look_for_repair(inputs: Inputs, answer: Any, verdict: Verdict) -> Message | None:
    """The message of a repair, if one is found within some seconds; an interrupt ends the search and no more."""
    from course.sandbox.repairing import (
        repair_of,  # a hundredth of a second, and seldom needed  # fmt: skip
    )

    exercise = inputs.exercise
    found.pop(exercise.name, None)
    if not verdict.unexplained:
        return None
    try:
        recipe = recipe_of(exercise, answer)
        repair = recipe and repair_of(inputs, recipe, verdict.outcomes)
    except KeyboardInterrupt:
        return None
    if not repair:
        return None
    found[exercise.name] = repair
    return repair_message(exercise.name, repair)


def repair_message(name: str, repair: Repair) -> Message:
    """Kind and line of what makes an answer right; the change itself is left to ``hint``."""
    few = "One change makes" if len(repair.steps) == 1 else "Two changes make"
    stuck = Part("stuck?", f"hint({name!r}) also shows the change")
    parts = (*repair_parts(repair), stuck)
    return Message("wrong", f"{few} {name} right", parts)


def change_parts(name: str) -> list[Part]:
    """The change that was found for an exercise's last wrong answer, for its hint."""
    repair = found.get(name)
    steps = repair.steps if repair else ()
    return [Part("the change", f"{s.old}\nbecomes\n{s.new}", "code") for s in steps]


def recipe_of(exercise: Exercise, answer: Any) -> Recipe | None:
    """The answer as source that can be run elsewhere; None where there is no such source."""
    arguments = [a.name for a in exercise.arguments]
    if exercise.kind == "expression":
        cells = (expression_recipe(c, exercise.name, arguments) for c in _cells())
        return next((recipe for recipe in cells if recipe), None)
    source = _source(answer)
    if source is None or answer.__name__ != exercise.name:
        return None
    needs = _Needs()
    return (
        Recipe(source, "\n".join(needs.lines), needs.values)
        if needs.meet(answer)
        else None
    )


def _cells() -> Iterator[str]:
    """What was run in this kernel, the last first."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    yield from reversed(shell.user_ns.get("In", []) if shell else [])


def _source(function: Any) -> str | None:
    if not inspect.isfunction(function) or function.__closure__:
        return None
    try:
        return textwrap.dedent(inspect.getsource(function))
    except (OSError, TypeError):
        return None


class _Needs:
    """What a function takes from its notebook: imports and other functions as lines, numbers and arrays as values."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.values: dict[str, Any] = {}
        self._seen: set[str] = set()

    def meet(self, function: Callable[..., Any]) -> bool:
        """Note all that the function needs; False where something cannot be taken elsewhere."""
        space = function.__globals__
        names = _global_names(function.__code__) - self._seen - set(vars(builtins))
        self._seen |= names | {function.__name__}
        return all(self._note(name, space[name]) for name in names if name in space)

    def _note(self, name: str, value: Any) -> bool:
        if inspect.ismodule(value):
            self.lines.insert(0, f"import {value.__name__} as {name}")
            return not value.__name__.startswith("course")
        if isinstance(value, (bool, int, float, str, np.generic)) or (
            isinstance(value, np.ndarray) and value.dtype.kind in "biufc"
        ):
            self.values[name] = value
            return True
        if getattr(value, "__from_use__", "") == "yours":
            value = inspect.unwrap(value)
        home, own = _home(value), getattr(value, "__name__", "")
        if home:
            self.lines.insert(0, f"from {home} import {own} as {name}")
            return not home.startswith("course")
        source = _source(value)
        if source is None or own != name or hasattr(value, "__from_use__"):
            return False
        known = self.meet(value)
        self.lines.append(source)
        return known


def _home(value: Any) -> str:
    """The module that a function or class can be imported from; empty for the notebook's own."""
    own = getattr(value, "__name__", None)
    for module in (getattr(value, "__module__", None), "numpy", "math"):
        if isinstance(own, str) and module not in (None, "__main__", "builtins"):
            try:
                if getattr(importlib.import_module(str(module)), own, None) is value:
                    return str(module)
            except ImportError:
                continue
    return ""


def _global_names(code: CodeType) -> set[str]:
    names = {s.argval for s in dis.get_instructions(code) if s.opname == "LOAD_GLOBAL"}
    inner = (c for c in code.co_consts if inspect.iscode(c))
    return names.union(*map(_global_names, inner))
