"""A body that turns in the box that somebody's function draws around it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course import formulas, rotations
from course.arrays import Array
from course.study.asking import asked
from course.study.turned_rods import CORNERS

#: Half the sides of the bar that turns [m].
BAR = np.array([1.1, 0.25, 0.12])
#: Of a hammer: half the sides of handle and head, the head's turn, and where it is [m].
HAMMER = np.array([[0.8, 0.1, 0.1], [0.5, 0.22, 0.2]])
HEAD_TURN = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
PLACES = np.array([[-0.2, 0.0, 0.0], [0.8, 0.0, 0.0]])
#: The axis about which the body turns, and how fast [rad/s].
AXIS, SPIN = np.array([0.35, 0.5, 0.79]), 1.0


@dataclass(frozen=True, eq=False)
class BoxedBody:
    """A body over time, and the lower and upper corners of the box around it.

    Args:
        times: (t,) [s].
        turns: rotations of the body, (t, 3, 3).
        points: its corners, (t, n, 3) [m].
        lower, upper: of the box, (t, 3) [m].
    """

    times: Array
    turns: Array
    points: Array
    lower: Array
    upper: Array

    @property
    def corners(self) -> Array:
        """The corners of the box, (t, 8, 3) [m]; all in its middle where it has no inside."""
        middle, half = 0.5 * (self.upper + self.lower), 0.5 * (self.upper - self.lower)
        half = np.where(self.crossed[:, None], 0.0, half)
        return np.asarray(middle[:, None] + CORNERS * half[:, None])

    @property
    def crossed(self) -> Array:
        """Whether a lower end lies above its upper one: such a box has no inside, (t,)."""
        return np.asarray(np.any(self.lower > self.upper, axis=-1))

    @property
    def outside(self) -> Array:
        """How far the body sticks out of the box along an axis, 0 where it does not, (t,) [m]."""
        above = self.points - self.upper[:, None]
        below = self.lower[:, None] - self.points
        return np.asarray(np.maximum(np.maximum(above, below).max(axis=(1, 2)), 0.0))

    @property
    def loose(self) -> Array:
        """The most that a side of the box is away from the body, (t,) [m]."""
        above = self.upper - self.points.max(axis=1)
        below = self.points.min(axis=1) - self.lower
        return np.asarray(np.maximum(np.maximum(above, below).max(axis=1), 0.0))

    @property
    def volume(self) -> Array:
        """The box's, (t,) [m^3]; 0 where its ends change places."""
        return np.asarray(np.prod(np.maximum(self.upper - self.lower, 0.0), axis=-1))


#: A box of a body at one moment, by the exercise whose function is asked: R -> corners.
Boxed = Callable[[Callable[..., Any], Array], tuple[Array, Array]]


def by_extents(function: Callable[..., Any], turn: Array) -> tuple[Array, Array]:
    """Of ``rotated_box_extents``: the box about the origin."""
    (half,) = asked(function, [(3,)], BAR, turn)
    return -half, half


def by_k_dop(function: Callable[..., Any], turn: Array) -> tuple[Array, Array]:
    """Of ``k_dop`` with the three axes as directions."""
    lower, upper = asked(function, [(3,), (3,)], bar_points(turn), np.eye(3))
    return lower, upper


def by_support(function: Callable[..., Any], turn: Array) -> tuple[Array, Array]:
    """Of ``support``, asked along the three axes and against them."""
    points = bar_points(turn)
    return _six(lambda d: asked(function, [(3,)], points, d)[0])


def by_compound_support(
    function: Callable[..., Any], turn: Array
) -> tuple[Array, Array]:
    """Of ``compound_support``, of the hammer, asked along the three axes and against them."""
    rotation, place = hammer_parts(turn)
    own = CORNERS * HAMMER[:, None]
    return _six(lambda d: asked(function, [(3,)], own, rotation, place, d)[0])


def _six(farthest: Callable[[Array], Array]) -> tuple[Array, Array]:
    """The ends of a box by six supports; the directions are a little off the axes, so
    that no two corners are as far.
    """
    ways = np.eye(3) + 1e-7 * np.array([[0, 1, 2], [2, 0, 1], [1, 2, 0.0]])
    upper = np.array([farthest(d)[i] for i, d in enumerate(ways)])
    return np.array([farthest(-d)[i] for i, d in enumerate(ways)]), upper


ASKED: dict[str, tuple[Boxed, Callable[..., Any]]] = {
    "rotated_box_extents": (by_extents, formulas.rotated_box_extents),
    "k_dop": (by_k_dop, formulas.k_dop),
    "support": (by_support, formulas.support),
    "compound_support": (by_compound_support, formulas.compound_support),
}


def bar_points(turn: Array) -> Array:
    """The corners of the bar, (..., 8, 3) [m]."""
    return np.asarray(CORNERS * BAR @ np.swapaxes(turn, -1, -2))


def hammer_parts(turn: Array) -> tuple[Array, Array]:
    """Rotation (2, 3, 3) and place (2, 3) [m] of the hammer's parts."""
    return turn @ np.stack([np.eye(3), HEAD_TURN]), PLACES @ turn.T


def hammer_points(turn: Array) -> Array:
    """The corners of both parts, (16, 3) [m]."""
    rotation, place = hammer_parts(turn)
    world = CORNERS * HAMMER[:, None] @ np.swapaxes(rotation, -1, -2) + place[:, None]
    return np.asarray(world.reshape(-1, 3))


def boxed_body(
    exercise: str, function: Callable[..., Any], times: Array, start: float
) -> BoxedBody:
    """The body of an exercise, turned on from an angle, in the box that a function draws.

    Args:
        exercise: one of ``ASKED``.
        function: with its arguments, the right one or somebody's own.
        times: (t,) [s].
        start: the angle at the first time [degrees].
    """
    boxed, points_of = ASKED[exercise][0], bar_points
    if exercise == "compound_support":
        points_of = hammer_points
    angle = np.radians(start) + SPIN * times
    axis = AXIS / np.linalg.norm(AXIS)
    turns = rotations.to_matrix(rotations.from_rotation_vector(angle[:, None] * axis))
    ends = [boxed(function, turn) for turn in turns]
    lower, upper = (np.stack(corner) for corner in zip(*ends, strict=True))
    points = np.stack([points_of(turn) for turn in turns])
    return BoxedBody(times, turns, points, lower, upper)
