"""Pieces of the changed source: calls, dot products, products of a matrix and a vector."""

from __future__ import annotations

import ast

from course.exercises.repair.places import Code

Change = tuple[str, str]


#: Calls that are no step of a calculation: left out, nothing remains.
NO_STEP = frozenset(
    "range zeros ones empty zeros_like ones_like empty_like full len append remove Variable reshape".split()
)


SIGNS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.MatMult: "@"}


def call_text(
    code: Code,
    node: ast.Call,
    *,
    function: str = "",
    arguments: list[str] | None = None,
    keywords: list[ast.keyword] | None = None,
    more: str = "",
) -> str:
    """A call with another function, other arguments or keywords."""
    given = [code.text(a) for a in node.args] if arguments is None else arguments
    kept = node.keywords if keywords is None else keywords
    given = given + [
        f"{k.arg}={code.text(k.value)}" if k.arg else f"**{code.text(k.value)}"
        for k in kept
    ]
    return f"{function or code.text(node.func)}({', '.join(given + ([more] if more else []))})"


def dot(left: str, right: str, kept: bool = False) -> str:
    """The dot product of two vectors, or of each pair of a batch."""
    return f"np.sum({left} * {right}, axis=-1{', keepdims=True' if kept else ''})"


def times(matrix: str, vector: str) -> str:
    """A matrix times a vector, or each of a batch."""
    return f"({matrix} @ np.asarray({vector})[..., None])[..., 0]"


def solved(matrix: str, vector: str) -> str:
    """The vector that a matrix takes to this one, or each of a batch."""
    return f"np.linalg.solve({matrix}, np.asarray({vector})[..., None])[..., 0]"


def product(parts: list[tuple[str, bool]]) -> str:
    """Factors above and below the bar as one product."""
    return "1.0" + "".join(f" {'*' if above else '/'} {text}" for text, above in parts)


def is_product(node: ast.BinOp) -> bool:
    return isinstance(node.op, (ast.Mult, ast.Div))


def is_sum(node: ast.AST) -> bool:
    return isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Sub))
