"""Changes of an expression that leave a part of it out."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from course.exercises.repair.places import Code, Place, name_of_call
from course.exercises.repair.texts import NO_STEP, Change, call_text


def shorter(code: Code, place: Place) -> Iterator[Change]:
    """The expression with one part left out."""
    node, s = place.node, code.closed
    if isinstance(node, ast.BinOp):
        left, right = s(node.left), s(node.right)
        if isinstance(node.op, (ast.Add, ast.Sub)):
            yield "a term too many", left
            yield (
                "a term too many",
                right if isinstance(node.op, ast.Add) else f"-{right}",
            )
        elif isinstance(node.op, ast.Mult):
            yield "a factor too many", left
            yield "a factor too many", right
            for factor in (node.left, node.right):
                bare = _without_kept_axis(code, factor)
                if bare:  # the axis was there for the other factor
                    yield "a factor too many", bare
        elif isinstance(node.op, ast.MatMult):
            yield "a matrix too many", left
            yield "a matrix too many", right
        elif isinstance(node.op, (ast.Div, ast.FloorDiv)):
            yield "a divisor too many", left
            if isinstance(node.op, ast.Div) and left != "1":
                yield "a factor too many", f"1 / {right}"
        elif isinstance(node.op, ast.Pow):
            yield "a power too many", left
        elif isinstance(node.op, (ast.BitAnd, ast.BitOr)):
            yield "a condition too many", left
            yield "a condition too many", right
    elif isinstance(node, ast.BoolOp):
        for some in range(len(node.values)):
            kept = [s(v) for i, v in enumerate(node.values) if i != some]
            word = " and " if isinstance(node.op, ast.And) else " or "
            yield "a condition too many", word.join(kept)
    elif isinstance(node, ast.UnaryOp):
        turned = isinstance(node.op, (ast.Not, ast.Invert))
        yield ("a condition turned round" if turned else "a sign"), s(node.operand)
    elif isinstance(node, ast.IfExp):
        yield "a condition too many", s(node.body)
        yield "a condition too many", s(node.orelse)
        yield (
            "the two branches exchanged",
            f"{s(node.orelse)} if {s(node.test)} else {s(node.body)}",
        )
    elif isinstance(node, (ast.List, ast.Tuple)) and len(node.elts) > 1:
        if (
            not isinstance(place.parent, (ast.Return, ast.Subscript))
            and place.role != "args"
        ):
            yield from _without_entries(code, node)
    elif isinstance(node, ast.Subscript):
        yield from _without_index(code, node)
    elif isinstance(node, ast.Attribute) and node.attr == "T":
        yield "a transpose too many", s(node.value)
        yield (
            ".T, which turns all axes of a batch round",
            f"np.swapaxes({code.text(node.value)}, -1, -2)",
        )
    elif isinstance(node, ast.Call):
        yield from _without_call(code, node)


def _without_entries(code: Code, node: ast.List | ast.Tuple) -> Iterator[Change]:
    ends = "[]" if isinstance(node, ast.List) else "()"
    for some in range(len(node.elts)):
        kept = [code.text(e) for i, e in enumerate(node.elts) if i != some]
        yield "an entry too many", f"{ends[0]}{', '.join(kept)},{ends[1]}"


def _without_index(code: Code, node: ast.Subscript) -> Iterator[Change]:
    inside = node.slice
    parts = inside.elts if isinstance(inside, ast.Tuple) else [inside]
    value = code.closed(node.value)
    none = [p for p in parts if isinstance(p, ast.Constant) and p.value is None]
    if none:
        yield "an axis too many", value
    elif any(isinstance(p, ast.Slice) for p in parts):
        yield "a slice too many", value
        kept = [code.text(p) for p in parts if not isinstance(p, ast.Slice)]
        if kept:
            yield "a slice too many", f"{value}[{', '.join(kept)}]"


def _without_kept_axis(code: Code, node: ast.expr) -> str:
    """x of x[..., None], a sum of one with keepdims=True; empty for anything else."""
    if isinstance(node, ast.Subscript):
        parts = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        none = [p for p in parts if isinstance(p, ast.Constant) and p.value is None]
        return code.closed(node.value) if none else ""
    if isinstance(node, ast.Call):
        kept = [k for k in node.keywords if k.arg != "keepdims"]
        if len(kept) < len(node.keywords):
            return call_text(code, node, keywords=kept)
    return ""


def _without_call(code: Code, node: ast.Call) -> Iterator[Change]:
    name = name_of_call(node)
    if name not in NO_STEP:
        for argument in node.args:
            if not isinstance(argument, (ast.Starred, ast.GeneratorExp)):
                yield f"{name}() too many", code.closed(argument)
    if isinstance(node.func, ast.Attribute) and (not node.args or name == "astype"):
        yield f"{name}() too many", code.closed(node.func.value)
    for some, keyword in enumerate(node.keywords):
        if keyword.arg in ("axis", "keepdims", "degrees", "dtype"):
            kept = [k for i, k in enumerate(node.keywords) if i != some]
            yield f"{keyword.arg}= too many", call_text(code, node, keywords=kept)
