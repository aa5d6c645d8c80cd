"""Colliders as the stage draws them."""

from __future__ import annotations

from course import shapes
from course.workbook.stage import Solid, ball, box, capsule, labelled


def solid_of(shape: shapes.Shape, color: str, label: str) -> Solid:
    """A sphere, a capsule or an upright box as a body about the origin of its coordinates."""
    if isinstance(shape, shapes.Sphere):
        made = ball(float(shape.radius), center=shape.center, color=color)
    elif isinstance(shape, shapes.Capsule):
        made = capsule(shape.start, shape.end, float(shape.radius), color=color)
    else:
        assert isinstance(shape, shapes.AABB)
        half, middle = (
            0.5 * (shape.upper - shape.lower),
            0.5 * (shape.upper + shape.lower),
        )
        made = box(half, center=middle, color=color)
    return labelled(made, label)
