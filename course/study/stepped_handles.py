"""The handle of lesson 09 as a function of somebody's own moves it: by its steps, or by its acceleration."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from course import formulas
from course.arrays import Array
from course.dynamics import Bodies
from course.scenes import handle_mass_properties, spinning_handle
from course.scenes.spinning import HANDLE_CENTERS, HANDLE_HALF_EXTENTS
from course.study.asking import RUN_AWAY, UnusableResult, asked

#: How the spring is stretched at the start [m].
STRETCH = np.array([0.04, 0.0, 0.04])
#: An R whose columns are farther than this from a right-angled trihedron is not drawn any more.
CROOKED = 0.5
NONE = np.zeros(3)


@dataclass(frozen=True, eq=False)
class SteppedHandle:
    """One handle, step by step.

    Args:
        times: (t,) [s].
        position: of its centre, (t, 3) [m].
        rotation: (t, 3, 3), columns its axes in the world.
        angular_velocity, angular_momentum: (t, 3) [rad/s], [kg m^2/s].
        energy: kinetic and that of the spring, (t,) [J].
        held: where the spring is fastened to it and to the world at each time,
            (t, 2, 3) [m].
    """

    times: Array
    position: Array
    rotation: Array
    angular_velocity: Array
    angular_momentum: Array
    energy: Array
    held: Array


def spring_arm() -> Array:
    """From the centre to the middle of the stem's free end, in body axes, (3,) [m]."""
    end = HANDLE_CENTERS[1] + HANDLE_HALF_EXTENTS[1] * [0.0, 1.0, 0.0]
    return np.asarray(end - handle_mass_properties().centre)


def by_steps(
    step: float,
    duration: float,
    stiffness: float,
    *,
    tilt: float,
    arm: Array | None = None,
    function: Callable[..., Any] = formulas.symplectic_euler_step,
) -> SteppedHandle:
    """The handle, spinning about its stem, on a spring, by ``symplectic_euler_step`` or another step.

    Args:
        step, duration: [s].
        stiffness: of the spring [N/m]; 0: it is free.
        tilt: of L from the stem at the start [rad].
        arm: where the spring is fastened, in body axes (3,) [m]; none: at the stem's end.
        function: (x, R, p, L, mass, I_body, force, torque, h) -> x, R, p, L.
    Raises:
        UnusableResult: what it gives is not x, R, p and L.
    """
    bodies = spinning_handle(tilt=tilt).bodies
    fastened = spring_arm() if arm is None else arm
    state: tuple[Array, ...] = (
        np.zeros(3), bodies.rotation[0], np.zeros(3), bodies.angular_momentum[0]
    )  # fmt: skip
    anchor = state[1] @ fastened + STRETCH
    mass, inertia = float(bodies.mass[0]), bodies.inertia[0]
    states = [state]
    for _ in range(round(duration / step)):
        if _usable(*state):
            x, turned, p, momentum = state
            lever = turned @ fastened
            force = -stiffness * (x + lever - anchor)
            given = x, turned, p, momentum, mass, inertia, force, np.cross(lever, force)
            state = asked(function, ((3,), (3, 3), (3,), (3,)), *given, step)
        states.append(state if _usable(*state) else states[-1])
    x, turned, p, momentum = (np.array(part) for part in zip(*states, strict=True))
    held = np.stack([x + turned @ fastened, np.broadcast_to(anchor, x.shape)], axis=1)
    stretched = np.sum((held[:, 0] - held[:, 1]) ** 2, axis=-1)
    more = 0.5 * np.sum(p**2, axis=-1) / mass + 0.5 * stiffness * stretched
    return _handle(step, x, turned, momentum, inertia, more, held)


def by_body_momentum(
    step: float,
    duration: float,
    *,
    tilt: float,
    function: Callable[..., Any] = formulas.rk4_step,
) -> SteppedHandle:
    """The free handle by ``rk4_step`` of l in body axes, each step turned by the mean of its two omegas.

    Args:
        step, duration, tilt: as in ``by_steps``.
        function: (l, I_body, h) -> l.
    """
    bodies = spinning_handle(tilt=tilt).bodies
    inertia, turned = bodies.inertia[0], bodies.rotation[0]
    l_body = turned.T @ bodies.angular_momentum[0]
    states = [(turned, l_body)]
    for _ in range(round(duration / step)):
        (after,) = asked(function, ((3,),), l_body, inertia, step)
        if _usable(after):
            omega = np.linalg.solve(inertia, 0.5 * (l_body + after))
            turned, l_body = turned @ _turn(step * omega), after
        states.append((turned, l_body))
    rotation, l_all = (np.array(part) for part in zip(*states, strict=True))
    momentum = np.einsum("tij,tj->ti", rotation, l_all)
    return _still(step, rotation, momentum, inertia)


