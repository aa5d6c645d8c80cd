"""Orders, growth and thresholds, measured from what a method does and not from its formula."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    BoolArray,
    broadcast,
    failure,
    non_negative,
    positive,
    scalar,
    shaped,
    whole_number,
    written,
)
from course.dynamics import Bodies, Wrench
from course.rotations import identity


class Integrator(Protocol):
    """A step in time with the house's signature."""

    def __call__(
        self, bodies: Bodies, wrench: Wrench | None, step: float, *, time: float = 0.0
    ) -> Bodies: ...


def measured_order(steps: ArrayLike, errors: ArrayLike) -> float:
    """The order p of error ~ step^p: the slope of log(error) over log(step), by least squares.

    Args:
        steps: (k,), at least two different ones.
        errors: (k,), above 0; leave out those that rounding made.
    Raises:
        ValueError: other shapes, an error that is 0, steps all alike.
    """
    h, e = positive("steps", steps), positive("errors", errors)
    return _slope("steps", np.log(h), e)


def growth_rate(times: ArrayLike, sizes: ArrayLike) -> float:
    """sigma of size ~ exp(sigma t): the slope of log(size) over time, by least squares [1/s].

    Args:
        times: (k,) [s], at least two different ones.
        sizes: (k,), above 0, of a wobble or an error.
    """
    return _slope("times", np.asarray(times, dtype=float), positive("sizes", sizes))


def growth_per_step(values: ArrayLike) -> Array:
    """The factor by which a value is multiplied in one step, on average: (last/first)^(1/(k-1)).

    Args:
        values: the value at the start and after each step, (..., k), above 0, k at least 2.
    Returns:
        (...).
    """
    v = positive("values", values)
    if v.ndim == 0 or v.shape[-1] < 2:
        raise failure("values", "at least 2 along the last axis", f"shape {v.shape}")
    return np.exp((np.log(v[..., -1]) - np.log(v[..., 0])) / (v.shape[-1] - 1))


def find_threshold(
    is_stable: Callable[[float], bool],
    lower: float,
    upper: float,
    *,
    tolerance: float = 1e-3,
) -> float:
    """Where a method stops being stable as a knob grows, by bisection.

    Args:
        is_stable: says whether a run at this value of the knob stays bounded.
        lower: a value that is stable, above 0.
        upper: a larger one that is not.
        tolerance: how wide the last bracket may be, as a part of its middle.
    Returns:
        The middle of the last bracket.
    Raises:
        ValueError: the lower value is not stable, or the upper one is.
    """
    low, high, width = (
        scalar("lower", lower),
        scalar("upper", upper),
        scalar("tolerance", tolerance),
    )
    if not 0 < low < high:
        raise failure(
            "lower",
            "a value above 0 and below upper",
            f"{written(low)} with upper {written(high)}",
        )
    if not width > 0:
        raise failure("tolerance", "a positive number", written(width))
    if not is_stable(low):
        raise failure(
            "lower", "a value that is stable", f"{written(low)}, which is not"
        )
    if is_stable(high):
        raise failure(
            "upper", "a value that is not stable", f"{written(high)}, which is"
        )
    while high - low > width * 0.5 * (low + high):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if is_stable(middle) else (low, middle)
    return 0.5 * (low + high)


def oscillator_growth(
    method: Integrator,
    frequency_step: ArrayLike,
    *,
    damping_ratio: ArrayLike = 0.0,
    steps: int = 1000,
) -> Array:
    """By what factor a step multiplies the energy of an oscillator x_ddot = -w^2 x - 2 z w x_dot, on average.

    Measured by running the method, all oscillators as one set of bodies with
    masses 1 and a step of 1 s. After each step every oscillator is brought
    back to energy 1, which changes nothing for a linear one and lets a run
    past its threshold go on without overflow.

    Args:
        method: a step in time.
        frequency_step: x = h w, (...), above 0.
        damping_ratio: z, (...), 0 for none.
        steps: how many.
    Returns:
        The factor, (...); above 1 the method makes energy. Energy that only
        swings, as symplectic Euler's does, leaves a trace of order 1/steps.
    """
    x, z = (
        positive("frequency_step", frequency_step),
        non_negative("damping_ratio", damping_ratio),
    )
    batch = broadcast(frequency_step=(x, 0), damping_ratio=(z, 0))
    count = whole_number("steps", steps, minimum=1)
    w, z = np.broadcast_to(x, batch).ravel(), np.broadcast_to(z, batch).ravel()

    def wrench(bodies: Bodies, time: float) -> tuple[Array, Array]:
        force = (
            -((w**2)[:, None]) * bodies.position
            - (2 * z * w)[:, None] * bodies.momentum
        )
        return force, np.zeros(force.shape)

    bodies = _oscillators(w)
    logarithm = np.zeros(w.size)
    for k in range(count):
        bodies = method(bodies, wrench, 1.0, time=float(k))
        size = np.hypot(w * bodies.position[:, 0], bodies.momentum[:, 0])
        logarithm += 2 * np.log(size)
        bodies = replace(
            bodies,
            position=bodies.position / size[:, None],
            momentum=bodies.momentum / size[:, None],
        )
    return np.exp(logarithm / count).reshape(batch)[()]


