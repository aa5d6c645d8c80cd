"""Read what students wrote, without running it.

Is a cell blank, what does it define, which cells does it need? This is the one place
where a student's source is parsed. The source may be anything: if it does not parse,
for whatever reason, it is "not Python" and never an error here.
"""

from __future__ import annotations

import ast
import re
import symtable
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

#: Characters; longer cells are no answers and take seconds to parse.
MAXIMUM_CELL = 200_000
#: What Python's parser and its visitors raise for source they cannot handle.
UNREADABLE = (SyntaxError, ValueError, RecursionError, MemoryError)
DYNAMIC = frozenset(
    {"globals", "locals", "vars", "eval", "exec", "__import__", "get_ipython"}
)


def tree_of(source: str) -> ast.Module | None:
    """The syntax tree of Python source; None if it does not parse or is too long."""
    return _parsed(source)[0]


def cell_tree(source: str) -> ast.Module | None:
    """The syntax tree of a cell without IPython's own lines.

    None if it does not parse.
    """
    return tree_of(python_only(source))


def syntax_error(source: str) -> str:
    """Why a cell does not parse, in Python's words; "" if it does."""
    return _parsed(python_only(source))[1]


def _parsed(source: str) -> tuple[ast.Module | None, str]:
    """The syntax tree, or None and why there is none."""
    if len(source) > MAXIMUM_CELL:
        return None, f"{len(source)} characters are too many (limit {MAXIMUM_CELL})"
    try:
        with warnings.catch_warnings():
            # "\d" in a string is the student's business
            warnings.simplefilter("ignore")
            return ast.parse(source), ""
    except SyntaxError as error:
        return None, f"{error.msg} (line {error.lineno})"
    except UNREADABLE as error:
        return None, str(error) or type(error).__name__


def python_only(source: str) -> str:
    """The cell with IPython's own lines (%magic, !shell, name?) replaced by ``0``.

    That does nothing and is never longer; line numbers stay. A cell that is valid
    Python as it stands is left alone: a line may begin with % inside an expression or a
    string. Each line is scanned once from left to right, so that the time is linear in
    its length.
    """
    lines = source.splitlines()
    if len(source) > MAXIMUM_CELL or not any(map(_is_foreign, lines)):
        return source
    if tree_of(source) is not None:
        return source
    return "\n".join(
        f"{line[: len(line) - len(line.lstrip())]}0" if _is_foreign(line) else line
        for line in lines
    )


def _is_foreign(line: str) -> bool:
    """Whether a line is IPython's: %magic, !command, ?name, name?, name = %magic or
    !command.
    """
    line = line.strip()
    if line.startswith(("%", "!", "?")):
        return True
    if line.endswith("?"):
        return re.fullmatch(r"[\w.]+", line[:-1].removesuffix("?")) is not None
    left, equals, right = line.partition("=")
    magic = equals and right.lstrip().startswith(("%", "!"))
    return bool(magic) and re.fullmatch(r"[\w, ]+", left) is not None


@dataclass(frozen=True)
class Facts:
    """What a cell's source alone shows, without IPython's own lines.

    ``defines`` are the names that it defines at its top level, ``definitions`` the
    source of these alone; ``binds`` are the names it binds in the notebook's namespace
    ("*" for all of a module), ``uses`` those it takes from there.
    """

    defines: tuple[str, ...] = ()
    definitions: str = ""
    binds: frozenset[str] = frozenset()
    uses: frozenset[str] = frozenset()


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
        return Facts(_defined(tree), _definitions(source, tree))
    return Facts(_defined(tree), _definitions(source, tree), *_names(tree, table))


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


def _defined(tree: ast.Module) -> tuple[str, ...]:
    names: list[str] = []
    for node in tree.body:
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            names.append(node.name)
        elif isinstance(node, (ast.Assign, ast.AnnAssign)) and not _is_use(node.value):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            parts = [p for t in targets for p in (_parts(t))]
            names += [p.id for p in parts if isinstance(p, ast.Name)]
    return tuple(names)


def _definitions(source: str, tree: ast.Module) -> str:
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
    for node in _statements(tree.body):
        if _is_function(node) and node.name == name:  # type: ignore[attr-defined]
            own = list(_statements(node.body))  # type: ignore[attr-defined]
            holes = [s for s in own if _is_hole(s)]
            answers = any(
                isinstance(s, ast.Return) and s.value is not None and s not in holes
                for s in own
            )
            blank = any(isinstance(s, (ast.Assign, ast.AnnAssign)) for s in holes)
            blank = blank or bool(holes and not answers)
        elif isinstance(node, (ast.Assign, ast.AnnAssign)) and name in _targets(node):
            blank = _is_hole(node)
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
        elif isinstance(node, ast.Expr) and _is_hole(node):
            return True
    return any(is_blank(source, name) for name in names)


def needed_cells(sources: Sequence[str], wanted: str) -> tuple[int, ...]:
    """The indices of the cells that ``wanted`` needs, directly or through others.

    Only names are considered. Where they cannot decide (``eval``, ``from x import *``)
    a cell is kept. A cell that no name leads to is left out, so that its endless loop
    affects its own exercise alone.
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


def _statements(body: Sequence[ast.AST]) -> Iterator[ast.AST]:
    """Every statement in source order, those in blocks too, those of inner functions
    not.

    It keeps its own stack: a thousand ``elif`` nest a thousand blocks.
    """
    waiting = list(reversed(body))
    while waiting:
        node = waiting.pop()
        yield node
        if not _is_function(node) and not isinstance(node, ast.ClassDef):
            for block in ("cases", "finalbody", "orelse", "handlers", "body"):
                waiting += reversed(getattr(node, block, []))


def _is_function(node: ast.AST) -> bool:
    return isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))


def _is_hole(node: ast.AST) -> bool:
    value = getattr(node, "value", None)
    is_statement = isinstance(node, (ast.Expr, ast.Assign, ast.AnnAssign, ast.Return))
    return is_statement and isinstance(value, ast.Constant) and value.value is Ellipsis


def _targets(node: ast.Assign | ast.AnnAssign) -> list[str]:
    targets = node.targets if isinstance(node, ast.Assign) else [node.target]
    return [t.id for t in targets if isinstance(t, ast.Name)]


def _parts(target: ast.expr) -> list[ast.expr]:
    return target.elts if isinstance(target, (ast.Tuple, ast.List)) else [target]


def _is_use(value: ast.expr | None) -> bool:
    return (
        isinstance(value, ast.Call)
        and isinstance(value.func, ast.Name)
        and value.func.id == "use"
    )


def _imports_everything(node: ast.AST) -> bool:
    return isinstance(node, ast.ImportFrom) and node.names[0].name == "*"


def _added_to(node: ast.AST) -> list[str]:
    """The name in ``name += ...``, which a symbol table does not count as used."""
    is_name = isinstance(node, ast.AugAssign) and isinstance(node.target, ast.Name)
    return [node.target.id] if is_name else []  # type: ignore[attr-defined]
