"""What contact solvers cost as the number of contacts grows, in seconds and in their own counted steps."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from course.arrays import Array, written
from course.contact import ContactSolution, ContactSystem

Solver = Callable[[ContactSystem], ContactSolution]


@dataclass(frozen=True, eq=False)
class SolverGrowth:
    """One row a method, one column a system; NaN where a method was not asked.

    Args:
        contacts: how many a system has, (k,), ascending.
        method: m names.
        seconds: best of the repeats, (m, k) [s].
        steps: sweeps, pivots or Newton systems, as the method counts, (m, k).
        residual: what was reached, (m, k).
    """

    contacts: Array
    method: tuple[str, ...]
    seconds: Array
    steps: Array
    residual: Array

    def exponent(self, name: str) -> float:
        """p of seconds ~ contacts^p, least squares of the logarithms over every system that the method was asked.

        Raises:
            ValueError: a method that is not among them, or was asked fewer than two systems.
        """
        if name not in self.method:
            raise ValueError(
                f"name: expected one of {', '.join(self.method)}; got {written(name)}"
            )
        row = self.seconds[self.method.index(name)]
        asked = np.isfinite(row)
        if np.count_nonzero(asked) < 2:
            raise ValueError(
                f"name: expected a method asked at least twice; got {written(name)}"
            )
        return float(np.polyfit(np.log(self.contacts[asked]), np.log(row[asked]), 1)[0])


def solver_growth(
    systems: Sequence[ContactSystem],
    methods: Mapping[str, Solver],
    *,
    up_to: Mapping[str, int] | None = None,
    repeats: int = 2,
) -> SolverGrowth:
    """Time every method on every system, as the best of ``repeats`` after one run that is not timed.

    Args:
        systems: by ascending number of contacts.
        methods: a name and ``lambda system: solve(system, method=...)``.
        up_to: the most contacts a method is asked, by name; all where none is given.
        repeats: timed runs; a first run of over a second is taken as it is.
    Raises:
        ValueError: no systems, no methods, or numbers of contacts that do not ascend.
    """
    contacts = np.array([len(s) for s in systems], dtype=float)
    if not systems or not methods:
        raise ValueError(
            "systems: expected at least one, and at least one method; got none"
        )
    if np.any(np.diff(contacts) <= 0):
        raise ValueError(
            f"systems: expected ascending numbers of contacts; got {contacts.tolist()}"
        )
    limits = up_to or {}
    rows = np.full((3, len(methods), len(systems)), np.nan)
    for i, (name, method) in enumerate(methods.items()):
        for k, system in enumerate(systems):
            if len(system) <= limits.get(name, len(system)):
                rows[:, i, k] = _measured(method, system, repeats)
    return SolverGrowth(contacts, tuple(methods), *rows)


def _measured(
    method: Solver, system: ContactSystem, repeats: int
) -> tuple[float, float, float]:
    start = time.perf_counter()
    found = method(system)
    best = time.perf_counter() - start
    for k in range(repeats if best < 1.0 else 0):
        start = time.perf_counter()
        found = method(system)
        elapsed = time.perf_counter() - start
        best = (
            elapsed if k == 0 else min(best, elapsed)
        )  # the first run may have loaded something
    return best, float(found.iterations), float(found.residual)
