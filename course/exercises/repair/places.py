"""Where a source can be changed: its expressions and statements with their text, and the names in scope."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property

from course.exercises.source import tree_of

Patch = tuple[int, int, str]
#: What needs no brackets inside another expression.
CLOSED = (ast.Name, ast.Constant, ast.Call, ast.Attribute, ast.Subscript, ast.List)
#: Calls whose arguments are sizes or counts: no quantity of the exercise stands there.
SIZES = frozenset(
    "range zeros ones empty zeros_like ones_like empty_like full eye arange len reshape Variable Minimize "
    "Problem solve_ enumerate zip reversed list "
    "append remove pop asarray array isinstance print".split()
)


@dataclass(frozen=True)
class Edit:
    """One change of a source: its kind in words, where in the order it is tried, its patches and its line."""

    kind: str
    stage: int
    patches: tuple[Patch, ...]
    line: int

    def applied(self, source: str) -> str:
        """The source with the change made."""
        return patched(source, self.patches)


def patched(source: str, patches: tuple[Patch, ...]) -> str:
    """A source with pieces of it replaced; the patches do not overlap."""
    for start, end, text in sorted(patches, reverse=True):
        source = source[:start] + text + source[end:]
    return source


@dataclass(frozen=True)
class Place:
    """An expression, what it stands in, and the names that can be read there."""

    node: ast.expr
    parent: ast.AST
    role: str
    scope: tuple[str, ...]


@dataclass
class Code:
    """A source, read once. ``axes`` are how many axes the names have in a single case, as far as is known."""

    source: str
    axes: dict[str, int] = field(default_factory=dict)

    @cached_property
    def tree(self) -> ast.Module:
        """Its syntax tree; empty where it does not parse."""
        return tree_of(self.source) or ast.Module([], [])

    @cached_property
    def _lines(self) -> list[tuple[int, str]]:
        starts, at = [], 0
        for line in self.source.splitlines(keepends=True):
            starts.append((at, line))
            at += len(line)
        return [*starts, (at, "")]

    def _offset(self, line: int, column: int) -> int:
        start, text = self._lines[line - 1]
        if not text.isascii():  # the tree counts bytes
            column = len(text.encode()[:column].decode(errors="replace"))
        return start + column

    def span(self, node: ast.expr | ast.stmt) -> tuple[int, int]:
        """Where a node begins and ends in the source."""
        return (
            self._offset(node.lineno, node.col_offset),
            self._offset(node.end_lineno or node.lineno, node.end_col_offset or 0),
        )

    def text(self, node: ast.expr | ast.stmt) -> str:
        """The source of a node."""
        start, end = self.span(node)
        return self.source[start:end]

    def closed(self, node: ast.expr) -> str:
        """The source of an expression, in brackets where another could pull it apart."""
        text = self.text(node)
        return text if isinstance(node, CLOSED) else f"({text})"

    def line(self, number: int) -> str:
        """A line of the source without its margin."""
        return self._lines[number - 1][1].strip() if number else ""

    @cached_property
    def running(self) -> frozenset[str]:
        """The names that begin as a number written in the source, or change in place."""
        names = set()
        for node in ast.walk(self.tree):
            if isinstance(node, ast.AugAssign) and isinstance(node.target, ast.Name):
                names.add(node.target.id)
            elif isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant):
                names |= {t.id for t in node.targets if isinstance(t, ast.Name)}
        return frozenset(names)

    @cached_property
    def terms_counted(self) -> frozenset[ast.Constant]:
        """The numbers above 9 that say how many terms a sum written out in one expression has."""
        loops = [
            n.iter for n in ast.walk(self.tree) if isinstance(n, ast.comprehension)
        ]
        numbers = [n for i in loops for n in ast.walk(i) if isinstance(n, ast.Constant)]
        return frozenset(n for n in numbers if type(n.value) is int and n.value > 9)

    @cached_property
    def functions(self) -> list[ast.FunctionDef]:
        """The functions at the top of the source; inner ones are parts of theirs."""
        return [n for n in self.tree.body if isinstance(n, ast.FunctionDef)]

    def places(self) -> Iterator[Place]:
        """Every expression that can be replaced by another."""
        for function in self.functions:
            scope = scope_of(function)
            for statement in function.body:
                yield from _below(statement, scope)

    def blocks(self) -> Iterator[list[ast.stmt]]:
        """Every list of statements inside the functions."""
        for function in self.functions:
            for node in ast.walk(function):
                for name in ("body", "orelse"):
                    block = getattr(node, name, None)
                    if isinstance(block, list) and block:
                        yield block


def scope_of(function: ast.FunctionDef) -> tuple[str, ...]:
    """The names of a function's own: its arguments and what it binds, in the order of the source."""
    names = dict[str, None]()
    for node in ast.walk(function):
        if isinstance(node, ast.arg):
            names[node.arg] = None
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            names[node.id] = None
    return tuple(names)


def _below(node: ast.AST, scope: tuple[str, ...]) -> Iterator[Place]:
    for role, value in ast.iter_fields(node):
        for child in value if isinstance(value, list) else [value]:
            if not isinstance(child, ast.AST):
                continue
            if isinstance(child, (ast.JoinedStr, ast.arguments)):
                continue
            callee = isinstance(node, ast.Call) and role == "func"
            stored = isinstance(getattr(child, "ctx", None), (ast.Store, ast.Del))
            skipped = (ast.Slice, ast.Starred, ast.GeneratorExp)
            if isinstance(child, ast.expr) and not callee and not stored:
                if not isinstance(child, skipped) and role != "annotation":
                    yield Place(child, node, role, scope)
            yield from _below(child, scope)


def name_of_call(node: ast.AST) -> str:
    """The last name of what is called; empty for anything else."""
    if not isinstance(node, ast.Call):
        return ""
    if isinstance(node.func, ast.Attribute):
        return node.func.attr
    return node.func.id if isinstance(node.func, ast.Name) else ""


def is_quantity(place: Place) -> bool:
    """Whether a quantity stands here: no index, size, keyword, text, and not several (*both)."""
    parent, role = place.parent, place.role
    if isinstance(place.node, ast.Starred):
        return False
    if isinstance(parent, ast.Call):
        return role == "args" and name_of_call(parent) not in SIZES
    if isinstance(parent, (ast.Assign, ast.AugAssign, ast.Return)):
        return role == "value"
    if isinstance(parent, ast.IfExp):
        return role != "test"
    if isinstance(parent, ast.Subscript):
        return False
    if isinstance(parent, ast.Compare):
        return True
    return isinstance(parent, (ast.BinOp, ast.UnaryOp, ast.Tuple, ast.List, ast.Lambda))
