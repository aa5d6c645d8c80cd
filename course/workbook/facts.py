"""What can be said of a wrong answer's source because it is so, whatever the cause may be."""

from __future__ import annotations

import ast
import dis
import inspect
import linecache
import sys
import textwrap
from collections.abc import Callable, Iterator, Mapping
from types import CodeType, FrameType
from typing import Any

import numpy as np

from course.exercises.answer import call
from course.exercises.definition import Exercise
from course.exercises.verdict import Verdict

#: Functions that make one of many, along an axis or of all there is.
OVER_AXES = frozenset("sum mean prod max min norm cumsum cumprod any all".split())
#: With these a name is read without standing in the source.
HIDDEN = frozenset("locals vars eval exec".split())


def facts_told(
    exercise: Exercise, answer: Any, verdict: Verdict
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """What is told before the reasons of a verdict, and what after them: a line each."""
    if verdict.mistake is not None or verdict.case is None:
        return (), ()
    before = (*_of_borrowed(answer), *_of_unused(exercise, answer))
    after: tuple[str, ...] = ()
    if any(r.startswith("Right for one") for r in verdict.reason):
        after = _of_missing_axes(answer)
    fault = verdict.difference.fault if verdict.difference else ""
    if fault.startswith("NaN") and verdict.case is not None:
        after += _of_the_first_nan(answer, verdict.case.arguments)
    return before, after


def _of_borrowed(answer: Any) -> tuple[str, ...]:
    names = borrowed_variables(answer, helpers=True)
    if not names:
        return ()
    kind = (
        "variables of the notebook" if len(names) > 1 else "a variable of the notebook"
    )
    said = f"It takes {', '.join(names)}, {kind} and no argument: another cell can change what it gives."
    return (said,)


def borrowed_variables(answer: Any, *, helpers: bool = False) -> tuple[str, ...]:
    """The notebook's variables (numbers, arrays, symbols; no functions, classes, modules) that a function reads.

    With ``helpers`` those too that the notebook's functions read which it calls.
    """
    waiting, seen, names = [answer], set(), dict[str, None]()
    while waiting:
        function = waiting.pop()
        if not inspect.isfunction(function) or function in seen:
            continue
        seen.add(function)
        for name in _global_names(function.__code__):
            value = function.__globals__.get(name)
            if inspect.isfunction(value) and value.__module__ == answer.__module__:
                waiting += [value] if helpers else []
            elif name in function.__globals__ and _is_data(value):
                names[name] = None
    return tuple(names)


def _global_names(code: CodeType) -> Iterator[str]:
    steps = dis.get_instructions(code)
    yield from (s.argval for s in steps if s.opname == "LOAD_GLOBAL")
    for inner in code.co_consts:
        if inspect.iscode(inner):
            yield from _global_names(inner)


def _is_data(value: Any) -> bool:
    """Whether it is a value and no constant that is imported: SymPy's symbols are callable too."""
    if inspect.ismodule(value) or inspect.isclass(value) or value is None:
        return False
    if isinstance(value, float) and value in (np.pi, 2 * np.pi, np.inf):
        return False
    return not callable(value) or hasattr(value, "free_symbols")


def _of_unused(exercise: Exercise, answer: Any) -> tuple[str, ...]:
    if exercise.kind == "expression":
        lacking = lacking_symbols(exercise, answer)
        verb = "does not occur in it" if len(lacking) == 1 else "do not occur in it"
        return (f"{_listed(lacking)} {verb}.",) if lacking else ()
    unused = unused_arguments(answer)
    return (f"It never uses {_listed(unused)}.",) if unused else ()


def _listed(names: tuple[str, ...]) -> str:
    return " and ".join([", ".join(names[:-1]), names[-1]] if names[1:] else names)


def unused_arguments(answer: Any) -> tuple[str, ...]:
    """The arguments of a function that its source never reads."""
    function = function_node(answer)
    if function is None or function.args.vararg or function.args.kwarg:
        return ()
    read = {
        n.id
        for n in ast.walk(function)
        if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load)
    }
    read |= {
        n.target.id
        for n in ast.walk(function)
        if isinstance(n, ast.AugAssign) and isinstance(n.target, ast.Name)
    }
    if read & HIDDEN:
        return ()
    return tuple(a.arg for a in function.args.args if a.arg not in read)


def lacking_symbols(exercise: Exercise, answer: Any) -> tuple[str, ...]:
    """The symbols of the right expression that are not in the answer."""
    import sympy

    names = [a.name for a in exercise.arguments]
    right = exercise.reference(*map(sympy.Symbol, names))
    wanted = {str(s) for s in right.free_symbols}
    there = {str(s) for s in getattr(answer, "free_symbols", ())}
    return tuple(n for n in names if n in wanted - there)


def _of_missing_axes(answer: Any) -> tuple[str, ...]:
    """The calls that make one of many and say no axis, told where the answer is right for one and wrong for many."""
    function = function_node(answer)
    calls = [n for n in ast.walk(function) if _lacks_axis(n)] if function else []
    if not calls:
        return ()
    told = ", ".join(dict.fromkeys(ast.unparse(c) for c in calls))
    which = "has no axis" if len(calls) == 1 else "have no axis"
    return (
        f"{told} {which}: of an array with a batch's axes in front that would take all members together.",
    )


def _lacks_axis(node: ast.AST) -> bool:
    if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Attribute):
        return False
    of_numpy = ast.unparse(node.func.value) in ("np", "numpy", "np.linalg", "linalg")
    given = len(node.args) - of_numpy
    axis = any(k.arg in ("axis", None) for k in node.keywords)
    return node.func.attr in OVER_AXES and given == 0 and not axis


def _of_the_first_nan(answer: Any, arguments: Mapping[str, Any]) -> tuple[str, ...]:
    line = first_nan(answer, arguments) if inspect.isfunction(answer) else ""
    return (f"The first NaN is there after the line  {line}",) if line else ()


def first_nan(function: Callable[..., Any], arguments: Mapping[str, Any]) -> str:
    """The line of a function after which a NaN is there first; empty where none is seen, or a debugger looks on."""
    if sys.gettrace() is not None:
        return ""
    file, found, last = function.__code__.co_filename, list[int](), dict[int, int]()

    def look(frame: FrameType, event: str, value: Any) -> Any:
        if frame.f_code.co_filename != file:
            return None
        held = [*frame.f_locals.values(), *([value] if event == "return" else [])]
        if not found and id(frame) in last and any(map(_has_nan, held)):
            found.append(last[id(frame)])
        last[id(frame)] = frame.f_lineno
        return look

    sys.settrace(look)
    try:
        call(function, arguments, 1)
    finally:
        sys.settrace(None)
    return linecache.getline(file, found[0]).strip() if found else ""


def _has_nan(value: Any) -> bool:
    if isinstance(value, (tuple, list)):
        return any(map(_has_nan, value))
    if isinstance(value, np.ndarray) and value.dtype.kind == "f":
        return bool(np.isnan(value).any())
    return isinstance(value, (float, np.floating)) and bool(np.isnan(value))


def function_node(answer: Any) -> ast.FunctionDef | None:
    """The syntax tree of a function's source; None where there is none, as of a lambda."""
    try:
        tree = ast.parse(textwrap.dedent(inspect.getsource(answer)))
    except (OSError, TypeError, SyntaxError, ValueError):
        return None
    first = tree.body[0] if tree.body else None
    return first if isinstance(first, ast.FunctionDef) else None
