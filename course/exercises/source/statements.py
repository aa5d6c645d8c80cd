"""Statements of a syntax tree: what a cell defines, and what it leaves blank."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from course.exercises.source.parsing import UNREADABLE, tree_of

#: A function may be defined in one, and is there afterwards.
BLOCKS = (ast.If, ast.For, ast.While, ast.With, ast.Try, ast.Match)


def is_blank(source: str, name: str) -> bool:
    """Whether a cell's source leaves ``name`` blank, without running it.

    The last binding counts. A blank is ``name = ...``, or a function that sets a name
    of its own to ``...``, or one with a bare ``...`` that returns nothing else. A
    ``...`` left beside an answer that does return is not a blank, nor is one in an
    index, a type annotation, a string or an inner function.
    """
    tree = tree_of(source)
    if tree is None:
        return False
    blank = False
    for node in all_statements(tree.body):
        if is_function(node) and node.name == name:  # type: ignore[attr-defined]
            own = list(all_statements(node.body))  # type: ignore[attr-defined]
            holes = [s for s in own if is_hole(s)]
            answers = any(
                isinstance(s, ast.Return) and s.value is not None and s not in holes
                for s in own
            )
            blank = any(isinstance(s, (ast.Assign, ast.AnnAssign)) for s in holes)
            blank = blank or bool(holes and not answers)
        elif isinstance(node, (ast.Assign, ast.AnnAssign)) and name in _targets(node):
            blank = is_hole(node)
    return blank


def is_left_blank(source: str) -> bool:
    """Whether a cell without the required name is the lesson's blank.

    It is nothing but ``...``, or a blank under another name.
    """
    tree = tree_of(source)
    if tree is None:
        return False
    names = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
    for node in tree.body:
        if isinstance(node, ast.Assign):
            names |= {t.id for t in node.targets if isinstance(t, ast.Name)}
        elif isinstance(node, ast.Expr) and is_hole(node):
            return True
    return any(is_blank(source, name) for name in names)


def defined_in(tree: ast.Module) -> tuple[str, ...]:
    """The names that a cell defines at its top level; ``f = use(f)`` defines none."""
    names: list[str] = []
    for node in tree.body:
        if isinstance(node, BLOCKS):
            names += [n.name for n in all_statements([node]) if is_function(n)]  # type: ignore[attr-defined]
        elif isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            names.append(node.name)
        elif isinstance(node, (ast.Assign, ast.AnnAssign)) and not is_use(node.value):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            parts = [p for t in targets for p in (_parts(t))]
            names += [p.id for p in parts if isinstance(p, ast.Name)]
    return tuple(names)


def definitions_in(source: str, tree: ast.Module) -> str:
    """The source of a cell's definitions alone."""
    wanted = (
        ast.FunctionDef,
        ast.ClassDef,
        ast.Import,
        ast.ImportFrom,
        ast.Assign,
        ast.AnnAssign,
    )
    if all(isinstance(node, wanted) for node in tree.body):
        return source
    try:
        return "\n\n".join(ast.unparse(n) for n in tree.body if isinstance(n, wanted))
    except UNREADABLE:
        return ""


def all_statements(body: Sequence[ast.AST]) -> Iterator[ast.AST]:
    """Every statement in source order, those in blocks too, those of inner functions
    not.

    It keeps its own stack: a thousand ``elif`` nest a thousand blocks.
    """
    waiting = list(reversed(body))
    while waiting:
        node = waiting.pop()
        yield node
        if not is_function(node) and not isinstance(node, ast.ClassDef):
            for block in ("cases", "finalbody", "orelse", "handlers", "body"):
                waiting += reversed(getattr(node, block, []))


def is_function(node: ast.AST) -> bool:
    """Whether a node defines a function."""
    return isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))


def is_hole(node: ast.AST) -> bool:
    """Whether a statement is ``...``, alone, given a name or returned."""
    value = getattr(node, "value", None)
    is_statement = isinstance(node, (ast.Expr, ast.Assign, ast.AnnAssign, ast.Return))
    return is_statement and isinstance(value, ast.Constant) and value.value is Ellipsis


def _targets(node: ast.Assign | ast.AnnAssign) -> list[str]:
    targets = node.targets if isinstance(node, ast.Assign) else [node.target]
    return [t.id for t in targets if isinstance(t, ast.Name)]


def _parts(target: ast.expr) -> list[ast.expr]:
    return target.elts if isinstance(target, (ast.Tuple, ast.List)) else [target]


def is_use(value: ast.expr | None) -> bool:
    """Whether a value is what ``use`` gives."""
    return (
        isinstance(value, ast.Call)
        and isinstance(value.func, ast.Name)
        and value.func.id == "use"
    )
