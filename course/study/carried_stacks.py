"""A stack of boxes that is carried for a moment by the contact forces which somebody's own function gives."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import Array
from course.scenes import GRAVITY, stack
from course.study.asking import RUN_AWAY, UnusableResult, asked

#: Sweeps of projected Gauss-Seidel, which its exercise leaves to the caller.
SWEEPS = 1500
#: Forces (c,) [N] for a matrix A (c, c) and b (c,); c contacts from below.
Solver = Callable[[Array, Array], Array]


@dataclass(frozen=True, eq=False)
class CarriedStack:
    """Boxes, each on one point of that below, under forces that stay as they are from time 0 on.

    Args:
        times: (t,) [s].
        force: under each box, from below, (n,) [N].
        height: of their centres, (t, n) [m].
        gap: under each, d, (t, n) [m].
        acceleration: d_ddot at the start, (n,) [m/s^2].
    """

    times: Array
    force: Array
    height: Array
    gap: Array
    acceleration: Array


def carried_stack(
    count: int, top: float, times: Array, solver: Solver | None = None
) -> CarriedStack:
    """``course.scenes.stack`` of boxes of 1 kg, the topmost of ``top`` [kg], carried by these forces.

    A box rises with (f_k - f_(k+1))/m_k - g: nothing of A and b is in it.

    Args:
        count: n boxes.
        solver: whose forces; none: each carries all that stands above it.
    """
    mass = np.ones(count)
    mass[-1] = top
    scene = stack(count, mass=mass, corners=1)
    system = scene.system()
    force = (
        np.asarray(scene.truth)
        if solver is None
        else solver(system.A.toarray(), system.b)
    )
    rise = (force - np.append(force[1:], 0.0)) / mass - GRAVITY
    way = 0.5 * times[:, None] ** 2
    acceleration = np.diff(rise, prepend=0.0)
    height = scene.bodies.position[:count, 2] + way * rise
    return CarriedStack(times, force, height, way * acceleration, acceleration)


def by_solver(function: Callable[..., Any]) -> Solver:
    """Forces of ``solve_contact_qp`` or ``pivot``, f(A, b)."""

    def forces(a: Array, b: Array) -> Array:
        (force,) = asked(function, (b.shape,), a, b)
        if np.abs(force).max() > RUN_AWAY:
            raise UnusableResult("it runs away: no box is carried by such forces")
        return force

    return forces


def by_sweeps(function: Callable[..., Any]) -> Solver:
    """Forces of ``projected_gauss_seidel`` from 0 on, f(A, b, start, sweeps)."""
    return by_solver(lambda a, b: function(a, b, np.zeros(len(b)), SWEEPS))
