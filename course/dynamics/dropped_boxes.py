"""Three boxes over a floor, in closed form: the moving picture of lesson 00."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import Array, ArrayLike, non_negative, positive, scalar


@dataclass(frozen=True, eq=False)
class FallingBoxes:
    """Heights of the boxes' undersides over time, with and without a floor that is asked about.

    Args:
        time: (t,) [s].
        side: edge length of every box [m].
        stacked: where each box stops on the floor or on the one below, (t, n) [m].
        unasked: where gravity alone takes it, (t, n) [m].
        landing: when each box lands, (n,) [s].
    """

    time: Array
    side: float
    stacked: Array
    unasked: Array
    landing: Array


def falling_boxes(
    time: ArrayLike,
    *,
    count: int = 3,
    side: float = 0.5,
    gap: float = 0.4,
    gravity: float = 9.81,
) -> FallingBoxes:
    """Boxes one above the other fall from rest, each onto what is below, and stay (restitution 0).

    Box i (from 0) starts (i + 1) gap above its place in the stack, so the
    lower ones land first: z_i = max(i side, i side + (i + 1) gap - g t^2/2).

    Args:
        time: (t,) [s].
        count: how many boxes.
        side, gap: [m].
        gravity: [m/s^2].
    """
    t = non_negative("time", time)
    s, g = (
        float(positive("side", scalar("side", side))),
        float(positive("gravity", scalar("gravity", gravity))),
    )
    place = s * np.arange(count)
    fall = float(positive("gap", scalar("gap", gap))) * (1 + np.arange(count))
    unasked = place + fall - 0.5 * g * t[:, None] ** 2
    return FallingBoxes(
        t, s, np.maximum(place, unasked), unasked, np.sqrt(2 * fall / g)
    )
