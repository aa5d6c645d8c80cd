"""Lesson 16: sweeps over the contacts."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_16_contact_forces.shared import (
    LEVER,
    PAIR,
    ROW,
    A,
    B,
    drawn_system,
    pulled_open,
)
from course.exercises.slips import slip


def _swept_systems(rng: np.random.Generator) -> Sequence[Case]:
    a, b = drawn_system(rng, 3)
    b[0] = -8.5
    warm = np.round(rng.uniform(0.5, 6, 3), 1)
    strong, units = (
        np.ones((4, 4)) + 0.1 * np.eye(4),
        rng.permuted([0.25, 1.0, 2.0, 8.0]),
    )
    down, none = np.array([-1.0, -1.0]), np.zeros(2)
    none_of_four = np.zeros(4)
    return [
        Case("two contacts, one sweep", {"a": PAIR, "b": down, "start": none, "sweeps": 1}),
        Case("two contacts, three sweeps", {"a": 2 * PAIR, "b": down, "start": none, "sweeps": 3}),
        Case("one foot lifts", {"a": 2 * LEVER, "b": np.array([-1.0, -2.0]), "start": none, "sweeps": 4}),
        Case("three contacts, a warm start", {"a": a, "b": b, "start": warm, "sweeps": 2}),
        Case("three in a row", {"a": ROW, "b": np.array([-9.0, -1.0, -6.0]), "start": np.array([0.0, 2, 1]),
                                "sweeps": 5}),
        Case("no sweep", {"a": PAIR, "b": down, "start": np.array([0.3, 0.4]), "sweeps": 0}, "edge"),
        *(Case(f"{c.label}, two sweeps", {**c.arguments, "start": none, "sweeps": 2}) for c in pulled_open(rng)),
        Case("light beside heavy, strongly coupled", {"a": strong * units[:, None] * units, "b": -9.81 * units,
                                                      "start": none_of_four, "sweeps": 7}),
        Case("they part", {"a": 2 * PAIR, "b": -down, "start": np.array([3.0, 1.0]), "sweeps": 2}, "edge"),
    ]  # fmt: skip


PROJECTED_GAUSS_SEIDEL = Exercise(
    name="projected_gauss_seidel",
    rows=(25,),
    points=4,
    minutes=12,
    task="Sweep over the contacts in order, f_i <- max(0, f_i - d_ddot_i/a_ii) with d_ddot_i of the newest "
    "forces; return f.",
    arguments=(
        A,
        B,
        Value("start", "(c,)", "N", "forces to begin with, at or above 0"),
        Value("sweeps", "scalar", "", "how often all contacts are gone through", dtype="int"),
    ),
    results=(Value("f", "(c,)", "N", "forces after the last sweep"),),
    reference=formulas.projected_gauss_seidel,
    cases=_swept_systems,
    mistakes=(
        Mistake("clips the change",
                slip(
                    formulas.projected_gauss_seidel,
                    "max(0.0, f[i] - w / a[i, i])",
                    "f[i] + max(0.0, -w / a[i, i])",
                ),
                "You limit the change of a force, not the force: a force can then only grow, and what was once too "
                "large stays. Add the change first, then take max(0, ...)."),
        Mistake("no limit",
                slip(formulas.projected_gauss_seidel, "max(0.0, f[i] - w / a[i, i])", "f[i] - w / a[i, i]"),
                "No force is limited to f >= 0: these are the sweeps for A f = -b."),
        Mistake("limited at the end",
                slip(
                    formulas.projected_gauss_seidel,
                    "max(0.0, f[i] - w / a[i, i])",
                    "f[i] - w / a[i, i]",
                    "return f",
                    "return np.maximum(f, 0.0)",
                ),
                "The limit comes only after all sweeps. Until then other contacts lean on one that pulls."),
        Mistake("Jacobi",
                slip(
                    formulas.projected_gauss_seidel,
                    "for i in",
                    "seen = f.copy()\n        for i in",
                    "a[i] @ f",
                    "a[i] @ seen",
                ),
                "Each sweep uses only the forces of the sweep before it. That is Jacobi's method: slower, and it may "
                "not converge. Gauss-Seidel uses each new force at once."),
        Mistake("not divided", slip(formulas.projected_gauss_seidel, " / a[i, i]", ""),
                "d_ddot_i is in m/s^2. Divided by a_ii it becomes a force."),
        Mistake("sign of b", slip(formulas.projected_gauss_seidel, "+ b[i]", "- b[i]"),
                "The sign of b is reversed: d_ddot = A f + b."),
        Mistake("b left out", slip(formulas.projected_gauss_seidel, " + b[i]", ""),
                "b is missing: d_ddot_i is row i of A times f, plus b_i."),
        Mistake("one contact a sweep",
                slip(
                    formulas.projected_gauss_seidel,
                    "for _ in",
                    "for k in",
                    "in range(len(b))",
                    "in [k % len(b)]",
                ),
                "Each of your sweeps treats one contact. A sweep goes through all of them: a loop in a loop."),
        Mistake("sweeps ignored", slip(formulas.projected_gauss_seidel, "range(sweeps)", "range(1)"),
                "You go through the contacts once, whatever `sweeps` says."),
        Mistake("old force lost", slip(formulas.projected_gauss_seidel, "f[i] - w", "-w"),
                "The old force is lost: -d_ddot_i/a_ii is only the change. (Row i of A times f holds a_ii f_i "
                "already.)"),
        Mistake("wrong way", slip(formulas.projected_gauss_seidel, "f[i] - w", "f[i] + w"),
                "d_ddot_i/a_ii is added. Where a contact sinks in, d_ddot_i < 0, its force has to grow: subtract."),
        Mistake("own force left out",
                slip(formulas.projected_gauss_seidel, "a[i] @ f +", "a[i] @ f - a[i, i] * f[i] +"),
                "d_ddot_i leaves out contact i's own force, and the old force is added all the same. Either "
                "f_i - d_ddot_i/a_ii with all of row i, or the rest of the row alone without the old f_i."),
        Mistake("backwards",
                slip(formulas.projected_gauss_seidel, "range(len(b))", "reversed(range(len(b)))"),
                "The contacts are taken from the last to the first."),
        Mistake("a sweep too many",
                slip(formulas.projected_gauss_seidel, "range(sweeps)", "range(sweeps + 1)"),
                "One sweep too many: with sweeps = 0 the answer is start."),
        Mistake("start ignored",
                slip(formulas.projected_gauss_seidel, "np.array(start, dtype=float)", "np.zeros(len(b))"),
                "The forces begin at 0 and not at start."),
    ),
    hints=(
        "Two loops, one in the other: sweeps, contacts. Begin with a copy of start.",
        "For contact i: d_ddot_i is row i of A times all forces, plus b_i. Subtract d_ddot_i / a_ii from f_i, and take "
        "the larger of that and 0.",
        "f = np.array(start, dtype=float)\nfor _ in range(sweeps):\n    for i in range(len(b)):\n"
        "        w = a[i] @ f + b[i]\n        f[i] = max(0.0, ____)\nreturn f",
    ),
)  # fmt: skip
