"""Lesson 16: Baraff's method, contact by contact."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_16_contact_forces.shared import LEVER, PAIR, ROW, A, B, drawn_system


def _pivoting(*, leave: bool = True, join: bool = True, whole: bool = False, skip: bool = True) -> Any:
    """Baraff's method with one of its steps left out."""

    def function(a: Any, b: Any) -> Any:
        f, w = np.zeros(len(b)), np.array(b, dtype=float)
        pushing: list[int] = []
        for d in range(len(b)):
            for _ in range(50):  # a mistake may go round for ever
                if w[d] >= -1e-12 and (skip or abs(w[d]) <= 1e-12):
                    break
                change = np.zeros(len(b))
                change[d] = 1.0
                if not whole:
                    change[pushing] = -np.linalg.solve(a[np.ix_(pushing, pushing)], a[pushing, d])
                rate = a @ change
                stops = [(-w[d] / rate[d], d)]
                stops += [(-f[i] / change[i], i) for i in pushing if leave and change[i] < 0]
                stops += [(-w[i] / rate[i], i) for i in range(d) if join and i not in pushing and rate[i] < 0]
                step, who = min(stops)
                f, w = f + step * change, w + step * rate
                if who in pushing:
                    pushing.remove(who)
                    f[who] = 0.0
                else:
                    w[who] = 0.0
                    pushing += [who] if who != d else []
            if f[d] != 0:
                pushing.append(d)
        return f

    return function


def _pivot_systems(rng: np.random.Generator) -> Sequence[Case]:
    join = np.array([[1.0, -0.6, -0.6], [-0.6, 1.0, 0.8], [-0.6, 0.8, 1.0]])
    back = np.array([[1.0, 0.3, 0.3], [0.3, 1.0, -0.5], [0.3, -0.5, 1.0]])
    a, b = drawn_system(rng, 5)
    b[:3] = -np.abs(b[:3]) - 1
    return [
        Case("two contacts", {"a": PAIR, "b": np.array([-1.0, -1.0])}),
        Case("the first leaves", {"a": LEVER, "b": np.array([-1.0, -2.0])}),
        Case("the second rests at first", {"a": ROW, "b": np.array([-9.0, -1.0, -2.0])}),
        Case("one that parts must join", {"a": join, "b": np.array([1.0, -2.0, -3.0])}),
        Case("the first parts", {"a": back, "b": np.array([2.0, -1.0, -3.0])}),
        Case("five drawn contacts", {"a": a, "b": b}),
        Case("the last parts", {"a": PAIR, "b": np.array([-1.0, 2.0])}),
        Case("nothing pushes", {"a": PAIR, "b": np.array([1.0, 0.0])}, "edge"),
    ]


PIVOT = Exercise(
    name="pivot",
    rows=(20, 25),
    points=4,
    minutes=30,
    level="stretch",
    task="Return f >= 0 with w = A f + b >= 0 and f w = 0, contact by contact, for positive definite A.",
    arguments=(A, B),
    results=(Value("f", "(c,)", "N", "contact forces", relative=1e-8, absolute=1e-9),),
    reference=_pivoting(),
    cases=_pivot_systems,
    mistakes=(
        Mistake("nobody leaves", _pivoting(leave=False),
                "A force went below 0: stop where one of the pushing forces reaches 0, and take it out of the set."),
        Mistake("nobody joins", _pivoting(join=False),
                "A contact that was dealt with sinks in: stop where one of the resting w reaches 0, and let it join."),
        Mistake("the others hold still", _pivoting(whole=True),
                "While one force grows, those that push already must change with it to keep their w at 0."),
        Mistake("contacts that part are pressed", _pivoting(skip=False),
                "You bring w_k to 0 also where it is above 0. A contact that parts takes no force: leave it alone."),
    ),
    hints=(
        "Keep f, w and the list of those that push. While w_k < 0: find the direction and the first stop; go there.",
        "The pushing forces answer a unit of force at k by -A_CC^-1 A_Ck. The stops: w_k = 0; a pushing force with a "
        "falling change = 0; a resting w with a falling rate = 0. The smallest step wins.",
        "change[pushing] = -np.linalg.solve(a[np.ix_(pushing, pushing)], a[pushing, k])\nrate = a @ change\n"
        "stops = [(-w[k] / rate[k], k)]\nstops += [(____, i) for i in pushing if change[i] < 0]\n"
        "stops += [(____, i) for i in range(k) if i not in pushing and rate[i] < 0]\nstep, who = min(stops)",
    ),
)  # fmt: skip
