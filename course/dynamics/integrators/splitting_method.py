"""Splitting: the motion in pieces that are each solved exactly, symmetrically composed.

With the principal moments I1 <= I2 <= I3 and the angular momentum l = R'L in those
axes, the rotational energy is

    T = |l|^2/(2 I2) + (1/I3 - 1/I2) l3^2/2 + (1/I1 - 1/I2) l1^2/2.

Each term alone rotates the body uniformly: the first about L in space by h |L| / I2,
the others about axes 3 and 1 of the body. The first commutes with the other two, so
only two pieces must alternate (J. Touma and J. Wisdom, Astron. J. 107, 1994, split a
body into a symmetric top and a rest; A. Dullweber, B. Leimkuhler and R. McLachlan, J.
Chem. Phys. 107, 1997; F. Fasso, J. Comput. Phys. 189, 2003, compares the ways to
split). A symmetric top has one of the two, and is rotated exactly whatever the step.

A step is a chain of small steps "free motion: axis 3, axis 1; then the kick" and their
mirror images. R. McLachlan (SIAM J. Sci. Comput. 16, 1995) shows that one list of
lengths serves any number of pieces.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course.arrays import Array, failure, written
from course.dynamics.bodies import Bodies
from course.dynamics.integrators.components import (
    conjugated,
    multiplied,
    normalized,
    rotated,
    turn_about,
)
from course.dynamics.integrators.motion import (
    Motion,
    PrincipalFrames,
    Wrench,
    step_and_time,
)


def _chain(outer: Sequence[float], inner: Sequence[float]) -> tuple[float, ...]:
    """The lengths of a chain, from those of its outer and inner pieces in the first
    half.
    """
    lengths: list[float] = []
    for joined in (x for pair in zip(outer, inner, strict=True) for x in pair):
        lengths.append(joined - (lengths[-1] if lengths else 0.0))
    return (*lengths, *reversed(lengths))


def _of_steps(parts: Sequence[float]) -> tuple[float, ...]:
    """The chain of steps of order 2 whose first and middle ones are given."""
    return tuple(0.5 * part for part in (*parts, *parts[-2::-1]) for _ in range(2))


#: Chains by order: S. Blanes and P. C. Moan, J. Comput. Appl. Math. 142, 2002 (S6 and
#: S10, order 4 and 6); W. Kahan and R.-C. Li, Math. Comp. 66, 1997 (s17odr8a, order 8;
#: Hairer, Lubich and Wanner, *Geometric Numerical Integration*, section V.3.2).
_CHAINS = {
    2: (0.5, 0.5),
    4: _chain(
        (0.0792036964311957, 0.353172906049774, -0.0420650803577195),
        (0.209515106613362, -0.143851773179818, 0.434336666566456),
    ),
    6: _chain(
        (
            0.0502627644003922,
            0.413514300428344,
            0.0450798897943977,
            -0.188054853819569,
            0.541960678450780,
        ),
        (
            0.148816447901042,
            -0.132385865767784,
            0.067307604692185,
            0.432666402578175,
            -0.016404589403618,
        ),
    ),
    8: _of_steps(
        (
            0.13020248308889008088,
            0.56116298177510838456,
            -0.38947496264484728641,
            0.15884190655515560090,
            -0.39590389413323757734,
            0.18453964097831570709,
            0.25837438768632204729,
            0.29501172360931029887,
            -0.60550853383003451170,
        )
    ),
}

#: Bodies per block: few enough that their arrays fit a processor's second-level cache,
#: enough that a NumPy call costs little beside its arithmetic.
_BLOCK = 4096

#: Steps without a kick after which l is recomputed from the orientation, and that is
#: normalized.
_ROUND = 16

#: One uniform rotation: about which principal axis (0 or 2), and for what part of the
#: step.
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
    """One step of the splitting method: free motion in uniform rotations, the wrench as
    a kick.

    Half the free motion, p += h F and L += h tau, half the free motion. The step is its
    own inverse with -h, leaves L of a torque-free body unchanged and its energy without
    drift, and is exact for a parabola and a symmetric top. Source: the module
    docstring.

    Args:
        bodies, wrench, step, time: as in ``explicit_euler``.
        order: 2 with one kick, or 4, 6, 8 with 6, 10, 17. Above 2 it holds
            where the wrench reads only positions, orientations and time.
        velocity_dependent: the kick reads the wrench twice, the second time
            with half the kick done, which order 2 needs where the wrench
            depends on velocities. False reads it once, for a wrench that does not.
    Returns:
        The bodies at time + step.
    Raises:
        ValueError: as ``explicit_euler``, and an unknown order.
    """
    h, t = step_and_time(step, time)
    if wrench is None:
        return free_flight(bodies, h, 1, order=order)
    motion, chain, before = Motion.of(bodies), _chain_of(order), 0.0
    for first, second in zip(chain[::2], chain[1::2], strict=True):
        # Free motion since the last kick: the end of one link and the beginning of the
        # next.
        turns = [
            turn for turn in ((0, before), (2, before + first), (0, first)) if turn[1]
        ]
        motion = _free(motion, [(turns, before + first)], h)
        t += (before + first) * h
        motion = _kicked(motion, wrench, (first + second) * h, t, velocity_dependent)
        before = second
    return _free(motion, [([(0, before), (2, before)], before)], h).to_bodies()


def free_flight(bodies: Bodies, step: float, count: int, *, order: int = 2) -> Bodies:
    """``count`` steps of ``splitting`` without a wrench, up to rounding, block by
    block.
    """
    chain, motion = _chain_of(order), Motion.of(bodies)
    rounds = [
        (_turns(chain * size), float(size)) for size in (_ROUND, count % _ROUND) if size
    ]
    whole = [rounds[0]] * (count // _ROUND) + rounds[1:]
    return _free(motion, whole, step).to_bodies()


def _chain_of(order: int) -> tuple[float, ...]:
    if isinstance(order, bool) or order not in _CHAINS:
        raise failure("order", "one of " + ", ".join(map(str, _CHAINS)), written(order))
    return _CHAINS[order]


def _turns(chain: Sequence[float]) -> list[Turn]:
    """The rotations of a step without kicks: axes 3 and 1 alternating, neighbours
    merged.
    """
    joined = [
        chain[0],
        *(a + b for a, b in zip(chain, chain[1:], strict=False)),
        chain[-1],
    ]
    return [(0 if i % 2 else 2, part) for i, part in enumerate(joined)]


def _kicked(
    motion: Motion, wrench: Wrench, span: float, time: float, velocity_dependent: bool
) -> Motion:
    def pushed(by: float) -> Motion:
        return motion.moved(
            momentum=motion.momentum + by * force,
            angular_momentum=motion.angular_momentum + by * torque,
        )

    force, torque = motion.wrench(wrench, time)
    if velocity_dependent:
        force, torque = pushed(0.5 * span).wrench(wrench, time)
    return pushed(span)


def _free(
    motion: Motion, rounds: Sequence[tuple[Sequence[Turn], float]], step: float
) -> Motion:
    """Free motion in rounds of rotations; each has its length in steps."""
    q, frames = np.empty(motion.orientation.shape), motion.frames
    for first in range(0, len(motion.bodies), _BLOCK):
        here = slice(first, first + _BLOCK)
        axes = None if frames.axes is None else frames.axes[:, here]
        block = PrincipalFrames(
            frames.inverse_moments[:, here], frames.moments[:, here], axes
        )
        block_q, block_l = motion.orientation[:, here], motion.angular_momentum[:, here]
        for turns, length in rounds:
            block_q = _turned(block_q, block_l, block, turns, length * step, step)
        q[:, here] = block_q
    if motion.fixed is not None:
        q = np.where(motion.fixed, motion.orientation, q)
    span = step * sum(length for _, length in rounds)
    return motion.moved(
        position=motion.position + span * motion.velocity, orientation=q
    )


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
    inverse, q = frames.inverse_moments, np.array(q)
    half_rates = {axis: 0.5 * step * (inverse[axis] - inverse[1]) for axis in (0, 2)}
    work = np.empty((4, q.shape[1]))
    for axis, part in turns:
        _turn_evenly(axis, part * half_rates[axis], body, q, work)
    q = multiplied(turn_about(momentum * (span * inverse[1])), q)
    return normalized(
        q if frames.axes is None else multiplied(q, conjugated(frames.axes))
    )


def _turn_evenly(
    axis: int, half_rate: Array, body: Array, q: Array, work: Array
) -> None:
    """Turn bodies about one of their axes by 2 half_rate l_axis, in place.

    ``body`` is l, ``work`` is room for (4, n). The quaternion is multiplied by
    (tan(angle/2) e, 1): one trigonometric function instead of two; it is normalized at
    the end of the step.
    """
    tangent, sine, one, other = work
    np.multiply(half_rate, body[axis], out=half_rate)
    np.tan(half_rate, out=tangent)
    cosine = half_rate
    np.multiply(tangent, tangent, out=cosine)
    cosine += 1.0
    np.divide(2.0, cosine, out=cosine)
    np.multiply(cosine, tangent, out=sine)
    cosine -= 1.0
    second, third = (axis + 1) % 3, (axis + 2) % 3
    following, last = body[second], body[third]
    np.multiply(sine, last, out=one)
    np.multiply(sine, following, out=other)
    following *= cosine
    following += one
    last *= cosine
    last -= other
    for a, b in ((q[axis], q[3]), (q[second], q[third])):
        np.multiply(tangent, a, out=one)
        np.multiply(tangent, b, out=other)
        a += other
        b -= one
