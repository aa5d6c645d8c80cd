"""A SymPy expression as a function of arrays: how an answer that is a formula is evaluated."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np


def evaluator(expression: Any, symbols: Sequence[str]) -> Callable[..., Any]:
    """A function of arrays, in the order of ``symbols``, that evaluates a SymPy
    expression.

    Raises ``TypeError`` or ``ValueError``, in words meant for the student, where the
    answer is not an expression in these symbols.
    """
    import sympy

    expression = _one_expression(expression)
    _require_known(expression, symbols)
    expression = expression.replace(sympy.Piecewise, _without_endless_branches)
    by_name = {str(s): s for s in expression.free_symbols}
    try:
        points = [by_name.get(s, sympy.Symbol(s)) for s in symbols]
        compiled = _compiled(points, expression)
    except Exception:  # each of SymPy's printers has its own kind
        words = "an integral, a derivative or a sum is still to be worked out, as .doit() does"
        raise ValueError(
            f"expected an expression that can be evaluated; perhaps {words}"
        ) from None

    def evaluate(*points: Any) -> np.ndarray:
        shape = np.broadcast_shapes(*(np.shape(p) for p in points))
        return np.broadcast_to(np.asarray(compiled(*points), dtype=float), shape).copy()

    return evaluate


def _one_expression(answer: Any) -> Any:
    """The answer as one SymPy expression; what is none is told what it is."""
    import sympy

    if isinstance(answer, (list, tuple, set, dict, sympy.FiniteSet)):
        entry = "its entry, as in solve(...)[0]"
        if isinstance(answer, dict):
            entry = "that of the unknown you want, as in solve(...)[p]"
        raise TypeError(
            f"expected one expression; got a {type(answer).__name__} of {len(answer)}. "
            f"sympy.solve returns several: take {entry}"
        )
    if isinstance(
        answer,
        (sympy.core.relational.Relational, sympy.logic.boolalg.BooleanAtom, bool),
    ):
        raise TypeError(
            "expected an expression; got an equation. Give its right-hand side alone"
        )
    if callable(answer) and not isinstance(answer, sympy.Basic):
        raise TypeError("expected an expression in SymPy's symbols; got a function")
    came = type(answer).__name__
    try:
        found = None if isinstance(answer, np.ndarray) else sympy.sympify(answer)
    except (sympy.SympifyError, TypeError, AttributeError):
        found = None
    if getattr(found, "is_Matrix", False):
        raise TypeError(
            "expected a SymPy expression; got a vector or a matrix. Asked is one number"
        )
    if not isinstance(found, sympy.Expr):
        raise TypeError(f"expected a SymPy expression; got {came}")
    return found


def _compiled(points: Sequence[Any], expression: Any) -> Callable[..., Any]:
    """``sympy.lambdify`` for NumPy, without what its own ``from numpy import *`` loads first: a tenth of a second of
    packages that no formula uses.
    """
    import sympy
    from sympy.printing.numpy import NumPyPrinter

    settings = {"fully_qualified_modules": False, "inline": True}
    printer = NumPyPrinter({**settings, "allow_unknown_functions": True})
    names = {**vars(np.linalg), **vars(np), "numpy": np}
    return sympy.lambdify(points, expression, [names], printer)


def _without_endless_branches(*branches: Any) -> Any:
    """A Piecewise with NaN for its branches that have no finite value or are an infinite sum still to be done.

    SymPy gives a geometric series so: its sum where that converges, the sum itself as
    it stands elsewhere. All branches are evaluated, and one of the latter has no end.
    """
    import sympy

    kept = [(sympy.nan if v.has(sympy.oo, -sympy.oo) else v, c) for v, c in branches]
    return sympy.Piecewise(*kept, evaluate=False)


def _require_known(expression: Any, symbols: Sequence[str]) -> None:
    """Refuse an expression with other symbols or undefined functions, or divided by
    zero.
    """
    import sympy

    others = expression.free_symbols | expression.atoms(
        sympy.core.function.AppliedUndef
    )
    foreign = sorted({str(s) for s in others} - set(symbols))
    if foreign:
        raise ValueError(
            f"expected an expression in {', '.join(symbols)}; yours also contains {', '.join(foreign)}"
        )
    endless = (sympy.oo, -sympy.oo)
    if expression.has(sympy.nan, sympy.zoo) or expression.subs(
        {p: 1 for p in expression.atoms(sympy.Piecewise)}
    ).has(*endless):
        raise ValueError(
            f"expected a finite expression; got {expression}: is something divided by zero?"
        )
