"""How well differences of a function of time give its rates."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from course.arrays import Array, ArrayLike, failure, positive, scalar, scalars, written


@dataclass(frozen=True)
class Stencil:
    """A difference quotient: sum_k weight_k f(t + offset_k h) / h^derivative, with an error of order h^order.

    (B. Fornberg, "Generation of finite difference formulas on arbitrarily
    spaced grids", Mathematics of Computation 51, 1988.)
    """

    name: str
    offsets: tuple[float, ...]
    weights: tuple[float, ...]
    derivative: int
    order: int

    def difference(
        self, value: Callable[[float], float], time: float, step: float
    ) -> float:
        """The quotient for f = value at this time with step h."""
        h = scalar("step", positive("step", step))
        terms = [
            w * value(time + o * h)
            for o, w in zip(self.offsets, self.weights, strict=True)
        ]
        return float(sum(terms)) / h**self.derivative


FORWARD = Stencil("one-sided", (0, 1), (-1, 1), 1, 1)
CENTRAL = Stencil("central", (-1, 1), (-1 / 2, 1 / 2), 1, 2)
FIVE_POINTS = Stencil(
    "five points", (-2, -1, 1, 2), (1 / 12, -8 / 12, 8 / 12, -1 / 12), 1, 4
)
SECOND = Stencil("three points of d", (-1, 0, 1), (1, -2, 1), 2, 2)
SECOND_FIVE = Stencil(
    "five points of d",
    (-2, -1, 0, 1, 2),
    (-1 / 12, 16 / 12, -30 / 12, 16 / 12, -1 / 12),
    2,
    4,
)


@dataclass(frozen=True, eq=False)
class DifferenceErrors:
    """How far difference quotients are from a known rate, over the step.

    Args:
        step: h, (k,) [s].
        error: by the name of each stencil, (k,).
        unit: of the errors.
    """

    step: Array
    error: dict[str, Array]
    unit: str

    def best(self, name: str) -> tuple[float, float]:
        """The step with the least error of a stencil, and that error."""
        if name not in self.error:
            raise failure(
                "name", "one of " + ", ".join(map(repr, self.error)), written(name)
            )
        least = int(np.argmin(self.error[name]))
        return float(self.step[least]), float(self.error[name][least])


def difference_errors(
    tries: Sequence[tuple[Stencil, Callable[[float], float]]],
    exact: float,
    steps: ArrayLike,
    *,
    time: float = 0.0,
    unit: str = "m/s",
) -> DifferenceErrors:
    """The error of each difference quotient at each step: truncation falls with h, rounding grows as 1/h^derivative.

    Args:
        tries: stencils, each with the function of time that it is used on.
        exact: the rate in closed form.
        steps: h, (k,) [s].
        time: where the rate is wanted [s].
        unit: of the rate.
    """
    h = positive("steps", scalars("steps", steps))
    errors = {
        s.name: np.array([abs(s.difference(f, time, x) - exact) for x in h.tolist()])
        for s, f in tries
    }
    return DifferenceErrors(h, errors, unit)
