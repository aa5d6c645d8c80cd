"""A bar over a plank that rise and turn steadily: the gap at every moment, and what adds to its rate."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import Array, ArrayLike
from course.scenes import bar_over_plank
from course.scenes.moving_pairs import BAR, HALF_THICKNESS, PLANK


@dataclass(frozen=True, eq=False)
class GapMotion:
    """Bar A and plank B over time; both steady, and still once they touch.

    Args:
        centre, turn: of A and B, (t, 2, 3) [m], (t, 2) [rad].
        point, velocity: of the two points of the contact, (t, 2, 3) [m], [m/s].
        lift: velocity of the centres, (2, 3) [m/s].
        gap: d, (t,) [m].
        parts: what each motion adds to d_dot, (t,) [m/s] by name.
        touching: when they meet first, inf if they do not [s].
        corner: whether it is A's corner on B's face that meets, not B's end on A.
    """

    centre: Array
    turn: Array
    point: Array
    velocity: Array
    lift: Array
    gap: Array
    parts: dict[str, Array]
    touching: float
    corner: bool


def gap_motion(
    rates: ArrayLike,
    lifts: ArrayLike,
    times: ArrayLike,
    *,
    reach: float = 1.8,
    clear: float = 0.7,
    touching: float = np.inf,
    corner: bool = True,
) -> GapMotion:
    """The motion of ``course.scenes.bar_over_plank`` with centres that rise, at these times.

    d = (p_A - p_B).N and, as p_A - p_B lies along N, d_dot = (v_A - v_B).N at every
    moment (syllabus row 19).

    Args:
        rates: omega_x of A and B, (2,) [rad/s].
        lifts: velocities of their centres along z, (2,) [m/s].
        times: (t,) [s].
        reach, clear: y of A's centre and the gap at 0 s [m].
        touching: from when on all stands still [s], and
        corner: whether A's corner meets B there; ``first_touch`` finds both.
    """
    since = np.minimum(np.asarray(times, dtype=float), touching)
    turned, lifted = np.asarray(rates, dtype=float), np.asarray(lifts, dtype=float)
    scene = bar_over_plank(*turned, reach=reach, clear=clear)
    turn = since[:, None] * turned
    lift = np.outer(lifted, [0.0, 0.0, 1.0])
    centre = scene.bodies.position + since[:, None, None] * lift
    point_a = centre[:, 0] + _turned([-BAR, -HALF_THICKNESS], turn[:, 0])
    normal = _turned([0.0, 1.0], turn[:, 1])
    gap = np.sum((point_a - centre[:, 1]) * normal, axis=-1) - HALF_THICKNESS
    point = np.stack([point_a, point_a - gap[:, None] * normal], axis=1)
    turning = np.cross(np.outer(turned, [1.0, 0.0, 0.0]), point - centre)
    along = np.sum(turning * normal[:, None], axis=-1)
    rising = normal[:, 2:] * lifted
    parts = {
        "A rises": rising[:, 0], "A turns": along[:, 0],
        "B rises": -rising[:, 1], "B turns": -along[:, 1],
    }  # fmt: skip
    return GapMotion(
        centre, turn, point, lift + turning, lift, gap, parts, touching, corner
    )


def first_touch(
    rates: ArrayLike,
    lifts: ArrayLike,
    last: float,
    *,
    reach: float = 1.8,
    clear: float = 0.7,
) -> tuple[float, bool]:
    """When the two touch first, up to ``last`` [s], and whether it is A's corner on B's face.

    Otherwise it is B's right end on A's lower face; inf if neither.
    """
    times = np.linspace(0.0, last, 2001)
    m = gap_motion(rates, lifts, times, reach=reach, clear=clear)
    end = m.centre[:, 1] + _turned([PLANK, HALF_THICKNESS], m.turn[:, 1])
    down = -_turned([0.0, 1.0], m.turn[:, 0])
    below = np.sum((end - m.centre[:, 0]) * down, axis=-1) - HALF_THICKNESS
    first = [_zero(times, gap) for gap in (m.gap, below)]
    return min(first), first[0] <= first[1]


def _turned(arm: list[float], angle: Array) -> Array:
    """An arm in y and z turned by an angle about x, (t, 3)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([0 * c, c * arm[0] - s * arm[1], s * arm[0] + c * arm[1]], axis=-1)


def _zero(times: Array, gap: Array) -> float:
    """The first zero of a falling gap, straight between two of its values."""
    k = int(np.argmax(gap <= 0))
    if gap[k] > 0:
        return np.inf
    return float(times[k - 1] + (times[k] - times[k - 1]) * gap[k - 1] / (gap[k - 1] - gap[k]))  # fmt: skip
