"""Lesson 16: sweeps over the contacts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_16_contact_forces.shared import (
    LEVER,
    PAIR,
    ROW,
    A,
    B,
    drawn_system,
)


def _sweeps(
    *,
    clip: str = "force",
    jacobi: bool = False,
    divide: bool = True,
    sign: float = 1.0,
    own: float = 0.0,
    way: float = -1.0,
    backwards: bool = False,
    more: int = 0,
    once: bool = False,
    single: bool = False,
    warm: bool = True,
) -> Any:
    """Sweeps over the contacts with one of their parts changed."""

    def function(a: Any, b: Any, start: Any, sweeps: Any) -> Any:
        f = np.array(start, dtype=float) if warm else np.zeros(len(b))
        for k in range(1 if once else int(sweeps) + more):
            seen = f.copy() if jacobi else f
            whole = reversed(range(len(b))) if backwards else range(len(b))
            for i in (k % len(b),) if single else whole:
                w = a[i] @ seen + sign * b[i] + own * a[i, i] * f[i]
                change = way * w / (a[i, i] if divide else 1.0)
                if clip == "change":
                    change = max(change, 0.0)
                f[i] = max(f[i] + change, 0.0) if clip == "force" else f[i] + change
        return np.maximum(f, 0.0) if clip == "end" else f

    return function


def _swept_systems(rng: np.random.Generator) -> Sequence[Case]:
    a, b = drawn_system(rng, 3)
    b[0] = -8.5
    warm = np.round(rng.uniform(0.5, 6, 3), 1)
    down, none = np.array([-1.0, -1.0]), np.zeros(2)
    return [
        Case("two contacts, one sweep", {"a": PAIR, "b": down, "start": none, "sweeps": 1}),
        Case("two contacts, three sweeps", {"a": 2 * PAIR, "b": down, "start": none, "sweeps": 3}),
        Case("one foot lifts", {"a": 2 * LEVER, "b": np.array([-1.0, -2.0]), "start": none, "sweeps": 4}),
        Case("three contacts, a warm start", {"a": a, "b": b, "start": warm, "sweeps": 2}),
        Case("three in a row", {"a": ROW, "b": np.array([-9.0, -1.0, -6.0]), "start": np.array([0.0, 2, 1]),
                                "sweeps": 5}),
        Case("no sweep", {"a": PAIR, "b": down, "start": np.array([0.3, 0.4]), "sweeps": 0}, "edge"),
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
    reference=_sweeps(),
    cases=_swept_systems,
    mistakes=(
        Mistake("clips the change", _sweeps(clip="change"),
                "You limit the change of a force, not the force: a force can then only grow, and what was once too "
                "large stays. Add the change first, then take max(0, ...)."),
        Mistake("no limit", _sweeps(clip="none"), "No force is limited to f >= 0: these are the sweeps for A f = -b."),
        Mistake("limited at the end", _sweeps(clip="end"),
                "The limit comes only after all sweeps. Until then other contacts lean on one that pulls."),
        Mistake("Jacobi", _sweeps(jacobi=True),
                "Each sweep uses only the forces of the sweep before it. That is Jacobi's method: slower, and it may "
                "not converge. Gauss-Seidel uses each new force at once."),
        Mistake("not divided", _sweeps(divide=False), "d_ddot_i is in m/s^2. Divided by a_ii it becomes a force."),
        Mistake("sign of b", _sweeps(sign=-1.0), "The sign of b is turned round: d_ddot = A f + b."),
        Mistake("b left out", _sweeps(sign=0.0), "b is missing: d_ddot_i is row i of A times f, plus b_i."),
        Mistake("one contact a sweep", _sweeps(single=True),
                "Each of your sweeps treats one contact. A sweep goes through all of them: a loop in a loop."),
        Mistake("sweeps ignored", _sweeps(once=True), "You go through the contacts once, whatever `sweeps` says."),
        Mistake("old force lost", _sweeps(own=1.0),
                "The old force is lost: -d_ddot_i/a_ii is only the change. (Row i of A times f holds a_ii f_i "
                "already.)"),
        Mistake("wrong way", _sweeps(way=1.0),
                "d_ddot_i/a_ii is added. Where a contact sinks in, d_ddot_i < 0, its force has to grow: subtract."),
        Mistake("own force left out", _sweeps(own=-1.0),
                "d_ddot_i leaves out contact i's own force, and the old force is added all the same. Either "
                "f_i - d_ddot_i/a_ii with all of row i, or the rest of the row alone without the old f_i."),
        Mistake("backwards", _sweeps(backwards=True), "The contacts are taken from the last to the first."),
        Mistake("a sweep too many", _sweeps(more=1), "One sweep too many: with sweeps = 0 the answer is start."),
        Mistake("start ignored", _sweeps(warm=False), "The forces begin at 0 and not at start."),
    ),
    hints=(
        "Two loops, one in the other: sweeps, contacts. Begin with a copy of start.",
        "For contact i: d_ddot_i is row i of A times all forces, plus b_i. Subtract d_ddot_i / a_ii from f_i, and take "
        "the larger of that and 0.",
        "f = np.array(start, dtype=float)\nfor _ in range(sweeps):\n    for i in range(len(b)):\n"
        "        w = a[i] @ f + b[i]\n        f[i] = max(0.0, ____)\nreturn f",
    ),
)  # fmt: skip
