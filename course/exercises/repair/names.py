"""Changes of a name or a number: one of two twins taken for the other, a wrong index, a number for a name."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from typing import Any

from course.exercises.repair.places import Code, Place, is_quantity, name_of_call
from course.exercises.repair.texts import Change, call_text, dot, solved, times

#: What tells the names of a pair apart: of two bodies, contacts, points, moments.
TWINS = (
    ("a", "b"),
    ("1", "2"),
    ("i", "j"),
    ("k", "l"),
    ("A", "B"),
    ("2", "3"),
    ("1", "3"),
)


def twin_names(name: str, one: str, other: str) -> str:
    """The name with its sign of one twin changed to the other's; itself where it has none."""
    return re.sub(rf"(?<=_){one}(?=_|$)|(?<=[A-Za-z]){one}$|^{one}$", other, name)


def other_name(code: Code, place: Place) -> Iterator[Change]:
    """Another name, index or number in the place of one."""
    node, scope = place.node, place.scope
    if isinstance(node, ast.Name) and node.id in scope:
        mine = code.axes.get(node.id)
        for name in scope:
            if name != node.id and (mine is None or code.axes.get(name, mine) == mine):
                yield "another name", name
        if is_quantity(place):
            yield from _other_length(code, node, scope)
    elif isinstance(node, ast.Constant) and type(node.value) in (int, float):
        yield from _other_number(code, place)
    elif isinstance(node, ast.Subscript) and isinstance(node.slice, ast.Constant):
        for index in (-1, 0, 1, 2):
            if node.slice.value != index and isinstance(node.slice.value, int):
                yield "an index", f"{code.closed(node.value)}[{index}]"
    elif isinstance(node, ast.Call) and name_of_call(node) == "norm" and node.args:
        along = [n for n in scope if code.axes.get(n, 1) == 1]
        for name in along:
            yield (
                "a length where the part along belongs",
                dot(code.closed(node.args[0]), name),
            )
        if not any(k.arg == "axis" for k in node.keywords):
            return
        yield "norm() where sum() belongs", call_text(code, node, function="np.sum")
    if isinstance(node, (ast.BinOp, ast.Call)) and is_quantity(place):
        inside = {n.id for n in ast.walk(node) if isinstance(n, ast.Name)} & set(scope)
        vectors = sorted(n for n in inside if code.axes.get(n, 1) == 1)
        if 2 <= len(vectors) <= 3:
            for one in vectors:
                for two in vectors:
                    if one != two:
                        yield (
                            "another expression than the cross product",
                            f"np.cross({one}, {two})",
                        )
                    if one < two:
                        yield (
                            "another expression than the dot product",
                            dot(one, two),
                        )


def _other_length(
    code: Code, node: ast.Name, scope: tuple[str, ...]
) -> Iterator[Change]:
    """A vector in the place of a matrix's product with it, or the other way round."""
    if code.axes.get(node.id) != 1:
        return
    for matrix in (n for n in scope if code.axes.get(n) == 2):
        for vector in (n for n in scope if code.axes.get(n) == 1 and n != node.id):
            yield "another vector", times(matrix, vector)
            yield "another vector", solved(matrix, vector)


def _other_number(code: Code, place: Place) -> Iterator[Change]:
    assert isinstance(place.node, ast.Constant)
    value: Any = place.node.value  # int or float
    if place.node in code.terms_counted:
        return  # more terms are not all of them, however many pass for it
    news = [value + 1, value - 1, 2 * value, value / 2, -value]
    if isinstance(place.parent, ast.Compare):
        news.append(0)  # a limit that was left some room
    seen = {value}
    for new in news:
        whole = isinstance(new, float) and new.is_integer()
        new = int(new) if whole and isinstance(value, int) else new
        if new not in seen:
            seen.add(new)
            yield "a number", repr(new)
    index = isinstance(place.parent, (ast.Subscript, ast.Tuple)) or not is_quantity(
        place
    )
    for name in place.scope:
        if index and name in code.running:
            continue  # a count or an index is not what a loop has added up so far
        if index or code.axes.get(name, 0) == 0:
            yield "a number where a name belongs", name
            if not index:
                yield "a number where a name belongs", f"1 + {name}"
                yield "a number where a name belongs", f"1 - {name}"
    if not index:
        for name in place.scope:
            if code.axes.get(name, 0) > 0:
                yield "a number where a name belongs", name


def renamed(
    code: Code, node: ast.AST, table: dict[str, str]
) -> list[tuple[int, int, str]]:
    """The patches that give the names inside a node their new names."""
    return [
        (*code.span(n), table[n.id])
        for n in ast.walk(node)
        if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load) and n.id in table
    ]
