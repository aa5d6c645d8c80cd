"""Changes of the order of steps: other brackets, the other side of a fraction, inside or outside of a call."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from itertools import combinations

from course.exercises.repair.places import Code, name_of_call
from course.exercises.repair.texts import (
    NO_STEP,
    SIGNS,
    Change,
    call_text,
    is_product,
    is_sum,
    product,
)

#: Of longer expressions only the brackets that stand are moved.
MOST_OPERANDS = 8


def other_brackets(code: Code, node: ast.BinOp) -> Iterator[Change]:
    """a * (b + c) as a * b + c and the like, and the other way round."""
    s, left, right = code.closed, node.left, node.right
    sign = SIGNS.get(type(node.op))
    if sign is None:
        return
    if is_product(node) or sign == "@":
        if is_sum(right) and isinstance(right, ast.BinOp):
            inner = SIGNS[type(right.op)]
            yield (
                "brackets",
                f"{s(left)} {sign} {s(right.left)} {inner} {s(right.right)}",
            )
            yield (
                "brackets",
                f"{s(right.left)} {inner} {s(left)} {sign} {s(right.right)}",
            )
        if is_sum(left) and isinstance(left, ast.BinOp):
            inner = SIGNS[type(left.op)]
            yield (
                "brackets",
                f"{s(left.left)} {sign} {s(right)} {inner} {s(left.right)}",
            )
            yield (
                "brackets",
                f"{s(left.left)} {inner} {s(left.right)} {sign} {s(right)}",
            )
    for one, two, first in ((left, right, True), (right, left, False)):

        def joined(x: str, first: bool = first, two: ast.expr = two) -> str:
            return f"({x} {sign} {s(two)})" if first else f"({s(two)} {sign} {x})"

        if (
            is_sum(node)
            and isinstance(one, ast.BinOp)
            and type(one.op) in SIGNS
            and not is_sum(one)
        ):
            inner = SIGNS[type(one.op)]
            yield "brackets", f"{s(one.left)} {inner} {joined(s(one.right))}"
            yield "brackets", f"{joined(s(one.left))} {inner} {s(one.right)}"
        if (
            isinstance(one, ast.BinOp)
            and isinstance(one.op, ast.Pow)
            and is_product(node)
        ):
            yield "brackets", f"{joined(s(one.left))} ** {s(one.right)}"
        if isinstance(one, ast.Call):
            texts = [code.text(a) for a in one.args]
            for i, argument in enumerate(one.args):
                if not isinstance(argument, (ast.Starred, ast.Tuple)):
                    changed = [*texts[:i], joined(s(argument)), *texts[i + 1 :]]
                    yield "brackets", call_text(code, one, arguments=changed)
    if (
        isinstance(left, ast.Call)
        and isinstance(right, ast.Call)
        and left.args
        and right.args
    ):
        if code.text(left.func) == code.text(right.func):
            inside = f"{s(left.args[0])} {sign} {s(right.args[0])}"
            texts = [code.text(a) for a in left.args[1:]]
            yield (
                "the order of two steps",
                call_text(code, left, arguments=[inside, *texts]),
            )


def brackets_put_in(code: Code, node: ast.BinOp) -> Iterator[Change]:
    """a / b + c as a / (b + c), -1 + e * u as -(1 + e) * u: a pair of brackets between any two operands."""
    start, end = code.span(node)
    spans = [
        _with_brackets(code.source, *code.span(leaf)) for leaf in _operands(code, node)
    ]
    if not 2 < len(spans) <= MOST_OPERANDS:
        return
    for i, (opens, _) in enumerate(spans):
        for _, closes in spans[i + 1 :]:
            if (opens, closes) != (start, end) and start <= opens and closes <= end:
                text = code.source
                inside = f"({text[opens:closes]})"
                yield "brackets", text[start:opens] + inside + text[closes:end]


def _operands(code: Code, node: ast.expr) -> Iterator[ast.expr]:
    """What stands between the signs of an expression; a pair of brackets is one operand."""
    inner: list[ast.expr] = []
    if isinstance(node, ast.BinOp):
        inner = [node.left, node.right]
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        inner = [node.operand]
    for part in inner:
        span = code.span(part)
        closed = _with_brackets(code.source, *span) != span
        yield from [part] if closed else _operands(code, part)
    if not inner:
        yield node


def _with_brackets(source: str, start: int, end: int) -> tuple[int, int]:
    """A span with the brackets right around it; itself where there are none."""
    before, after = source[:start].rstrip(), source[end:].lstrip()
    if before.endswith("(") and after.startswith(")"):
        called = before[:-1].rstrip()[-1:]
        if not (called.isalnum() or called in "_])" and called):
            return len(before) - 1, len(source) - len(after) + 1
    return start, end


def terms_into_brackets(code: Code, node: ast.BinOp) -> Iterator[Change]:
    """a / b + c + d as a / (b + c + d)."""
    terms: list[tuple[str, ast.expr]] = []

    def collect(part: ast.expr, sign: str) -> None:
        if is_sum(part) and isinstance(part, ast.BinOp):
            collect(part.left, sign)
            turned = isinstance(part.op, ast.Sub)
            collect(part.right, {"+": "-", "-": "+"}[sign] if turned else sign)
        else:
            terms.append((sign, part))

    collect(node, "+")
    for i, (sign, term) in enumerate(terms if len(terms) > 2 else ()):
        if isinstance(term, ast.BinOp) and is_product(term):
            rest = [
                f" {s} {code.closed(t)}" for k, (s, t) in enumerate(terms) if k != i
            ]
            inside = f"({code.closed(term.right)}{''.join(rest)})"
            yield (
                "brackets",
                f"{sign}{code.closed(term.left)} {SIGNS[type(term.op)]} {inside}",
            )


def other_side(code: Code, node: ast.BinOp) -> Iterator[Change]:
    """A product with some factors on the other side of the bar, or two calls in it made one."""
    factors: list[tuple[ast.expr, bool]] = []

    def collect(part: ast.expr, above: bool) -> None:
        if isinstance(part, ast.BinOp) and is_product(part):
            collect(part.left, above)
            collect(part.right, above == isinstance(part.op, ast.Mult))
        else:
            factors.append((part, above))

    collect(node, True)
    if not is_product(node) or not 2 < len(factors) <= 6:
        return
    s = code.closed
    for size in (1, 2, 3):
        for some in combinations(range(len(factors)), size):
            parts = [
                (s(f), above ^ (i in some)) for i, (f, above) in enumerate(factors)
            ]
            yield "a quotient upside down", product(parts)
    for i, j in combinations(range(len(factors)), 2):
        one, two = factors[i][0], factors[j][0]
        if (
            isinstance(one, ast.Call)
            and isinstance(two, ast.Call)
            and len(one.args) == len(two.args) == 1
        ):
            if (
                code.text(one.func) == code.text(two.func)
                and factors[i][1]
                and factors[j][1]
            ):
                inside = [f"{s(one.args[0])} * {s(two.args[0])}"]
                rest = [
                    (s(f), up) for k, (f, up) in enumerate(factors) if k not in (i, j)
                ]
                yield (
                    "the order of two steps",
                    product([(call_text(code, one, arguments=inside), True), *rest]),
                )


def inside_out(code: Code, node: ast.Call) -> Iterator[Change]:
    """f(a * b) as a * f(b), f(a + b) as f(a) + b."""
    texts = [code.text(a) for a in node.args]
    if name_of_call(node) in NO_STEP:
        return
    for i, argument in enumerate(node.args):
        if isinstance(argument, ast.BinOp) and type(argument.op) in SIGNS:
            sign = SIGNS[type(argument.op)]
            left, right = code.closed(argument.left), code.closed(argument.right)
            first = call_text(code, node, arguments=[*texts[:i], left, *texts[i + 1 :]])
            last = call_text(code, node, arguments=[*texts[:i], right, *texts[i + 1 :]])
            yield "brackets", f"{first} {sign} {right}"
            yield "brackets", f"{left} {sign} {last}"
            yield "the order of two steps", f"{first} {sign} {last}"
