"""Newton's cradle that goes on swinging: between two collisions all balls swing alike."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import Array, IntArray, positive, scalar, whole_number
from course.study.asking import RUN_AWAY, UnusableResult, asked
from course.study.ball_impacts import cradle


@dataclass(frozen=True, eq=False)
class SwingingCradle:
    """Balls on threads, colliding each time they are all back at the bottom.

    Args:
        half_period: from one collision to the next [s].
        velocity: right after each collision, (k + 1, n) [m/s]; row 0 before the first.
    """

    half_period: float
    velocity: Array

    def at(self, time: Array, collisions: IntArray) -> tuple[Array, Array]:
        """Displacements and velocities, (t, n) each [m], [m/s].

        Args:
            time: (t,) [s]; the first collision is at half a half period.
            collisions: how many there have been, (t,).
        """
        phase = np.pi * (time / self.half_period + 0.5 - collisions)
        speed = self.velocity[collisions]
        swing = self.half_period / np.pi * np.sin(phase)
        return swing[:, None] * speed, np.cos(phase)[:, None] * speed


def swinging_cradle(
    count: int,
    coming: int,
    restitution: float,
    *,
    law: str | Callable[[Array], Array],
    speed: float = 0.8,
    length: float = 1.0,
    gravity: float = 9.81,
    collisions: int = 4,
) -> SwingingCradle:
    """The first balls of a row let go together, and the row swinging on.

    For small swings every pendulum is back at the bottom after pi sqrt(length/gravity),
    whatever its speed, and with that speed turned round: so all balls collide at once
    again, and never in between, because a law leaves none that approach. Before the
    first collision it takes half of that time.

    Args:
        count: n balls.
        coming: how many of them are let go.
        restitution: e, from 0 to 1.
        law: of ``resolve_collisions``, or velocities (n,) after for those before.
        speed: of those at the bottom [m/s].
        length: of the threads [m].
        collisions: how many.
    """
    n, moving = whole_number("count", count, minimum=2), whole_number("coming", coming)
    fall = float(positive("length", scalar("length", length))) / gravity
    # Those let go are at rest a quarter of a period before they are at the bottom.
    rows = [np.where(np.arange(n) < moving, float(speed), 0.0)]
    for k in range(whole_number("collisions", collisions, minimum=1)):
        arriving = rows[-1] if k == 0 else -rows[-1]
        after = (
            cradle(arriving, law=law, restitution=restitution)
            if isinstance(law, str)
            else law(arriving)
        )
        rows.append(after)
    return SwingingCradle(float(np.pi * np.sqrt(fall)), np.array(rows))


def by_impulses(
    function: Callable[..., Any], restitution: float
) -> Callable[[Array], Array]:
    """A law for balls of 1 kg from ``simultaneous_impulses`` (A, u, e): p between neighbours.

    A is 2 on its diagonal and -1 beside it, u = v_(i+1) - v_i, and p pushes ball i back
    and ball i + 1 on.
    """

    def after(velocity: Array) -> Array:
        closing = np.diff(velocity)
        between = len(closing)
        matrix = 2 * np.eye(between) - np.eye(between, k=1) - np.eye(between, k=-1)
        (impulse,) = asked(function, (closing.shape,), matrix, closing, restitution)
        gone = velocity - np.diff(impulse, prepend=0.0, append=0.0)
        if np.abs(gone).max() > RUN_AWAY:
            raise UnusableResult("it runs away: ball after ball is faster")
        return np.asarray(gone)

    return after
