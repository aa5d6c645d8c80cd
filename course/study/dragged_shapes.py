"""A shape among a sphere, a capsule that turns and a box: gaps of their places as they are stored."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course import overlap, rotations, shapes
from course.arrays import Array
from course.overlap import Closest
from course.study.far_places import DTYPES
from course.study.meeting_shapes import Simple, at

#: How the dragged shape looks: a ball, a rod, a box, about the origin.
DRAGGED: tuple[Simple, ...] = (
    shapes.Sphere(np.zeros(3), np.array(0.6)),
    shapes.Capsule(
        np.array([-0.6, -0.3, 0.0]), np.array([0.6, 0.3, 0.0]), np.array(0.3)
    ),
    shapes.AABB(np.array([-0.7, -0.4, -0.4]), np.array([0.7, 0.4, 0.4])),
)
#: What it is among, about the origin, and where that stands [m].
AMONG: tuple[Simple, ...] = (
    shapes.Sphere(np.zeros(3), np.array(0.8)),
    shapes.Capsule(
        np.array([-1.0, 0.0, 0.0]), np.array([1.0, 0.0, 0.0]), np.array(0.35)
    ),
    shapes.AABB(np.array([-0.9, -0.6, -0.6]), np.array([0.9, 0.6, 0.6])),
)
STAND = np.array([[-2.4, 1.25, 0.0], [0.2, 1.05, 0.0], [2.75, 1.25, 0.0]])
#: Which of them turns, and how fast [rad/s].
TURNS, PACE = 1, np.radians(60.0)


@dataclass(frozen=True, eq=False)
class DraggedShape:
    """Gaps of a shape to three others, all of them stored D from the origin.

    Args:
        place: of all four as they are stored, less D, the dragged one first, (4, 3) [m].
        turn: of each over time, quaternions (t, 4, 4).
        found: nearest points and gaps to each of the three, over time, (t,).
    """

    place: Array
    turn: Array
    found: tuple[Closest, ...]

    @property
    def gap(self) -> Array:
        """(t, 3) [m]."""
        return np.stack([f.gap for f in self.found], axis=-1)


def dragged_shape(
    which: int, x: float, y: float, far: float, times: Array, size: int
) -> DraggedShape:
    """The shape at (D + x, D + y), every place stored in so many bytes.

    Args:
        which: of ``DRAGGED``.
        far: D, taken to a number that 4 bytes can hold [m].
        times: (t,) [s].
    """
    far = float(np.float32(far))
    true = np.concatenate([[[x, y, 0.0]], STAND])
    origin = np.array([far, far, 0.0])
    place = (true + origin).astype(DTYPES[size]).astype(float) - origin
    turn = np.zeros((len(times), 4, 3))
    turn[:, 1 + TURNS, 2] = PACE * times
    dragged = at(DRAGGED[which], place[0])
    found = [
        overlap.nearest_points(dragged, turning(shape, place[k + 1], turn[:, k + 1]))
        for k, shape in enumerate(AMONG)
    ]
    return DraggedShape(place, rotations.from_rotation_vector(turn), tuple(found))


def turning(shape: Simple, place: Array, turn: Array) -> Simple:
    """A shape at a place, and a capsule turned over time by rotation vectors, (t, 3)."""
    if isinstance(shape, shapes.Capsule):
        quaternion = rotations.from_rotation_vector(turn)
        ends = (rotations.rotate(quaternion, e) for e in (shape.start, shape.end))
        start, end = (place + e for e in ends)
        radius = np.broadcast_to(shape.radius, len(turn))
        return shapes.Capsule(start, end, radius)
    still = np.broadcast_to(place, turn.shape)
    return at(shape, still)
