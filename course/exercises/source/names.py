"""What a cell defines, binds and uses, and which cells an answer needs."""

from __future__ import annotations

import ast
import re
import symtable
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from course.exercises.source.cells import python_only
from course.exercises.source.parsing import UNREADABLE, tree_of
from course.exercises.source.statements import defined_in, definitions_in, is_use

#: What reads or makes names where no source shows them.
DYNAMIC = frozenset(
    {"globals", "locals", "vars", "eval", "exec", "__import__", "get_ipython"}
)


@dataclass(frozen=True)
class Facts:
    """What a cell's source alone shows, without IPython's own lines.

    ``defines`` are the names that it defines at its top level, functions in an ``if`` or
    ``with`` there too, ``definitions`` the source of those alone that stand in none;
    ``binds`` are the names it binds in the notebook's namespace ("*" for all of a
    module), ``uses`` those it takes from there.
    """

    defines: tuple[str, ...] = ()
    definitions: str = ""
    binds: frozenset[str] = frozenset()
    uses: frozenset[str] = frozenset()
    parsed: bool = False


@lru_cache(maxsize=4096)
def facts_of(source: str) -> Facts:
    """The facts of a cell, empty if it does not parse. Cached, because parsing takes
    time.
    """
    source = python_only(source)
    tree = tree_of(source)
    if tree is None:
        return Facts()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            table = symtable.symtable(source, "<cell>", "exec")
    except UNREADABLE:  # it parses but does not compile
        return Facts(defined_in(tree), definitions_in(source, tree))
    bound, used = _names(tree, table)
    return Facts(defined_in(tree), definitions_in(source, tree), bound, used, True)


def defined_names(source: str) -> tuple[str, ...]:
    """The names of functions and variables that a cell defines at its top level.

    None if it does not parse. ``f = use(f)`` defines nothing: it is how a lesson's own
    cells call what a student wrote.
    """
    return facts_of(source).defines


def definitions_only(source: str) -> str:
    """What a cell defines (functions, classes, imports, names), without its other
    statements.
    """
    return facts_of(source).definitions


def needed_cells(sources: Sequence[str], wanted: str) -> tuple[int, ...]:
    """The indices of the cells that ``wanted`` needs, directly or through others.

    Only names are considered. Where they cannot decide (``eval``, ``from x import *``)
    a cell is kept. A cell that no name leads to is left out, so that its endless loop
    affects its own exercise alone.
    """
    used = names_of(wanted)[1]
    return tuple(range(len(sources))) if used & DYNAMIC else closure(sources, used)


def closure(sources: Sequence[str], used: frozenset[str]) -> tuple[int, ...]:
    """The indices of the cells that bind one of these names, or one that such a cell uses, and so on."""
    names = [names_of(source) for source in sources]
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
    """The names a cell binds in the notebook's namespace, and those it takes from
    there.

    Both empty if it is not Python.
    """
    told = facts_of(source)
    return told.binds, told.uses


def _names(
    tree: ast.Module, table: symtable.SymbolTable
) -> tuple[frozenset[str], frozenset[str]]:
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


def mentions(source: str, name: str) -> bool:
    """Whether a cell may make ``name``, or have something checked under it, by other ways than defining it.

    It binds it (in a block, as a class, ``global`` in a function, an import), names an attribute or a method so, or
    says it in a text: ``check(f, "name")``, ``globals()["name"]``, ``exec``. One that does not parse is taken at its
    word.
    """
    if name not in source:
        return False
    facts = facts_of(source)
    if not facts.parsed or name in facts.binds - _only_used(source):
        return True
    tree = tree_of(python_only(source))
    return any(_says(node, name) for node in ast.walk(tree)) if tree else True


def _says(node: ast.AST, name: str) -> bool:
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value == name or name in re.findall(r"\w+(?=\s*[=(])", node.value)
    if isinstance(node, ast.Attribute):
        return node.attr == name
    inner = isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef))
    return inner and node.name == name  # type: ignore[attr-defined]


def _only_used(source: str) -> frozenset[str]:
    """The names that a cell binds by ``f = use(f)`` alone, as a lesson's own cells do."""
    tree = tree_of(python_only(source))
    body = tree.body if tree else []
    used = [n for n in body if isinstance(n, ast.Assign) and is_use(n.value)]
    names = {t.id for n in used for t in n.targets if isinstance(t, ast.Name)}
    return frozenset(names.difference(facts_of(source).defines))


def modules_used(
    preamble: Sequence[str], answers: Sequence[str], among: frozenset[str]
) -> tuple[str, ...]:
    """Which of these packages the answers' cells use.

    They import one, or use a name that an import cell bound. An import that no answer
    uses does not count.
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
    """(name bound, its package) for all imports in a cell."""
    tree = tree_of(source)
    pairs = []
    for node in ast.walk(tree) if tree else ():
        if isinstance(node, ast.Import):
            pairs += [
                (a.asname or a.name.split(".")[0], a.name.split(".")[0])
                for a in node.names
            ]
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            top = node.module.split(".")[0]
            pairs += [(a.asname or a.name, top) for a in node.names]
    return pairs


def _imports_everything(node: ast.AST) -> bool:
    return isinstance(node, ast.ImportFrom) and node.names[0].name == "*"


def _added_to(node: ast.AST) -> list[str]:
    """The name in ``name += ...``, which a symbol table does not count as used."""
    is_name = isinstance(node, ast.AugAssign) and isinstance(node.target, ast.Name)
    return [node.target.id] if is_name else []  # type: ignore[attr-defined]
