"""The source of a formula, cut into what a hint, a solution cell and a slip need."""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections.abc import Callable, Sequence
from functools import cache
from typing import Any


def source_of(formula: Callable[..., Any]) -> str:
    """The function's source, dedented."""
    return textwrap.dedent(inspect.getsource(formula))


@cache
def signature_and_code(formula: Callable[..., Any]) -> tuple[str, str]:
    """The function's text up to the end of its docstring, and everything after it."""
    source = source_of(formula)
    node = _function(source)
    first = node.body[1 if ast.get_docstring(node) is not None else 0]
    lines = source.splitlines(keepends=True)
    start = _end_of_head(node, first)
    return "".join(lines[:start]), "".join(lines[start:])


def body(formula: Callable[..., Any], skipped: int = 0) -> str:
    """What a student writes: the function's code without its docstring and imports.

    Args:
        formula: a function of ``course.formulas``.
        skipped: how many statements at the start to leave out as well.
    Returns:
        Lines indented as in the function, with comments, without blank lines at the
        ends.
    """
    source = source_of(formula)
    node = _function(source)
    statements = own_statements(node.body)[skipped:]
    if not statements:
        raise ValueError(
            f"skipped: expected fewer than {formula.__name__} has; got {skipped}"
        )
    before = node.body[: node.body.index(statements[0])]
    start = max((s.end_lineno or 0 for s in before), default=statements[0].lineno - 1)
    lines = source.splitlines()[start : node.end_lineno]
    return "\n".join(lines).strip("\n")


def expression(formula: Callable[..., Any]) -> str:
    """What a formula returns that is a single expression."""
    source = source_of(formula)
    (only,) = own_statements(_function(source).body)
    assert isinstance(only, ast.Return) and only.value is not None
    return ast.get_source_segment(source, only.value) or ""


def own_statements(statements: Sequence[ast.stmt]) -> list[ast.stmt]:
    """The statements of a function without its docstring and imports."""
    kept = [s for s in statements if not isinstance(s, (ast.Import, ast.ImportFrom))]
    text = kept and isinstance(kept[0], ast.Expr) and kept[0].value
    is_docstring = isinstance(text, ast.Constant) and isinstance(text.value, str)
    return kept[1:] if is_docstring else kept


def _function(source: str) -> ast.FunctionDef:
    node = ast.parse(source).body[0]
    assert isinstance(node, ast.FunctionDef)
    return node


def _end_of_head(node: ast.FunctionDef, first: ast.stmt) -> int:
    """How many lines precede the code and its comments."""
    if first is node.body[0]:
        return first.lineno - 1
    return node.body[0].end_lineno or 0
