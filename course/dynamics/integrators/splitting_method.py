"""Splitting: the motion in pieces that are each solved exactly, symmetrically composed.

With the principal moments I1 <= I2 <= I3 and the angular momentum l = R'L in
those axes, the energy of turning is

    T = |l|^2/(2 I2) + (1/I1 - 1/I2) l1^2/2 + (1/I3 - 1/I2) l3^2/2.

Each term alone turns the body evenly: the first about L in space by
h |L| / I2, the others about axes 1 and 3 of the body. The first commutes with
the other two, so the pieces that must alternate are only two (J. Touma and
J. Wisdom, Astron. J. 107, 1994, split a body into a symmetric top and a rest;
A. Dullweber, B. Leimkuhler and R. McLachlan, J. Chem. Phys. 107, 1997; F.
Fasso, J. Comput. Phys. 189, 2003, compares the ways to split). A symmetric
top has one of the two, and is turned exactly whatever the step.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course.arrays import Array, failure
from course.dynamics.bodies import Bodies
from course.dynamics.integrators.components import conjugated, exponential, multiplied, normalized, rotated
from course.dynamics.integrators.motion import Motion, PrincipalFrames, Wrench, step_and_time

#: Parts of a step, first half with the middle one, of symmetric compositions: M. Suzuki, Phys. Lett. A 146,
#: 1990 (order 4); W. Kahan and R.-C. Li, Math. Comp. 66, 1997 (6 and 8); all in Hairer, Lubich and Wanner,
#: *Geometric Numerical Integration*, section V.3.2.
_HALF_PARTS = {
    2: (1.0,),
    4: (1 / (4 - 4 ** (1 / 3)), 1 / (4 - 4 ** (1 / 3)), 1 - 4 / (4 - 4 ** (1 / 3))),
    6: (
        0.39216144400731413928,
        0.33259913678935943860,
        -0.70624617255763935981,
        0.08221359629355080023,
        0.79854399093482996340,
    ),
    8: (
        0.13020248308889008088,
        0.56116298177510838456,
        -0.38947496264484728641,
        0.15884190655515560090,
        -0.39590389413323757734,
        0.18453964097831570709,
        0.25837438768632204729,
        0.29501172360931029887,
        -0.60550853383003451170,
    ),
}

#: Bodies worked on together: their arrays stay in a processor's second cache.
_BLOCK = 4096

#: One even turn: about which principal axis (0 or 2), and for what part of the step.
Turn = tuple[int, float]


def splitting(
    bodies: Bodies,
    wrench: Wrench | None,
    step: float,
    *,
    time: float = 0.0,
    order: int = 2,
    velocity_dependent: bool = True,
) -> Bodies:
    """One step of the splitting method: free motion in even turns, the wrench as a kick in the middle.

    Half the free motion, p += h F and L += h tau, half the free motion. The
    step is its own inverse with -h, keeps L of a torque-free body untouched
    and its energy without drift, and takes a parabola and a symmetric top
    exactly. Source: the head of this module.

    Args:
        bodies, wrench, step, time: as in ``explicit_euler``.
        order: 2, or 4, 6, 8 by composing 5, 9, 17 steps of order 2. Above 2
            it holds where the wrench reads only positions, orientations and time.
        velocity_dependent: the kick reads the wrench twice, the second time
            with half the kick done, which order 2 needs where the wrench
            depends on velocities. False reads it once, and says that it does not.
    Returns:
        The bodies at time + step.
    Raises:
        ValueError: as ``explicit_euler``, and an order that is not there.
    """
    h, t = step_and_time(step, time)
    if isinstance(order, bool) or order not in _HALF_PARTS:
        raise failure("order", "one of " + ", ".join(map(str, _HALF_PARTS)), f"{order!r:.60}")
    half = _HALF_PARTS[order]
    parts = half + half[-2::-1]
    motion = Motion.of(bodies)
    if wrench is None:
        return _free(motion, _whole(parts), h).to_bodies()
    for before, part in zip((0.0, *parts), parts, strict=False):
        motion = _free(motion, _between(before, part), 0.5 * (before + part) * h, h)
        t += 0.5 * (before + part) * h
        motion = _kicked(motion, wrench, part * h, t, velocity_dependent)
    return _free(motion, _between(parts[-1], 0.0), 0.5 * parts[-1] * h, h).to_bodies()


def _whole(parts: Sequence[float]) -> list[Turn]:
    """The turns of a step without kicks: axes 1, 3, 1 for each part, neighbours joined."""
    turns: list[Turn] = []
    for before, part in zip((0.0, *parts), parts, strict=False):
        turns += [(0, 0.5 * (before + part)), (2, part)]
    return [*turns, (0, 0.5 * parts[-1])]


def _between(before: float, after: float) -> list[Turn]:
    """The turns between two kicks: the second half of one part and the first half of the next."""
    turns = [(2, 0.5 * before), (0, 0.5 * (before + after)), (2, 0.5 * after)]
    return [turn for turn in turns if turn[1]]


def _kicked(motion: Motion, wrench: Wrench, span: float, time: float, velocity_dependent: bool) -> Motion:
    def pushed(by: float) -> Motion:
        return motion.moved(
            momentum=motion.momentum + by * force, angular_momentum=motion.angular_momentum + by * torque
        )

    force, torque = motion.wrench(wrench, time)
    if velocity_dependent:
        force, torque = pushed(0.5 * span).wrench(wrench, time)
    return pushed(span)


def _free(motion: Motion, turns: Sequence[Turn], span: float, step: float | None = None) -> Motion:
    """Free motion for a time span; the turns are parts of the step, by default the span itself."""
    step = span if step is None else step
    q, frames = np.empty(motion.orientation.shape), motion.frames
    for first in range(0, len(motion.bodies), _BLOCK):
        here = slice(first, first + _BLOCK)
        axes = None if frames.axes is None else frames.axes[:, here]
        block = PrincipalFrames(frames.inverse_moments[:, here], frames.moments[:, here], axes)
        block_q, block_l = motion.orientation[:, here], motion.angular_momentum[:, here]
        q[:, here] = _turned(block_q, block_l, block, turns, span, step)
    if motion.fixed is not None:
        q = np.where(motion.fixed, motion.orientation, q)
    return motion.moved(position=motion.position + span * motion.velocity, orientation=q)


def _turned(
    orientation: Array,
    momentum: Array,
    frames: PrincipalFrames,
    turns: Sequence[Turn],
    span: float,
    step: float,
) -> Array:
    q = orientation if frames.axes is None else multiplied(orientation, frames.axes)
    body = rotated(conjugated(q), momentum)
    inverse = frames.inverse_moments
    x, y, z, w = np.array(q)
    half_rates = {axis: 0.5 * step * (inverse[axis] - inverse[1]) for axis in (0, 2)}
    for axis, part in turns:
        if axis == 0:
            _turn_evenly(part * half_rates[0] * body[0], body[1], body[2], (x, w, y, z))
        else:
            _turn_evenly(part * half_rates[2] * body[2], body[0], body[1], (z, w, x, y))
    q = multiplied(exponential(momentum * (span * inverse[1])), np.array([x, y, z, w]))
    return normalized(q if frames.axes is None else multiplied(q, conjugated(frames.axes)))


def _turn_evenly(half_angle: Array, next_: Array, last: Array, q: tuple[Array, Array, Array, Array]) -> None:
    """Turn the body about one of its axes, in place; ``next_`` and ``last`` are l along the two other axes.

    The quaternion is multiplied by (tan(angle/2) e, 1): one trigonometric function in place of two, and its
    length is put right at the end of the step.
    """
    tangent = np.tan(half_angle)
    cosine = 2.0 / (1.0 + tangent * tangent)
    sine = cosine * tangent
    cosine -= 1.0
    turned = cosine * next_ + sine * last
    last *= cosine
    last -= sine * next_
    next_[...] = turned
    for a, b in ((q[0], q[1]), (q[2], q[3])):
        change = tangent * a
        a += tangent * b
        b -= change