def by_acceleration(
    step: float,
    duration: float,
    *,
    tilt: float,
    function: Callable[..., Any] = formulas.angular_acceleration,
) -> SteppedHandle:
    """The free handle by omega_dot of ``angular_acceleration``, in midpoint steps of omega and R.

    Args:
        step, duration, tilt: as in ``by_steps``.
        function: (I, L, torque) -> omega_dot, all in world axes.
    """
    bodies: Bodies = spinning_handle(tilt=tilt).bodies
    inertia, turned = bodies.inertia[0], bodies.rotation[0]
    omega = bodies.angular_velocity[0]

    def rate(turned: Array, omega: Array) -> Array:
        world = turned @ inertia @ turned.T
        return asked(function, ((3,),), world, world @ omega, NONE)[0]

    states = [(turned, omega)]
    for _ in range(round(duration / step)):
        if np.abs(omega).max() < RUN_AWAY:
            middle = omega + 0.5 * step * rate(turned, omega)
            half = _turn(0.5 * step * omega) @ turned
            turned, omega = (
                _turn(step * middle) @ turned,
                omega + step * rate(half, middle),
            )
        states.append((turned, omega))
    rotation, spins = (np.array(part) for part in zip(*states, strict=True))
    seen = np.einsum("tji,tj->ti", rotation, spins) @ inertia
    return _still(step, rotation, np.einsum("tij,tj->ti", rotation, seen), inertia)


def by_inertia(
    step: float,
    duration: float,
    *,
    tilt: float,
    function: Callable[..., Any] = formulas.world_inertia,
) -> SteppedHandle:
    """The free handle with L as it is and omega = I^-1 L of ``world_inertia``, in midpoint steps of R.

    Args:
        step, duration, tilt: as in ``by_steps``.
        function: (R, I_body) -> I in world axes.
    """
    bodies = spinning_handle(tilt=tilt).bodies
    inertia, turned = bodies.inertia[0], bodies.rotation[0]
    momentum = bodies.angular_momentum[0]

    def omega(turned: Array) -> Array:
        world = asked(function, ((3, 3),), turned, inertia)[0]
        return np.linalg.solve(world, momentum)

    states = [turned]
    for _ in range(round(duration / step)):
        half = _turn(0.5 * step * omega(turned)) @ turned
        turned = _turn(step * omega(half)) @ turned
        states.append(turned)
    rotation = np.array(states)
    return _still(step, rotation, np.tile(momentum, (len(states), 1)), inertia)


def by_free_acceleration(function: Callable[..., Any]) -> Callable[..., Array]:
    """``angular_acceleration_free``, (I^-1, L, omega, torque), with the arguments of the other."""

    def acceleration(world: Array, momentum: Array, torque: Array) -> Array:
        inverse = np.linalg.inv(world)
        return asked(function, ((3,),), inverse, momentum, inverse @ momentum, torque)[
            0
        ]

    return acceleration


def without_gyration(world: Array, momentum: Array, torque: Array) -> Array:
    """omega_dot = I^-1 tau, of tau = I omega_dot as it is printed (misprint 10): nothing turns over."""
    return np.asarray(np.linalg.solve(world, torque))


def without_cross(
    inverse: Array, momentum: Array, omega: Array, torque: Array
) -> Array:
    """omega_dot = I^-1 tau + I^-1 L, as it is printed (misprint 9): it spins ever faster."""
    return inverse @ torque + inverse @ momentum


def _usable(*state: Array) -> bool:
    """Whether it is near, and its R, where there is one, still looks like a rotation."""
    near = all(np.abs(part).max() < RUN_AWAY for part in state)
    turns = [part for part in state if part.ndim == 2]
    return near and all(np.abs(r.T @ r - np.eye(3)).max() < CROOKED for r in turns)


def _turn(angle: Array) -> Array:
    return np.asarray(Rotation.from_rotvec(angle).as_matrix())


def _still(
    step: float, rotation: Array, momentum: Array, inertia: Array
) -> SteppedHandle:
    """A free handle, whose centre stands."""
    none = np.zeros((len(rotation), 3))
    held = np.zeros((len(rotation), 2, 3))
    return _handle(step, none, rotation, momentum, inertia, none[:, 0], held)


def _handle(
    step: float, x: Array, turned: Array, momentum: Array, inertia: Array, more: Array, held: Array
) -> SteppedHandle:  # fmt: skip
    if np.linalg.det(turned).min() < 0:
        raise UnusableResult("its R turns the handle inside out: det R is below 0")
    world = turned @ inertia @ np.swapaxes(turned, -1, -2)
    omega: Array = np.asarray(np.linalg.solve(world, momentum[..., None])[..., 0])
    energy = 0.5 * np.sum(momentum * omega, axis=-1) + more
    times: Array = step * np.arange(len(x), dtype=float)
    return SteppedHandle(times, x, turned, omega, momentum, energy, held)
