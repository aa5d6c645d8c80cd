"""Laws for many contacts at one instant, and springs, counted pass by pass.

Within an instant nothing moves, so every law and every spring works with two
arrays: the matrix A, whose entry a_ij says by how much an impulse of 1 N s at
contact j changes the normal velocity of contact i, and the normal velocities
u before the impact. After impulses p they are u + A p.

``course.contact.resolve_collisions`` is the solver to use; these count what
they do and can be stopped early, to be compared.
"""

from __future__ import annotations

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    failure,
    in_range,
    positive,
    scalar,
    scalars,
    shaped,
    whole_number,
)
from course.contact.collisions import APPROACHING


def impulses_in_turn(
    matrix: ArrayLike,
    normal_velocity: ArrayLike,
    restitution: float,
    *,
    passes: int = 1000,
) -> tuple[Array, int]:
    """Impulses of the sequential law and how often it went through all contacts.

    Each contact that approaches, u_i < 0, gets -(1 + e) u_i/a_ii as if it were alone, in the order given, until none
    approaches (below 1e-12 of the fastest at the start) or the passes are used up.

    Args:
        matrix: A, (c, c) [1/kg].
        normal_velocity: u, (c,) [m/s].
        restitution: e, from 0 to 1.
        passes: how many at most.
    """
    from course.contact.sequential_collisions import Passes

    a, u, e = _impact(matrix, normal_velocity, restitution)
    impulse, limit = np.zeros(u.size), -APPROACHING * max(-float(u.min()), 0.0)
    each = Passes(a)
    for used in range(whole_number("passes", passes)):
        now = u + a @ impulse
        if np.all(now >= limit):
            return impulse, used
        impulse += each.once(now, e, limit)
    return impulse, passes


def impulses_at_once(
    matrix: ArrayLike,
    normal_velocity: ArrayLike,
    restitution: float,
    *,
    sweeps: int = 1000,
) -> tuple[Array, int]:
    """Impulses of the simultaneous law by projected Gauss-Seidel, and the number of sweeps.

    p >= 0, w = A p + (1 + e) u >= 0, p.w = 0: contact by contact p_i becomes max(0, p_i - w_i/a_ii) (R. Cottle,
    J.-S. Pang, R. Stone, The Linear Complementarity Problem, section 5.2). Too few sweeps give a p that obeys no law.

    Args:
        matrix, normal_velocity, restitution: as for ``impulses_in_turn``.
        sweeps: how many.
    """
    from course.contact.solvers.projected_gauss_seidel import (
        solve_projected_gauss_seidel,
    )

    a, u, e = _impact(matrix, normal_velocity, restitution)
    found = solve_projected_gauss_seidel(
        a, (1 + e) * u, tolerance=-1.0, max_sweeps=sweeps
    )
    return found.force, sweeps


def impulses_by_springs(
    matrix: ArrayLike, normal_velocity: ArrayLike, *, exponent: float = 1.0
) -> Array:
    """Impulses of equal springs at all contacts, stiff enough that nothing else moves, nothing lost.

    delta' = -(u + A p), p' = max(delta, 0)^exponent, to ten digits, until all contacts have parted. 1 is a linear
    spring, 1.5 the contact of two elastic spheres (Hertz). The stiffness only changes the unit of time.

    Args:
        matrix: A, (c, c) [1/kg].
        normal_velocity: u, (c,) [m/s].
        exponent: at least 1.
    Raises:
        ValueError: wrong shapes, exponent below 1, contacts that do not come apart within 1,000 units of time.
    """
    from scipy.integrate import solve_ivp

    a, u, _ = _impact(matrix, normal_velocity, 1.0)
    power = scalar("exponent", exponent)
    if power < 1:
        raise failure("exponent", "at least 1", f"{power:g}")
    size = u.size

    def rate(_: float, state: Array) -> Array:
        return np.concatenate(
            [-(u + a @ state[size:]), np.maximum(state[:size], 0.0) ** power]
        )

    state = np.zeros(2 * size)
    for _ in range(500):
        state = solve_ivp(
            rate, (0.0, 2.0), state, method="DOP853", rtol=1e-10, atol=1e-12
        ).y[:, -1]
        if np.all(state[:size] <= 0) and np.all(u + a @ state[size:] >= 0):
            return np.asarray(state[size:])
    raise failure("normal_velocity", "contacts that come apart again", str(u))


def impulses_by_steps(
    matrix: ArrayLike, normal_velocity: ArrayLike, step: float
) -> tuple[Array, int]:
    """The linear springs of ``impulses_by_springs`` with a fixed step (symplectic Euler), and the number of steps.

    Args:
        matrix: A, (c, c) [1/kg].
        normal_velocity: u, (c,) [m/s].
        step: in units of (1 kg/k)^(1/2); unstable above 2/sqrt(largest eigenvalue of A).
    Raises:
        ValueError: wrong shapes, a step that never brings the contacts apart.
    """
    a, u, _ = _impact(matrix, normal_velocity, 1.0)
    h = float(positive("step", scalar("step", step)))
    squeeze, impulse = np.zeros(u.size), np.zeros(u.size)
    for count in range(1, 100_001):
        impulse += h * np.maximum(squeeze, 0.0)
        now = u + a @ impulse
        squeeze -= h * now
        if np.all(squeeze <= 0) and np.all(now >= 0):
            return impulse, count
    raise failure("step", "one that brings the contacts apart again", f"{h:g}")


def _impact(
    matrix: ArrayLike, velocity: ArrayLike, restitution: float
) -> tuple[Array, Array, float]:
    a, u = scalars("matrix", matrix), scalars("normal_velocity", velocity)
    if a.ndim != 2 or a.shape[0] != a.shape[1]:
        raise failure("matrix", "shape (c, c)", f"shape {a.shape}")
    shaped("normal_velocity", u, a.shape[:1])
    if np.any(np.diagonal(a) <= 0):
        raise failure("matrix", "a positive diagonal", str(np.diagonal(a).min()))
    return (
        a,
        u,
        float(in_range("restitution", scalar("restitution", restitution), 0, 1)),
    )
