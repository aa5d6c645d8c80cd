"""Which of a notebook's cells an answer needs, told from their source without running them.

A cell that no name leads to is left out: its loop without end then costs its own exercise alone, and a picture in it
costs nothing.
"""

from __future__ import annotations

import ast
import symtable
import warnings
from collections.abc import Sequence

DYNAMIC = frozenset(
    {"globals", "locals", "vars", "eval", "exec", "__import__", "get_ipython"}
)


def needed_cells(sources: Sequence[str], wanted: str) -> tuple[int, ...]:
    """The indices of the cells that ``wanted`` needs, straight or by way of others.

    Names are all that is looked at. Where they cannot tell (``eval``, ``from x import *``) a cell is kept.
    """
    names = [names_of(source) for source in sources]
    bound_here, used = names_of(wanted)
    if used & DYNAMIC:
        return tuple(range(len(sources)))
    kept: set[int] = {i for i, (bound, _) in enumerate(names) if "*" in bound}
    used = used.union(*(names[i][1] for i in kept))
    while True:
        more = {
            i for i, (bound, _) in enumerate(names) if i not in kept and bound & used
        }
        if not more:
            return tuple(sorted(kept))
        kept |= more
        used = used.union(*(names[i][1] for i in more))


def names_of(source: str) -> tuple[frozenset[str], frozenset[str]]:
    """The names a cell binds in the notebook's namespace, and those it takes from there; none if it is not Python."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(source)
            table = symtable.symtable(source, "<cell>", "exec")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return frozenset(), frozenset()
    bound = {"*"} if any(map(_imports_everything, ast.walk(tree))) else set()
    used = {name for node in ast.walk(tree) for name in _added_to(node)}
    tables = [table]
    while tables:
        part = tables.pop()
        tables += part.get_children()
        top = part.get_type() == "module"
        for symbol in part.get_symbols():
            if not top and not symbol.is_global():
                continue
            if symbol.is_assigned() or symbol.is_imported():
                bound.add(symbol.get_name())
            if symbol.is_referenced():
                used.add(symbol.get_name())
    return frozenset(bound), frozenset(used)


def modules_used(
    preamble: Sequence[str], answers: Sequence[str], among: frozenset[str]
) -> tuple[str, ...]:
    """Which of these packages the answers' cells use: they import one, or take a name that an import cell bound.

    What merely stands in an import cell does not count.
    """
    bound = {
        name: package
        for source in (*preamble, *answers)
        for name, package in _packages(source)
    }
    used = {package for source in answers for _, package in _packages(source)}
    for source in answers:
        used |= {bound[name] for name in names_of(source)[1] if name in bound}
    return tuple(sorted(used & among))


def _packages(source: str) -> list[tuple[str, str]]:
    """(name bound, package it is from) of all imports in a cell."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            nodes = list(ast.walk(ast.parse(source)))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []
    pairs = []
    for node in nodes:
        if isinstance(node, ast.Import):
            pairs += [
                (a.asname or a.name.split(".")[0], a.name.split(".")[0])
                for a in node.names
            ]
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            pairs += [
                (a.asname or a.name, node.module.split(".")[0]) for a in node.names
            ]
    return pairs


def _imports_everything(node: ast.AST) -> bool:
    return isinstance(node, ast.ImportFrom) and node.names[0].name == "*"


def _added_to(node: ast.AST) -> list[str]:
    """The name in ``name += ...``, which a symbol table does not count as used."""
    return (
        [node.target.id]
        if isinstance(node, ast.AugAssign) and isinstance(node.target, ast.Name)
        else []
    )
