"""Changes that add something: a sign of nothing in the source, so it is built by the number of axes and tried last."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from course.exercises.repair.names import TWINS, renamed, twin_names
from course.exercises.repair.places import (
    Code,
    Place,
    is_quantity,
    name_of_call,
    patched,
)
from course.exercises.repair.texts import NO_STEP, Change, dot, solved, times

NEEDS_STEP = (ast.BinOp, ast.Call, ast.Name, ast.Subscript, ast.Attribute, ast.UnaryOp)
WRAPS = {
    "sin() missing": "np.sin({})",
    "cos() missing": "np.cos({})",
    "a root missing": "np.sqrt({})",
    "abs() missing": "np.abs({})",
    "a limit at 0 missing": "np.maximum({}, 0)",
    "a limit at 0 missing ": "np.minimum({}, 0)",
    "a square missing": "{} ** 2",
    "one over it missing": "1 / {}",
    "1 + missing": "1 + {}",
    "1 - missing": "1 - {}",
    "a factor 2 missing": "2 * {}",
    "a factor 1/2 missing": "{} / 2",
    "an axis missing": "np.asarray({})[..., None]",
    "a sum missing": "np.sum({}, axis=-1)",
    "a sum missing ": "np.sum({}, axis=-1, keepdims=True)",
    "a running sum missing": "np.cumsum({}, axis=-1)",
    "a transpose missing": "np.swapaxes({}, -1, -2)",
    "the division by its length missing": "{0} / np.linalg.norm({0}, axis=-1, keepdims=True)",
    "a sign() missing": "np.sign({})",
}


def longer(code: Code, place: Place) -> Iterator[Change]:
    """The expression with one simple thing more: a function, a number, a factor, a term."""
    if _can_be_longer(place):
        text = code.closed(place.node)
        for kind, form in WRAPS.items():
            yield kind.strip(), form.format(text)
        yield from _with_number(code, place, text)


def longer_by_vectors(code: Code, place: Place) -> Iterator[Change]:
    """The expression with a product of vectors, a matrix, or the other one's term more."""
    if _can_be_longer(place):
        text = code.closed(place.node)
        yield from _with_vector(code, place, text)
        yield from _with_twin(code, place, text)


def longer_by_two(code: Code, place: Place) -> Iterator[Change]:
    """The expression with two names more."""
    if not _can_be_longer(place):
        return
    text = code.closed(place.node)
    yield from _with_sum_of_twins(code, place, text)
    parts = (ast.Return, ast.Assign, ast.AugAssign, ast.Tuple)
    if isinstance(place.parent, parts) or name_of_call(place.parent) in (
        "solve",
        "where",
    ):
        yield from _with_product(code, place, text)


def _can_be_longer(place: Place) -> bool:
    if not is_quantity(place) or not isinstance(place.node, NEEDS_STEP):
        return False
    if isinstance(place.node, ast.UnaryOp) and isinstance(
        place.node.operand, ast.Constant
    ):
        return False  # a number below 0 is a number
    return name_of_call(place.node) not in NO_STEP


def _names_beside(code: Code, place: Place) -> Iterator[tuple[str, int | None]]:
    for name in place.scope:
        if not (isinstance(place.node, ast.Name) and place.node.id == name):
            yield name, code.axes.get(name)


def _with_number(code: Code, place: Place, text: str) -> Iterator[Change]:
    mine = code.axes.get(place.node.id) if isinstance(place.node, ast.Name) else None
    for name, axes in _names_beside(code, place):
        if axes in (0, None):
            with_axis = f"np.asarray({name})[..., None]"
            for one in (name, with_axis) if mine != 0 else (name,):
                yield "a factor missing", f"{one} * {text}"
                yield "a divisor missing", f"{text} / {one}"
            yield "a factor missing", f"(1 + {name}) * {text}"
            yield "a factor missing", f"(1 - {name}) * {text}"
        if mine is None or axes is None or axes == mine:
            yield "a term missing", f"{text} + {name}"
            yield "a term missing", f"{text} - {name}"


def _with_vector(code: Code, place: Place, text: str) -> Iterator[Change]:
    for name, axes in _names_beside(code, place):
        if axes in (1, None):
            yield "a part along a vector missing", dot(text, name, kept=True)
            yield "a dot product missing", dot(text, name)
            yield "a cross product missing", f"np.cross({name}, {text})"
            yield "a cross product missing", f"np.cross({text}, {name})"
            yield "a factor missing", f"{name} * {text}"
            yield "a vector missing", f"np.asarray({text})[..., None] * {name}"
        if axes == 2:
            turned = f"np.swapaxes({name}, -1, -2)"
            yield "a matrix missing", times(name, text)
            yield "the inverse of a matrix missing", solved(name, text)
            yield "a matrix missing", f"{name} @ {text}"
            yield "a matrix missing", f"{text} @ {turned}"
            yield "a matrix missing", f"{name} @ {text} @ {turned}"
            node = place.node
            if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult):
                for factor, second in (
                    (node.left, node.right),
                    (node.right, node.left),
                ):
                    is_it = code.text(second) == name
                    kind = (
                        "* where @ belongs"
                        if is_it
                        else "a factor where a matrix belongs"
                    )
                    yield kind, times(name, code.closed(factor))


def _with_twin(code: Code, place: Place, text: str) -> Iterator[Change]:
    """The same for the other body (contact, point) added or subtracted."""
    node = place.node
    if not isinstance(node, (ast.BinOp, ast.Call)):
        return
    used = {n.id for n in ast.walk(node) if isinstance(n, ast.Name)}
    for pair in TWINS[:3]:
        for one, other in (pair, pair[::-1]):
            table = {n: twin_names(n, one, other) for n in used}
            table = {n: t for n, t in table.items() if t != n and t in place.scope}
            if table and not used & set(table.values()):
                start, end = code.span(node)
                moved = [
                    (a - start, b - start, t) for a, b, t in renamed(code, node, table)
                ]
                twin = patched(code.source[start:end], tuple(moved))
                yield "the term of the other one missing", f"{text} + ({twin})"
                yield "the term of the other one missing", f"{text} - ({twin})"


def _with_sum_of_twins(code: Code, place: Place, text: str) -> Iterator[Change]:
    for one, other in TWINS[:2]:
        for name in place.scope:
            twin = twin_names(name, one, other)
            if twin == name or twin not in place.scope or code.axes.get(name, 0) > 0:
                continue
            if text == name:
                yield "the other one's share missing", f"1 / (1 / {name} + 1 / {twin})"
                yield "the other one's share missing", f"({name} + {twin})"
            else:
                for both in (
                    f"({name} + {twin})",
                    f"({name} * {twin})",
                    f"(1 / {name} + 1 / {twin})",
                ):
                    yield "a factor missing", f"{both} * {text}"
                    yield "a divisor missing", f"{text} / {both}"


def _with_product(code: Code, place: Place, text: str) -> Iterator[Change]:
    """A term that is a product of two names."""
    vectors = [n for n in place.scope if code.axes.get(n) == 1][:12]
    for one in vectors:
        for two in vectors:
            if one != two:
                yield "a term missing", f"{text} + np.cross({one}, {two})"
            if one < two:
                yield "a term missing", f"{text} + {dot(one, two)}"
                yield "a term missing", f"{text} - {dot(one, two)}"
    numbers = [n for n in place.scope if code.axes.get(n) == 0][:10]
    for one in numbers:
        for two in numbers:
            if one <= two:
                yield "a term missing", f"{text} + {one} * {two}"
                yield "a term missing", f"{text} - {one} * {two}"
