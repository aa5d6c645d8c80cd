"""Work-precision: for each method and each setting of its knob, the error reached and what it cost.

The chart of error against cost is the field's way to compare methods that can all be made better by working more
(Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I*, section II.10).
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from course.arrays import written

Cost = Literal["seconds", "count"]


@dataclass(frozen=True)
class Problem:
    """What is computed and how far an answer is from the truth.

    ``error(answer)`` returns a number >= 0 in ``unit`` (a dimensionless error has unit ""); ``truth`` says in words
    what it is measured against.
    """

    name: str
    error: Callable[[Any], float]
    unit: str
    truth: str


@dataclass(frozen=True)
class Method:
    """A way to compute the answer: ``run(knob)`` returns ``(answer, count)``, count being the work in ``count_unit``.

    ``knob_name`` says what the knob is (step, tolerance, ...); a method without one has a single knob value.
    """

    name: str
    run: Callable[[float], tuple[Any, int]]
    knobs: tuple[float, ...]
    knob_name: str = ""


@dataclass(frozen=True)
class WorkPrecision:
    """The measurements, one entry a run: method, knob, error, seconds (best of the repeats) and counted work."""

    problem: Problem
    count_unit: str
    method: tuple[str, ...]
    knob: np.ndarray
    error: np.ndarray
    seconds: np.ndarray
    count: np.ndarray

    def cost(self, by: Cost = "seconds") -> np.ndarray:
        """The cost of each run, shape (runs,), in seconds or in counted work."""
        if by not in ("seconds", "count"):
            raise ValueError(f"by: expected 'seconds' or 'count'; got {written(by)}")
        return self.seconds if by == "seconds" else self.count

    def front(self, by: Cost = "seconds") -> np.ndarray:
        """Mask (runs,) of the Pareto front: no other run has both less error and less cost."""
        cost = self.cost(by)
        better = (self.error[:, None] <= self.error) & (cost[:, None] <= cost)
        strictly = (self.error[:, None] < self.error) | (cost[:, None] < cost)
        return ~(better & strictly).any(axis=0) & np.isfinite(self.error)

    def pick(self, tolerance: float, by: Cost = "seconds") -> int | None:
        """Index of the cheapest run whose error is within ``tolerance``; None where there is none."""
        within = np.flatnonzero(self.error <= tolerance)
        return int(within[np.argmin(self.cost(by)[within])]) if within.size else None

    def table(self) -> list[dict[str, Any]]:
        """One dictionary a run, in the order measured."""
        columns = zip(
            self.method, self.knob, self.error, self.seconds, self.count, strict=True
        )
        return [
            {
                "method": m,
                "knob": float(k),
                "error": float(e),
                "seconds": float(s),
                "count": int(c),
            }
            for m, k, e, s, c in columns
        ]


def work_precision(
    problem: Problem, methods: Sequence[Method], *, count_unit: str, repeats: int = 3
) -> WorkPrecision:
    """Run every method at every knob; time each run as the best of ``repeats``, after one run that is not timed.

    The best, not the mean: other programs on the machine can only make a run slower. Runs of over a second are timed
    once. Raises ``ValueError`` for no methods, no knobs, or a negative or NaN error.
    """
    if not methods or any(not m.knobs for m in methods):
        raise ValueError(
            "methods: expected at least one, each with at least one knob; got none"
        )
    rows = [
        (m.name, knob, *_measure(problem, m, knob, repeats))
        for m in methods
        for knob in m.knobs
    ]
    names, knobs, errors, seconds, counts = zip(*rows, strict=True)
    return WorkPrecision(
        problem,
        count_unit,
        names,
        *(np.array(column, dtype=float) for column in (knobs, errors, seconds, counts)),
    )


def _measure(
    problem: Problem, method: Method, knob: float, repeats: int
) -> tuple[float, float, int]:
    start = time.perf_counter()
    answer, count = method.run(knob)
    best = time.perf_counter() - start
    error = float(problem.error(answer))
    if not error >= 0.0:
        raise ValueError(
            f"problem.error: expected a number >= 0; got {error} for {method.name} at {knob}"
        )
    for _ in range(repeats if best < 1.0 else 0):
        start = time.perf_counter()
        method.run(knob)
        best = min(best, time.perf_counter() - start)
    return error, best, count
