"""A ball that meets a wall: the whole way, before and after, under any law of the bounce."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.arrays import Array, ArrayLike, positive, scalar, shaped, vectors
from course.dynamics import wall_bounce
from course.study.asking import asked

#: v'(v, n, e), as lesson 11 asks.
BounceLaw = Callable[..., Array]


@dataclass(frozen=True, eq=False)
class WallMeeting:
    """A ball and a fixed wall through the origin, in the plane of x and y.

    Args:
        normal, along: unit vectors out of the wall and along it, (3,).
        before, after: velocities, (3,) [m/s].
        meeting: when it touches the wall, inf if it does not approach [s].
        times: (4,) [s]; the moment of the bounce stands twice.
        position, velocity: at these times, (4, 3) [m], [m/s].
    """

    normal: Array
    along: Array
    before: Array
    after: Array
    meeting: float
    times: Array
    position: Array
    velocity: Array


def wall_meeting(
    wall_angle: float,
    velocity: ArrayLike,
    restitution: float,
    *,
    law: BounceLaw = wall_bounce,
    radius: float = 0.2,
    meeting: float = 1.0,
    duration: float = 2.2,
) -> WallMeeting:
    """The ball until it touches the wall at the origin, and after it.

    A ball that does not approach touches the wall at the start, and no law is asked.

    Args:
        wall_angle: of the wall's surface from x [degrees].
        velocity: it comes with, (3,), third component 0 [m/s].
        restitution: e.
        law: of the bounce.
        radius: of the ball [m].
        meeting, duration: when it touches, and the end [s].
    Raises:
        UnusableResult: a law that gives anything but one velocity.
    """
    angle = np.radians(scalar("wall_angle", wall_angle))
    normal = np.array([-np.sin(angle), np.cos(angle), 0.0])
    along = np.array([np.cos(angle), np.sin(angle), 0.0])
    before = vectors("velocity", velocity)
    shaped("velocity", before, (3,))
    touch = float(positive("radius", radius)) * normal
    approaches = bool(before @ normal < 0)
    after = before
    if approaches:
        (after,) = asked(law, ((3,),), before, normal, restitution)
    times = np.array([0.0, meeting, meeting, duration])
    start = touch - meeting * before if approaches else touch
    there = start + meeting * before
    position = np.array([start, there, there, there + (duration - meeting) * after])
    moved = np.array([before, before, after, after])
    when = meeting if approaches else np.inf
    return WallMeeting(normal, along, before, after, when, times, position, moved)


def mirrored(velocity: Array, normal: Array, restitution: float) -> Array:
    """The bounce of the slide, v - 2 (v.n) n: right at e = 1 only (misprint 4)."""
    return wall_bounce(velocity, normal, 1.0)
