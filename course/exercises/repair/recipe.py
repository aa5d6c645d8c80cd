"""An answer as source that can be run elsewhere; an expression in SymPy's symbols becomes a function of numbers."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from course.exercises.repair.places import Code, name_of_call
from course.exercises.source import closure, names_of, python_only, tree_of

#: Statements that bind a name and do nothing else, as a rule.
DEFINING = (
    ast.FunctionDef,
    ast.ClassDef,
    ast.Import,
    ast.ImportFrom,
    ast.Assign,
    ast.AnnAssign,
)

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


def function_recipe(cells: Sequence[str], name: str) -> Recipe | None:
    """A function out of a notebook's cells, with what it needs of their definitions; None where no cell defines it.

    Names alone decide what is needed, and nothing is run to find out.
    """
    statements: list[str] = []
    source = ""
    for cell in map(python_only, cells):
        for node in (tree_of(cell) or ast.Module([], [])).body:
            if not isinstance(node, DEFINING):
                continue
            text = _lines_of(cell, node)
            if isinstance(node, ast.FunctionDef) and node.name == name:
                source = text
            else:
                statements.append(text)
    if not source:
        return None
    needed = closure(statements, names_of(source)[1] - {name})
    return Recipe(source, "\n".join(statements[i] for i in needed))


def _lines_of(cell: str, node: ast.stmt) -> str:
    """A statement's own lines, without the margin of what it may stand in."""
    decorators = getattr(node, "decorator_list", [])
    first = min(n.lineno for n in (node, *decorators))
    return "\n".join(cell.split("\n")[first - 1 : node.end_lineno])
