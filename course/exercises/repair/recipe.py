"""An answer as source that can be run elsewhere; an expression in SymPy's symbols becomes a function of numbers."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from course.exercises.repair.places import Code, name_of_call

#: SymPy's functions by their names, for numbers.
NUMERIC = """\
import numpy as np
class sp:
    sqrt, sin, cos, tan, exp, log, Abs, pi = np.sqrt, np.sin, np.cos, np.tan, np.exp, np.log, np.abs, np.pi
    Rational = staticmethod(lambda a, b=1: a / b)
    S = Integer = Float = nsimplify = simplify = expand = factor = together = staticmethod(lambda a: a)
sympy = sp
sqrt, sin, cos, tan, pi, exp, Rational, S = sp.sqrt, sp.sin, sp.cos, sp.tan, sp.pi, sp.exp, sp.Rational, sp.S
"""


@dataclass(frozen=True)
class Recipe:
    """An answer as source: what to run first, the values of names, and whether it works element by element."""

    source: str
    prelude: str = ""
    values: Mapping[str, Any] = field(default_factory=dict)
    elementwise: bool = False


def expression_recipe(cell: str, name: str, arguments: Sequence[str]) -> Recipe | None:
    """The cell's assignments up to that of ``name`` as a function of numbers; None where there is no such one."""
    code = Code(cell)
    lines = []
    for statement in code.tree.body:
        if not isinstance(statement, ast.Assign) or _makes_symbols(statement.value):
            continue
        target = statement.targets[0]
        if not isinstance(target, ast.Name):
            continue
        text = code.text(statement.value)  # in brackets where it goes over lines
        whole = f"(\n{text}\n)" if "\n" in text else text
        lines.append(f"{target.id} = {whole}")
        if target.id == name:
            body = "\n    ".join([*lines, f"return {name}"])
            source = f"def {name}({', '.join(arguments)}):\n    {body}\n"
            return Recipe(source, NUMERIC, elementwise=True)
    return None


def _makes_symbols(value: ast.expr) -> bool:
    return name_of_call(value) in ("symbols", "Symbol", "Function", "var")
