"""Shapes that come nearer until a verdict says that they meet: near the origin, and far from it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course import formulas, overlap, shapes
from course.arrays import Array
from course.study.asking import asked
from course.study.far_places import DTYPES, SpheresVerdict
from course.study.shadow_cases import stopped_at

#: The shapes of this lesson.
Simple = shapes.Sphere | shapes.Capsule | shapes.AABB
#: The radii of the two spheres far from the origin, A's and B's [m].
FAR_RADII = 5.0, 4.0
#: Where B's centre begins, seen from A's [m], and how fast it comes [m/s].
FAR_START, FAR_SPEED = 30.0, 6.0


@dataclass(frozen=True, eq=False)
class FarMeeting:
    """Sphere B comes toward sphere A, D from the origin, until a verdict on stored places stops it.

    Args:
        times: (t,) [s].
        true: B's centre as seen from A's, (t, 2) [m].
        drawn: the same of the places as they are stored, (t, 2) [m].
        gap: the true one, (t,) [m].
        stored_gap: that of the stored places, (t,) [m].
        stopped: whether the verdict stopped it.
    """

    times: Array
    true: Array
    drawn: Array
    gap: Array
    stored_gap: Array
    stopped: bool


def far_meeting(
    far: float, lane: float, times: Array, size: int, function: SpheresVerdict
) -> FarMeeting:
    """B comes along x, with its places stored in so many bytes.

    Args:
        far: D, x of A's centre, taken to a number that 4 bytes can hold [m].
        lane: y of B's centre [m].
        function: ``spheres_overlap``, asked at each moment.
    """
    kind, far = DTYPES[size], float(np.float32(far))
    r_a, r_b = (kind(r) for r in FAR_RADII)
    x_a = np.array([far, 0.0, 0.0], dtype=kind)

    def place(x: Array) -> Array:
        x = np.asarray(x)
        fill = np.broadcast_to
        return np.stack([far + x, fill(lane, x.shape), fill(0.0, x.shape)], axis=-1)

    def says(x: float) -> bool:
        return bool(
            asked(function, [()], x_a, r_a, place(np.array(x)).astype(kind), r_b)[0]
        )

    way = FAR_START - FAR_SPEED * times
    stop, met = stopped_at(says, way)
    x = np.maximum(way, stop)
    drawn = place(x).astype(kind).astype(float) - x_a.astype(float)
    true = np.stack([x, np.full_like(x, lane)], axis=-1)
    gap, stored_gap = (
        np.linalg.norm(p, axis=-1) - sum(FAR_RADII) for p in (true, drawn)
    )
    return FarMeeting(times, true, drawn[:, :2], gap, stored_gap, met)


# Near the origin: the shapes of each exercise, and how its function decides.


@dataclass(frozen=True, eq=False)
class Encounter:
    """Two shapes of an exercise.

    Args:
        moving: the shape that comes, with its middle at the origin.
        still: the one that waits.
        says: makes a verdict on the moving shape's place (3,) from the function.
        reference: the right function.
        title: what decides, in words.
    """

    moving: Simple
    still: Simple
    says: Callable[[Callable[..., Any]], Callable[[Array], bool]]
    reference: Callable[..., Any]
    title: str


@dataclass(frozen=True, eq=False)
class Meeting:
    """Where the moving shape is, x (t,) [m], whether a verdict stopped it, and the true gap (t,) [m]."""

    x: Array
    stopped: bool
    gap: Array


def meeting(
    encounter: Encounter, function: Callable[..., Any], lane: float, way: Array
) -> Meeting:
    """The moving shape goes along x at y = lane until it is said to overlap the other.

    Args:
        way: the places x, in turn, (t,) [m].
    """
    says = encounter.says(function)
    stop, met = stopped_at(lambda x: says(np.array([x, lane, 0.0])), way)
    x = np.minimum(way, stop)
    places = np.stack([x, np.full_like(x, lane), np.zeros_like(x)], axis=-1)
    return Meeting(x, met, overlap.gap(at(encounter.moving, places), encounter.still))


def at(shape: Simple, place: Array) -> Simple:
    """A shape whose middle was at the origin, at places (..., 3); boxes stay upright."""
    if isinstance(shape, shapes.AABB):
        return shapes.AABB(shape.lower + place, shape.upper + place)
    if isinstance(shape, shapes.Capsule):
        return shapes.Capsule(shape.start + place, shape.end + place, shape.radius)
    return shapes.Sphere(shape.center + place, shape.radius)


BALL = shapes.Sphere(np.zeros(3), np.array(0.6))
STILL_BALL = shapes.Sphere(np.array([1.6, 0.0, 0.0]), np.array(1.1))
BOX = shapes.AABB(np.array([-0.7, -0.4, -0.5]), np.array([0.7, 0.4, 0.5]))
STILL_BOX = shapes.AABB(np.array([0.9, -0.9, -0.8]), np.array([2.4, 0.9, 0.8]))
ROD = shapes.Capsule(
    np.array([-0.6, -0.5, -0.3]), np.array([0.6, 0.5, 0.3]), np.array(0.3)
)
STILL_ROD = shapes.Capsule(
    np.array([1.9, -0.7, 0.0]), np.array([1.1, 0.7, 0.0]), np.array(0.35)
)
OTHER_ROD = shapes.Capsule(
    np.array([1.3, -0.7, 0.0]), np.array([1.9, 0.7, 0.0]), np.array(0.35)
)


def _spheres(function: Callable[..., Any]) -> Callable[[Array], bool]:
    still = STILL_BALL
    return lambda x: bool(
        asked(function, [()], x, BALL.radius, still.center, still.radius)[0]
    )


def _boxes(function: Callable[..., Any]) -> Callable[[Array], bool]:
    still = STILL_BOX
    return lambda x: bool(
        asked(function, [()], BOX.lower + x, BOX.upper + x, still.lower, still.upper)[0]
    )


def _nearest(function: Callable[..., Any]) -> Callable[[Array], bool]:
    reach = float(BALL.radius + STILL_ROD.radius)

    def says(x: Array) -> bool:
        (nearest,) = asked(function, [(3,)], x, STILL_ROD.start, STILL_ROD.end)
        return bool(np.linalg.norm(x - nearest) <= reach)

    return says


def _by_gap(*given: Any) -> Callable[..., Any]:
    """Of a function that returns a gap; what is callable in ``given`` waits for the place."""

    def made(function: Callable[..., Any]) -> Callable[[Array], bool]:
        def says(x: Array) -> bool:
            values = [v(x) if callable(v) else v for v in given]
            return bool(asked(function, [()], *values)[0] <= 0)

        return says

    return made


def _place(x: Array) -> Array:
    return x


_CAPSULE = STILL_ROD.start, STILL_ROD.end, STILL_ROD.radius
_OTHER = OTHER_ROD.start, OTHER_ROD.end, OTHER_ROD.radius
ENCOUNTERS = {
    "spheres_overlap": Encounter(
        BALL, STILL_BALL, _spheres, formulas.spheres_overlap, "squares compared"
    ),
    "boxes_overlap": Encounter(
        BOX, STILL_BOX, _boxes, formulas.boxes_overlap, "intervals on three axes"
    ),
    "closest_point_on_segment": Encounter(
        BALL, STILL_ROD, _nearest, formulas.closest_point_on_segment, "by the nearest point"
    ),
    "sphere_capsule_gap": Encounter(
        BALL, STILL_ROD, _by_gap(_place, BALL.radius, *_CAPSULE), formulas.sphere_capsule_gap, "by the gap"
    ),
    "capsule_gap": Encounter(
        ROD, OTHER_ROD,
        _by_gap(lambda x: ROD.start + x, lambda x: ROD.end + x, ROD.radius, *_OTHER),
        formulas.capsule_gap, "by the gap of two segments",
    ),
    "sphere_box_gap": Encounter(
        BALL, STILL_BOX, _by_gap(_place, BALL.radius, STILL_BOX.lower, STILL_BOX.upper),
        formulas.sphere_box_gap, "by the gap",
    ),
}  # fmt: skip
