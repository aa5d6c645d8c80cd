"""Boxes on boxes: a tower, and walls of bricks in running bond."""

from __future__ import annotations

import numpy as np

from course.arrays import Array, ArrayLike, choice, positive, whole_number
from course.overlap import stacked_box_contacts
from course.scenes.layout import box_inertia, contacts_at, with_ground
from course.scenes.scene import GRAVITY, Scene, resting


def stack(
    count: int,
    *,
    mass: ArrayLike = 1.0,
    corners: int = 4,
    size: tuple[float, float, float] = (1.0, 1.0, 1.0),
) -> Scene:
    """A tower of boxes, the lowest on the ground; each rests on 4 corners, or on 1 point under its centre.

    With one point the contact under a box carries all that stands from there on up.

    Args:
        count: how many boxes.
        mass: one or (count,), from below [kg].
        corners: 4, or 1, with which A is tridiagonal.
        size: edges of each box [m].
    """
    whole_number("count", count, minimum=1)
    choice("corners", str(corners), ("1", "4"))
    low = np.outer(np.arange(count), [0.0, 0.0, size[2]]) - [
        size[0] / 2,
        size[1] / 2,
        0,
    ]
    scene = _boxes(f"stack of {count}", low, size, mass)
    if corners == 4:
        return scene
    contacts, masses = scene.contacts, scene.bodies.mass[:-1]
    point = contacts.point.reshape(count, 4, 3).mean(axis=1)
    single = contacts_at(point, a=contacts.body_a[::4], b=contacts.body_b[::4])
    truth = GRAVITY * np.cumsum(masses[::-1])[::-1]
    return resting(scene.name, scene.bodies, single, truth=truth)


def wall(rows: int, columns: int, *, depth: int = 1, mass: ArrayLike = 1.0) -> Scene:
    """Bricks of 2 x 1 x 1 m in running bond: each rests on two below, at 4 corners each.

    Every other row is a brick shorter. With a depth of several bricks these
    rows are also shifted half a brick in depth, and each of their bricks rests
    on four.

    Args:
        rows, columns, depth: how many bricks high, long (2 at least) and deep.
        mass: one or one for each brick, row by row from below [kg].
    """
    for name, value in (("rows", rows), ("columns", columns), ("depth", depth)):
        whole_number(name, value, minimum=2 if name == "columns" else 1)
    spots = []
    for row in range(rows):
        shift = row % 2
        x = 2.0 * np.arange(columns - shift) + shift
        y = np.arange(max(depth - shift, 1)) + (0.5 * shift if depth > 1 else 0.0)
        grid = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
        spots.append(np.column_stack([grid, np.full(len(grid), float(row))]))
    low = np.concatenate(spots)
    return _boxes(f"wall of {len(low)} bricks", low, (2.0, 1.0, 1.0), mass)


def _boxes(
    name: str, low: Array, size: tuple[float, float, float], mass: ArrayLike
) -> Scene:
    """Boxes of one size, from the corner of each with the least coordinates."""
    masses = np.broadcast_to(positive("mass", mass), len(low))
    inertia, centre = box_inertia(masses, size), low + 0.5 * np.array(size)
    bodies = with_ground(masses, inertia, centre)
    return resting(name, bodies, stacked_box_contacts(low, size))
