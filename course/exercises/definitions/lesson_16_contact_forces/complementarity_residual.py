"""Lesson 16: how far forces are from solving the contact conditions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_16_contact_forces.shared import (
    LEVER,
    PAIR,
    ROW,
    drawn_system,
)
from course.exercises.slips import slip


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
        Case(
            "b = 0, and yet forces",
            {"a": PAIR, "f": np.array([1.0, 2.0]), "b": np.zeros(2)},
            "edge",
        ),
        Case(
            "small forces and accelerations",
            {"a": PAIR, "f": np.array([0.1, 0.2]), "b": np.array([-0.1, -0.05])},
        ),
    ]


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
        Value("b", "(..., c)", "m/s²", "d_ddot without contact forces"),
    ),
    results=(Value("residual", "(...)", "", "0 for a solution"),),
    reference=formulas.complementarity_residual,
    cases=_tried_forces,
    mistakes=(
        Mistake("no abs",
                slip(
                    formulas.complementarity_residual, "np.abs(np.minimum(d * f, w))", "np.minimum(d * f, w)"
                ),
                "Without the absolute value a contact that sinks in, d_ddot < 0, has a residual below 0, and the "
                "largest one hides it."),
        Mistake("abs too early",
                slip(
                    formulas.complementarity_residual,
                    "np.abs(np.minimum(d * f, w))",
                    "np.minimum(np.abs(d * f), np.abs(w))",
                ),
                "The absolute values come too early: with f = 0 and d_ddot < 0 the smaller of |a_ii f| and "
                "|d_ddot| is 0, and the contact sinks in unseen. First the minimum, then its absolute value."),
        Mistake("approach alone",
                slip(formulas.complementarity_residual, "np.abs(np.minimum(d * f, w))", "np.maximum(-w, 0)"),
                "You see only the contacts that sink in. A contact that pushes although the bodies part is wrong too."),
        Mistake("product",
                slip(formulas.complementarity_residual, "np.abs(np.minimum(d * f, w))", "np.abs(d * f * w)"),
                "You judge the product f d_ddot. It is 0 for f = 0 whatever d_ddot is: a contact that sinks in "
                "passes."),
        Mistake("no scale",
                slip(
                    formulas.complementarity_residual,
                    'np.einsum("...ij,...j->...i", np.abs(a), f) + largest',
                    "np.ones(wrong.shape)",
                ),
                "The scale is missing: m/s^2 would be judged alike for a crumb and for a ship."),
        Mistake("scale without b", slip(formulas.complementarity_residual, " + largest", ""),
                "max |b| is missing in the scale. Without it a row with no forces has no scale at all."),
        Mistake("scale by A f",
                slip(
                    formulas.complementarity_residual,
                    'np.einsum("...ij,...j->...i", np.abs(a), f)',
                    'np.abs(np.einsum("...ij,...j->...i", a, f))',
                ),
                "The scale has |A f|, where terms cancel. It is |A| f: the absolute value of each entry first."),
        Mistake("no absolute values in the scale",
                slip(formulas.complementarity_residual, "np.abs(a), f", "a, f"),
                "The scale has A f, where terms cancel and which may be below 0. It is |A| f: np.abs(a)."),
        Mistake("each row's own b",
                slip(formulas.complementarity_residual, "np.abs(b).max(axis=-1, keepdims=True)", "np.abs(b)"),
                "The scale has |b_i| of each row. It is the largest |b| of the system, in every row."),
        Mistake("one b for the whole batch",
                slip(formulas.complementarity_residual, "max(axis=-1, keepdims=True)", "max()"),
                "Right for one system. In a batch each has its own largest |b|: max(axis=-1, keepdims=True)."),
        Mistake("one scale for all rows",
                slip(
                    formulas.complementarity_residual,
                    'np.einsum("...ij,...j->...i", np.abs(a), f)',
                    'np.einsum("...ij,...j->...i", np.abs(a), f).max(axis=-1, keepdims=True)',
                ),
                "All rows have the largest scale. Each row is judged against its own terms; only max |b| is common."),
        Mistake("rows added up", slip(formulas.complementarity_residual, "rows.max", "rows.sum"),
                "You add the rows up. The residual is the worst of them."),
        Mistake("D missing", slip(formulas.complementarity_residual, "d * f", "f"),
                "The minimum is taken of newtons and m/s^2. a_ii f_i is in m/s^2, as d_ddot_i is."),
        Mistake("sign of b", slip(formulas.complementarity_residual, "f) + b", "f) - b"),
                "The sign of b: d_ddot = A f + b is the acceleration of the gaps."),
        Mistake("0/0",
                slip(
                    formulas.complementarity_residual,
                    "np.divide(wrong, scale, out=np.zeros(wrong.shape), where=scale > 0)",
                    "wrong / scale",
                ),
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
