"""Inputs, small algebra and wrong versions for exercises on bodies that turn.

Turned bodies whose inertia is not diagonal, L off omega, a step that is not small: each of them tells apart mistakes
that agree where it is missing. Rotations have few decimals: those of whole quaternions of squared length 25.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

_WHOLE = np.array([(1, 2, 2, 4), (2, 1, 4, 2), (4, 2, 1, 2), (2, 4, 2, 1), (2, 2, 4, 1), (4, 1, 2, 2)])


def rotation_matrices(rng: np.random.Generator, shape: tuple[int, ...]) -> np.ndarray:
    q = rng.choice(_WHOLE, shape) * rng.choice([-1, 1], (*shape, 4))
    w, x, y, z = np.moveaxis(q, -1, 0)
    rows = [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1)) / 25.0


def inertias(rng: np.random.Generator, shape: tuple[int, ...]) -> np.ndarray:
    """Symmetric, with moments of 1 to 4 and products that are not zero."""
    upper = np.triu(rng.uniform(0.1, 0.3, (*shape, 3, 3)), 1).round(2)
    moments = (np.array([1.0, 2.0, 3.0]) + rng.uniform(0.0, 0.8, (*shape, 3))).round(2)
    return upper + np.swapaxes(upper, -1, -2) + moments[..., None] * np.eye(3)


def drawn_vectors(rng: np.random.Generator, shape: tuple[int, ...], size: float = 1.0) -> np.ndarray:
    return (size * rng.uniform(0.3, 1.5, (*shape, 3)) * rng.choice([-1, 1], (*shape, 3))).round(2)


def times(matrix: Any, vector: Any) -> np.ndarray:
    return np.einsum("...ij,...j->...i", np.asarray(matrix), np.asarray(vector))


def solved(matrix: Any, vector: Any) -> np.ndarray:
    return np.linalg.solve(np.asarray(matrix), np.asarray(vector)[..., None])[..., 0]


def turned_inertia(rotation: Any, inertia: Any) -> np.ndarray:
    return rotation @ inertia @ np.swapaxes(rotation, -1, -2)


def transposed(matrix: Any) -> np.ndarray:
    return np.swapaxes(matrix, -1, -2)


def exponential(theta: Any) -> np.ndarray:
    """The rotation matrix of a turn by |theta| about theta, by Rodrigues' formula."""
    theta = np.asarray(theta, dtype=float)
    angle = np.linalg.norm(theta, axis=-1)[..., None, None]
    x, y, z = np.moveaxis(theta, -1, 0)
    none = np.zeros(x.shape)
    cross = np.moveaxis(np.array([[none, -z, y], [z, none, -x], [-y, x, none]]), (0, 1), (-2, -1))
    return np.eye(3) + np.sinc(angle / np.pi) * cross + 0.5 * np.sinc(angle / (2 * np.pi)) ** 2 * cross @ cross


def plain_step(
    *,
    x_from: str = "new",
    turn_from: str = "new",
    divide: bool = True,
    frame: str = "world",
    pushed: bool = True,
    twisted: bool = True,
    timed: bool = True,
    turned: Callable[[np.ndarray, np.ndarray, float], np.ndarray] = lambda R, omega, h: exponential(h * omega) @ R,
) -> Callable[..., Any]:
    """A step with the slips that the options say; none of them is symplectic Euler."""

    def function(x: Any, R: Any, p: Any, L: Any, mass: Any, I_body: Any, force: Any, torque: Any, h: float) -> Any:
        x, R, p, L = (np.asarray(a, dtype=float) for a in (x, R, p, L))
        span = h if timed else 1.0
        p_new = p + (span * np.asarray(force) if pushed else 0.0)
        L_new = L + (span * np.asarray(torque) if twisted else 0.0)
        moving, spinning = (p_new if x_from == "new" else p), (L_new if turn_from == "new" else L)
        velocity = moving / np.asarray(mass)[..., None] if divide else moving
        omega = {
            "world": lambda: solved(turned_inertia(R, I_body), spinning),
            "body": lambda: solved(I_body, spinning),
            "half": lambda: solved(I_body, times(transposed(R), spinning)),
        }[frame]()
        return x + h * velocity, turned(R, omega, h), p_new, L_new

    return function


def first_order(R: np.ndarray, omega: np.ndarray, h: float) -> np.ndarray:
    return R + h * np.cross(omega[..., None, :], transposed(R)).swapaxes(-1, -2)


def one_batch_axis_short(
    x: Any, R: Any, p: Any, L: Any, mass: Any, I_body: Any, force: Any, torque: Any, h: float
) -> Any:
    p_new, L_new = p + h * np.asarray(force), L + h * np.asarray(torque)
    omega = solved(turned_inertia(R, I_body), L_new)
    return x + h * p_new / mass, exponential(h * omega) @ R, p_new, L_new


def rodrigues(*, sign: float = 1.0, across: float = 1.0, half: float = 1.0, unit: bool = True) -> Callable[..., Any]:
    """Rodrigues' formula with slips: the turn's sense, the last term, half the angle, an axis not of unit length."""

    def function(v: Any, theta: Any) -> np.ndarray:
        v, theta = np.asarray(v, dtype=float), np.asarray(theta, dtype=float)
        angle = np.linalg.norm(theta, axis=-1, keepdims=True)
        axis = theta / np.where(angle > 0, angle, 1.0) if unit else theta
        angle = half * angle
        turned = np.cos(angle) * v + sign * np.sin(angle) * np.cross(axis, v)
        return turned + across * (1 - np.cos(angle)) * np.sum(axis * v, axis=-1, keepdims=True) * axis

    return function


def divided_by_zero(v: Any, theta: Any) -> np.ndarray:
    angle = np.linalg.norm(theta, axis=-1, keepdims=True)
    axis = np.asarray(theta) / angle
    turned = np.cos(angle) * v + np.sin(angle) * np.cross(axis, v)
    return turned + (1 - np.cos(angle)) * np.sum(axis * v, axis=-1, keepdims=True) * axis


def stretched(v: Any, theta: Any) -> np.ndarray:
    longer = np.asarray(v) + np.cross(theta, v)
    return longer


def brought_back(v: Any, theta: Any) -> np.ndarray:
    longer = stretched(v, theta)
    return longer * np.linalg.norm(v, axis=-1, keepdims=True) / np.linalg.norm(longer, axis=-1, keepdims=True)


def rate_of_l(l: Any, I_body: Any, sign: float = 1.0) -> np.ndarray:  # noqa: E741
    return sign * np.cross(l, solved(I_body, l))


def runge_kutta(nodes: Sequence[float], weights: Sequence[float], *, sign: float = 1.0) -> Callable[..., Any]:
    """Each stage ``nodes[i]`` h along the one before it; the step along the weighted stages."""

    def function(l: Any, I_body: Any, h: float) -> np.ndarray:  # noqa: E741
        start = np.asarray(l, dtype=float)
        stages = [rate_of_l(start, I_body, sign)]
        for node in nodes:
            stages.append(rate_of_l(start + node * h * stages[-1], I_body, sign))
        return start + h * sum(w * s for w, s in zip(weights, stages, strict=True))

    return function


def all_from_the_first(l: Any, I_body: Any, h: float) -> np.ndarray:  # noqa: E741
    start = np.asarray(l, dtype=float)
    k1 = rate_of_l(start, I_body)
    k2 = k3 = rate_of_l(start + 0.5 * h * k1, I_body)
    k4 = rate_of_l(start + h * k1, I_body)
    return start + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
