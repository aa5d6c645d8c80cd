"""Lesson 16: how far forces are from solving the contact conditions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_16_contact_forces.shared import (
    LEVER,
    PAIR,
    ROW,
    apply,
    drawn_system,
)


def _residual(
    *,
    judge: Any = None,
    scale: Any = None,
    diagonal: bool = True,
    sign: float = 1.0,
    best: Any = None,
) -> Any:
    """The residual with one of its parts changed."""

    def function(a: Any, f: Any, b: Any) -> Any:
        d = np.diagonal(a, axis1=-2, axis2=-1) if diagonal else 1.0
        push, w = d * np.asarray(f), apply(a, f) + sign * np.asarray(b)
        wrong = judge(push, w) if judge else np.abs(np.minimum(push, w))
        size, largest = apply(np.abs(a), f), np.abs(b).max(axis=-1, keepdims=True)
        below = scale(a, f, size, largest) if scale else size + largest
        rows = np.divide(wrong, below, out=np.zeros(np.shape(wrong)), where=below > 0)
        return best(rows) if best else rows.max(axis=-1)

    return function


def _without_guard(a: Any, f: Any, b: Any) -> Any:
    w, d = apply(a, f) + b, np.diagonal(a, axis1=-2, axis2=-1)
    scale = apply(np.abs(a), f) + np.abs(b).max(axis=-1, keepdims=True)
    return np.max(np.abs(np.minimum(d * f, w)) / scale, axis=-1)


def _tried_forces(rng: np.random.Generator) -> Sequence[Case]:
    def draw(shape: tuple[int, ...] = (), count: int = 3) -> dict[str, Any]:
        systems = [drawn_system(rng, count) for _ in range(int(np.prod(shape)))]
        a, b = (
            np.array([s[k] for s in systems]).reshape(*shape, *np.shape(systems[0][k]))
            for k in (0, 1)
        )
        return {"a": a, "f": np.round(rng.uniform(0, 6, b.shape), 1), "b": b}

    down, wedge = np.array([-1.0, -1.0]), np.array([[1.0, -0.75], [-0.75, 1.0]])
    return [
        Case(
            "two contacts, one force too large",
            {"a": PAIR, "f": np.array([1.0, 0.5]), "b": down},
        ),
        Case(
            "no force: both sink in",
            {"a": 2 * PAIR, "f": np.zeros(2), "b": np.array([-1.0, -3.0])},
        ),
        Case(
            "one force drives the other contact in",
            {"a": wedge, "f": np.array([1.0, 4.0]), "b": down},
        ),
        Case("three contacts", draw()),
        Case(
            "a force where the bodies part",
            {"a": ROW, "f": np.array([0.0, 1.0, 4.0]), "b": np.array([-9.0, 2, 1])},
        ),
        Case(
            "solved",
            {"a": LEVER, "f": np.array([0.0, 2.0]), "b": np.array([-1.0, -2.0])},
            "edge",
        ),
        Case(
            "b = 0 and no force",
            {"a": PAIR, "f": np.zeros(2), "b": np.zeros(2)},
            "edge",
        ),
        Case("two systems of three contacts", draw((2,)), "batch"),
        Case("a 2 by 3 batch", draw((2, 3), 2), "batch"),
    ]


def _residual_with_own_b(a: Any, f: Any, b: Any) -> Any:
    return _residual(scale=lambda a, f, size, _: size + np.abs(b))(a, f, b)


COMPLEMENTARITY_RESIDUAL = Exercise(
    name="complementarity_residual",
    rows=(20, 25),
    points=3,
    minutes=15,
    task="Return max_i |min(D_i f_i, w_i)| / ((|A| f)_i + max_j |b_j|), w = A f + b the "
    "d_ddot, D = diag A; a row 0/0 is 0.",
    arguments=(
        Value("a", "(..., c, c)", "1/kg", "contact matrices"),
        Value("f", "(..., c)", "N", "forces to be judged, at or above 0"),
        Value("b", "(..., c)", "m/s^2", "d_ddot without contact forces"),
    ),
    results=(Value("residual", "(...)", "", "0 for a solution"),),
    reference=_residual(),
    cases=_tried_forces,
    mistakes=(
        Mistake("no abs", _residual(judge=np.minimum),
                "Without the absolute value a contact that sinks in, d_ddot < 0, has a residual below 0, and the "
                "largest one hides it."),
        Mistake("abs too early", _residual(judge=lambda p, w: np.minimum(np.abs(p), np.abs(w))),
                "The absolute values come too early: with f = 0 and d_ddot < 0 the smaller of |a_ii f| and "
                "|d_ddot| is 0, and the contact sinks in unseen. First the minimum, then its absolute value."),
        Mistake("approach alone", _residual(judge=lambda p, w: np.maximum(-w, 0)),
                "You see only the contacts that sink in. A contact that pushes although the bodies part is wrong too."),
        Mistake("product", _residual(judge=lambda p, w: np.abs(p * w)),
                "You judge the product f d_ddot. It is 0 for f = 0 whatever d_ddot is: a contact that sinks in "
                "passes."),
        Mistake("no scale", _residual(scale=lambda a, f, size, largest: np.ones_like(size)),
                "The scale is missing: m/s^2 would be judged alike for a crumb and for a ship."),
        Mistake("scale without b", _residual(scale=lambda a, f, size, largest: size),
                "max |b| is missing in the scale. Without it a row with no forces has no scale at all."),
        Mistake("scale by A f", _residual(scale=lambda a, f, size, largest: np.abs(apply(a, f)) + largest),
                "The scale has |A f|, where terms cancel. It is |A| f: the absolute value of each entry first."),
        Mistake("no absolute values in the scale",
                _residual(scale=lambda a, f, size, largest: apply(a, f) + largest),
                "The scale has A f, where terms cancel and which may be below 0. It is |A| f: np.abs(a)."),
        Mistake("each row's own b", _residual_with_own_b,
                "The scale has |b_i| of each row. It is the largest |b| of the system, in every row."),
        Mistake("one b for the whole batch", _residual(scale=lambda a, f, size, largest: size + np.max(largest)),
                "Right for one system. In a batch each has its own largest |b|: max(axis=-1, keepdims=True)."),
        Mistake("one scale for all rows",
                _residual(scale=lambda a, f, size, largest: size.max(-1, keepdims=True) + largest),
                "All rows have the largest scale. Each row is judged against its own terms; only max |b| is common."),
        Mistake("rows added up", _residual(best=lambda rows: rows.sum(axis=-1)),
                "You add the rows up. The residual is the worst of them."),
        Mistake("D missing", _residual(diagonal=False),
                "The minimum is taken of newtons and m/s^2. a_ii f_i is in m/s^2, as d_ddot_i is."),
        Mistake("sign of b", _residual(sign=-1.0), "The sign of b: d_ddot = A f + b is the acceleration of the gaps."),
        Mistake("0/0", _without_guard,
                "0/0 where nothing pushes and b = 0: there the residual is 0. np.divide(x, y, out=np.zeros(...), "
                "where=y > 0) leaves such rows at 0."),
    ),
    hints=(
        "Under Build: four arrays first (a_ii f_i, d_ddot = A f + b, |A| f, the largest |b|), then one line.",
        "The a_ii are np.diagonal(a, axis1=-2, axis2=-1). A matrix times a vector in a batch is the einsum of lesson "
        "14. The largest |b| needs keepdims=True to be added to every row.",
        'w = np.einsum("...ij,...j->...i", a, f) + b\nwrong = np.abs(np.minimum(d * f, ____))\n'
        'scale = np.einsum("...ij,...j->...i", ____, f) + np.abs(b).max(axis=-1, keepdims=True)\n'
        "rows = np.divide(wrong, scale, out=np.zeros(wrong.shape), where=scale > 0)\nreturn rows.max(axis=-1)",
    ),
)  # fmt: skip