def _oscillators(frequency: Array) -> Bodies:
    """Bodies of mass 1 that start with energy 1, one for each frequency, (n,) [1/s]."""
    n = frequency.size
    # Not along an axis of the phase plane, where a first step may be special.
    start = np.array([math.cos(1.0), 0.0, 0.0])
    one, none = np.broadcast_to(np.eye(3), (n, 3, 3)), np.zeros((n, 3))
    momentum = np.broadcast_to(start * math.tan(1.0), (n, 3))
    place = start / frequency[:, None]
    return Bodies(np.ones(n), one, place, identity(n), momentum, none)


@dataclass(frozen=True, eq=False)
class StabilityMap:
    """Growth per step of several methods over one knob.

    Args:
        method: names, m of them.
        knob_name: what is swept, with its unit.
        knob: (k,), ascending.
        growth: (m, k), factor a step; above 1 unstable.
    """

    method: tuple[str, ...]
    knob_name: str
    knob: Array
    growth: Array

    def stable(self, *, slack: float = 1e-2) -> BoolArray:
        """Mask (m, k): growth at most 1 + slack. A finite run cannot tell less than about 10/steps from none."""
        return self.growth <= 1 + slack

    def thresholds(self, *, slack: float = 1e-2) -> Array:
        """The largest knob up to which each method is stable throughout, (m,): 0 where it never is."""
        stable = np.logical_and.accumulate(self.stable(slack=slack), axis=1)
        return np.where(
            stable.any(axis=1), self.knob[np.maximum(stable.sum(axis=1) - 1, 0)], 0.0
        )

    def table(self) -> list[dict[str, Any]]:
        """One dictionary for each method and knob."""
        return [
            {"method": name, "knob": float(x), "growth": float(g)}
            for name, row in zip(self.method, self.growth, strict=True)
            for x, g in zip(self.knob, row, strict=True)
        ]


def stability_map(
    methods: Mapping[str, Callable[[Array], ArrayLike]],
    knob: ArrayLike,
    *,
    knob_name: str,
) -> StabilityMap:
    """Measure the growth per step of every method at every value of a knob.

    Args:
        methods: a name and a function of all knobs (k,) that gives the growth per step (k,), for
            instance ``lambda x: oscillator_growth(rk4, x)``.
        knob: (k,), ascending.
        knob_name: what it is, with its unit, for the axis of a chart.
    Raises:
        ValueError: no methods, a knob that does not ascend, growth of another shape or below 0.
    """
    values = positive("knob", knob)
    if values.ndim != 1 or not values.size or np.any(np.diff(values) <= 0):
        raise failure(
            "knob", "ascending numbers of shape (k,)", written(values.tolist())
        )
    if not methods:
        raise failure("methods", "at least one", "none")
    rows = []
    for name, measure in methods.items():
        row = non_negative(f"growth of {name}", measure(values), infinite=True)
        shaped(f"growth of {name}", row, values.shape)
        rows.append(row)
    return StabilityMap(tuple(methods), knob_name, values, np.array(rows))


def _slope(name: str, abscissa: Array, values: Array) -> float:
    if abscissa.ndim != 1 or abscissa.size < 2 or np.ptp(abscissa) == 0:
        raise failure(
            name, "at least two different ones, shape (k,)", f"shape {abscissa.shape}"
        )
    if values.shape != abscissa.shape:
        raise failure(
            "values", f"shape {abscissa.shape} as {name}", f"shape {values.shape}"
        )
    return float(np.polyfit(abscissa, np.log(values), 1)[0])
