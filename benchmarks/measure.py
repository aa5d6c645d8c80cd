"""Time two pieces of work against each other in one run."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """One line of the table: what was measured, the ratio, the goal for it (None: reported only), and a remark.

    A row without a figure (a peer that is not installed) has ratio NaN and says why in the remark.
    """

    name: str
    ratio: float
    goal: float | None
    remark: str = ""


def seconds(work: Callable[[], object], *, repeats: int = 5) -> float:
    """The best time of ``repeats`` runs after one that is not timed: others on the machine only slow a run down."""
    work()
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


def ratio(
    reference: Callable[[], object], ours: Callable[[], object], *, repeats: int = 5
) -> tuple[float, float, float]:
    """(reference time / our time, reference seconds, our seconds), timed in turn: both meet the same load."""
    reference()
    ours()
    best_reference = best_ours = float("inf")
    for _ in range(repeats):
        best_reference = min(best_reference, _once(reference))
        best_ours = min(best_ours, _once(ours))
    return best_reference / best_ours, best_reference, best_ours


def _once(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start
