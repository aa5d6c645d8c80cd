"""Tumbling bodies: batched steps against a loop of SciPy's DOP853, and what the house adds to bare arithmetic."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.measure import Row, ratio
from course.dynamics import Bodies, Wrench, advance, splitting, torque_free_motion
from course.dynamics.integrators.splitting_method import _CHAINS, _turns
from course.rotations import identity

COUNT, SAMPLE, DURATION, TARGET = 10_000, 40, 10.0, 1e-6

#: The torque on a needle along the third axis in a field along z, of this strength times the middle moment.
FIELD = 2.0


def rows() -> list[Row]:
    """The rows of this module."""
    bodies = tumbling_bodies(COUNT)
    return [_free(bodies), _driven(bodies), *_overhead()]


def tumbling_bodies(count: int, seed: int = 0, *, principal: bool = False) -> Bodies:
    """Boxes with half extents of 0.2 to 1 m, spinning at 2 to 6 rad/s; principal: least moment first."""
    rng = np.random.default_rng(seed)
    squares = rng.uniform(0.2, 1.0, (count, 3)) ** 2
    moments = (squares.sum(axis=1, keepdims=True) - squares) / 3
    if principal:
        moments.sort(axis=1)
    spin = rng.normal(size=(count, 3))
    spin *= rng.uniform(2.0, 6.0, (count, 1)) / np.linalg.norm(
        spin, axis=1, keepdims=True
    )
    at_rest = np.zeros((count, 3))
    inertia = moments[:, :, None] * np.eye(3)
    return Bodies(
        np.ones(count), inertia, at_rest, identity(count), at_rest, moments * spin
    )


def _free(bodies: Bodies) -> Row:
    exact = torque_free_motion(bodies, DURATION).orientation
    steps = _fewest_steps(
        lambda n: _angle(_batched(bodies, None, n).orientation, exact)
    )
    tolerance = _loosest_tolerance(
        lambda tol: _angle(_loop(bodies, 0.0, tol), exact[:SAMPLE])
    )
    return _race(
        bodies, 0.0, steps, tolerance, "free bodies, largest error of all", 80.0
    )


def _driven(bodies: Bodies) -> Row:
    sample = bodies[:SAMPLE]
    exact = _loop(bodies, FIELD, 1e-13)
    steps = _fewest_steps(
        lambda n: _angle(_batched(sample, _needles(sample), n).orientation, exact)
    )
    tolerance = _loosest_tolerance(lambda tol: _angle(_loop(bodies, FIELD, tol), exact))
    return _race(
        bodies,
        FIELD,
        steps,
        tolerance,
        f"driven by a field, largest error of {SAMPLE}",
        None,
    )


def _needles(bodies: Bodies) -> Wrench:
    strength = FIELD * np.median(np.diagonal(bodies.inertia, axis1=1, axis2=2), axis=1)

    def wrench(now: Bodies, time: float) -> tuple[np.ndarray, np.ndarray]:
        x, y, z, w = now.orientation.T
        force, torque = np.zeros((2, 3, len(now)))
        torque[0] = strength * 2 * (y * z - w * x)
        torque[1] = -strength * 2 * (x * z + w * y)
        return force.T, torque.T

    return wrench


def _race(
    bodies: Bodies,
    strength: float,
    steps: int,
    tolerance: float,
    name: str,
    goal: float | None,
) -> Row:
    loop = partial(_loop, bodies, strength, tolerance)
    ours = partial(_batched, bodies, _needles(bodies) if strength else None, steps)
    sampled, loop_seconds, our_seconds = ratio(loop, ours, repeats=7 if goal else 3)
    remark = (
        f"{COUNT} bodies, {DURATION:g} s to {TARGET:g} rad: splitting of order 6, {steps} steps, {our_seconds:.2f} s; "
        f"DOP853 at tolerance {tolerance:.1g}, {loop_seconds / SAMPLE * 1e3:.1f} ms a body, {SAMPLE} timed and scaled"
    )
    return Row(
        f"{name}: loop of DOP853 / batched",
        sampled * len(bodies) / SAMPLE,
        goal,
        remark,
    )


def _batched(bodies: Bodies, wrench: Wrench | None, steps: int) -> Bodies:
    return advance(
        bodies, wrench, DURATION / steps, steps, order=6, velocity_dependent=False
    )


def _fewest_steps(error: Callable[[int], float]) -> int:
    """The fewest steps, to 5 percent, with an error within the target."""
    steps = 40
    while error(steps) > TARGET:
        steps = int(1.3 * steps)
    while error(int(steps / 1.05)) <= TARGET:
        steps = int(steps / 1.05)
    return steps


def _loosest_tolerance(error: Callable[[float], float]) -> float:
    """The loosest tolerance, to a factor of 1.5, with an error within the target."""
    tolerance = 1e-4
    while error(tolerance) > TARGET:
        tolerance /= 1.5
    return tolerance


def _angle(q: np.ndarray, exact: np.ndarray) -> float:
    """The largest angle between two sets of orientations [rad]."""
    apart = np.minimum(
        np.linalg.norm(q - exact, axis=1), np.linalg.norm(q + exact, axis=1)
    )
    return float(np.max(4 * np.arcsin(apart / 2)))


def _loop(bodies: Bodies, field: float, tolerance: float) -> np.ndarray:
    """Orientations of the first bodies, one call of DOP853 each.

    Euler's equations and the quaternion in plain Python floats, which for 7 unknowns takes a third of the time
    of NumPy's calls on short arrays.
    """
    result = []
    for i in range(SAMPLE):
        moments = np.diagonal(bodies.inertia[i])
        start = np.concatenate([bodies.orientation[i], bodies.angular_momentum[i]])
        rates = _rates(*moments.tolist(), field * float(np.median(moments)))
        end = solve_ivp(
            rates, (0, DURATION), start, method="DOP853", rtol=tolerance, atol=tolerance
        ).y[:4, -1]
        result.append(end / np.linalg.norm(end))
    return np.array(result)


def _rates(
    i1: float, i2: float, i3: float, strength: float
) -> Callable[[float, np.ndarray], list[float]]:
    def rates(time: float, state: np.ndarray) -> list[float]:
        x, y, z, w, l1, l2, l3 = state.tolist()
        a, b, c = l1 / i1, l2 / i2, l3 / i3
        result = [
            0.5 * (w * a + y * c - z * b),
            0.5 * (w * b + z * a - x * c),
            0.5 * (w * c + x * b - y * a),
            -0.5 * (x * a + y * b + z * c),
            l2 * c - l3 * b,
            l3 * a - l1 * c,
            l1 * b - l2 * a,
        ]
        if strength:
            # The torque e3 x (strength z) in body axes: z of the world there is the third row of R.
            result[4] -= strength * 2 * (y * z + w * x)
            result[5] += strength * 2 * (x * z - w * y)
        return result

    return rates


def _overhead() -> list[Row]:
    # One step on, as in a run: a step leaves its arrays with the components first.
    bodies = splitting(tumbling_bodies(COUNT, principal=True), None, 0.1)
    q = [np.ascontiguousarray(c) for c in bodies.orientation.T]
    momentum = [np.ascontiguousarray(c) for c in bodies.angular_momentum.T]
    inverse = [
        1.0 / np.diagonal(bodies.inertia, axis1=1, axis2=2)[:, i] for i in range(3)
    ]
    made, each = [], 1e9 / len(bodies)
    for order in (2, 6):
        bare = partial(_bare_step, q, momentum, inverse, 0.1, _turns(_CHAINS[order]))
        if not np.allclose(
            np.array(bare()).T,
            splitting(bodies, None, 0.1, order=order).orientation,
            atol=1e-12,
        ):
            raise AssertionError("the bare arithmetic is not that of the step")
        quotient, ours, theirs = ratio(
            partial(splitting, bodies, None, 0.1, order=order), bare, repeats=20
        )
        remark = f"{ours * each:.0f} ns a body against {theirs * each:.0f}, {len(bodies)} bodies in principal axes"
        made.append(
            Row(
                f"cost of a free splitting step of order {order} / bare NumPy",
                quotient,
                None,
                remark,
            )
        )
    return made


def _bare_step(
    q: list[np.ndarray],
    momentum: list[np.ndarray],
    inverse: list[np.ndarray],
    step: float,
    turns: list[tuple[int, float]],
) -> list[np.ndarray]:
    """The turns of a step on seven arrays, as one would write them down: nothing checked, kept or copied for others."""
    x, y, z, w = q
    L1, L2, L3 = momentum
    a, b, c = 2 * (z * L2 - y * L3), 2 * (x * L3 - z * L1), 2 * (y * L1 - x * L2)
    body = [
        L1 + w * a + b * z - c * y,
        L2 + w * b + c * x - a * z,
        L3 + w * c + a * y - b * x,
    ]
    q = [x, y, z, w]
    for i, part in turns:
        j, k = (i + 1) % 3, (i + 2) % 3
        t = np.tan(0.5 * step * part * (inverse[i] - inverse[1]) * body[i])
        cosine = 2 / (1 + t * t)
        sine = cosine * t
        cosine -= 1
        body[j], body[k] = (
            cosine * body[j] + sine * body[k],
            cosine * body[k] - sine * body[j],
        )
        q[i], q[3] = q[i] + t * q[3], q[3] - t * q[i]
        q[j], q[k] = q[j] + t * q[k], q[k] - t * q[j]
    x, y, z, w = q
    half = 0.5 * step * inverse[1]
    size = np.sqrt(L1 * L1 + L2 * L2 + L3 * L3)
    s, cosine = np.sin(half * size) / size, np.cos(half * size)
    a, b, c = s * L1, s * L2, s * L3
    x, y, z, w = (
        cosine * x + a * w + b * z - c * y,
        cosine * y + b * w + c * x - a * z,
        cosine * z + c * w + a * y - b * x,
        cosine * w - a * x - b * y - c * z,
    )
    length = 1 / np.sqrt(x * x + y * y + z * z + w * w)
    return [x * length, y * length, z * length, w * length]
