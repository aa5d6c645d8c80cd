"""Pairs of shapes at rest: a batch of ours against a loop over python-fcl and coal, as their own users call them.

Every pair is asked once, with its pose given as arrays: on both sides the time holds what
it takes to hand these over (ours: a shape made of the arrays, with all its checks; theirs: a
transform set). coal's distances are asked for with a tolerance of 1e-12, ours are exact to
rounding. What coal's C++ takes by itself, without the call from Python, is from its own clock.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from benchmarks.measure import Row, ratio, seconds
from course.arrays import Array
from course.overlap import contacts, gap, overlaps
from course.shapes import OBB, Capsule, ConvexHull, Sphere

PAIRS = 10_000
TOLERANCE = 1e-12
SIZES = (8, 16, 32)

Poses = tuple[Array, Array]


def rows() -> list[Row]:
    """The rows of this module."""
    rng = np.random.default_rng(11)
    boxes = [_boxes(rng) for _ in range(2)]
    made = [*_box_verdicts(boxes), *_box_manifolds(boxes), *_round(rng)]
    for size in SIZES:
        made += _hulls(rng, size)
    return made


def _boxes(rng: np.random.Generator) -> tuple[Array, Array, Array]:
    """Centres, rotations and half extents; about a third of the pairs overlap."""
    center = rng.uniform(-0.8, 0.8, (PAIRS, 3))
    turn = Rotation.random(PAIRS, random_state=int(rng.integers(2**31))).as_matrix()
    return center, turn, rng.uniform(0.2, 0.8, (PAIRS, 3))


def _against(
    name: str, ours: Callable[[], object], peers: dict[str, tuple[Any, float | None]]
) -> list[Row]:
    """A row a peer: (what makes its loop, the goal)."""
    made = []
    for peer, (loop, goal) in peers.items():
        label = f"{name}: {peer} / ours"
        if importlib.util.find_spec(peer) is None:
            made.append(Row(label, float("nan"), goal, f"{peer} is not installed"))
            continue
        quotient, theirs, mine = ratio(loop(), ours, repeats=3)
        each = 1e6 / PAIRS
        remark = f"{theirs * each:.3g} against {mine * each:.3g} us a pair"
        made.append(Row(label, quotient, goal, remark))
    return made


def _box_verdicts(boxes: list[Any]) -> list[Row]:
    a, b = (OBB(*box) for box in boxes)
    return [
        *_against(
            "boxes, verdict",
            lambda: overlaps(OBB(*boxes[0]), OBB(*boxes[1])),
            {"fcl": (partial(_fcl_boxes, boxes), 30.0), "coal": (partial(_coal_boxes, boxes), 30.0)},
        ),
        *_against(
            "boxes made beforehand, verdict",
            lambda: overlaps(a, b),
            {"coal": (partial(_coal_boxes, boxes), None)},
        ),
    ]  # fmt: skip


def _box_manifolds(boxes: list[Any]) -> list[Row]:
    return _against(
        "boxes, manifold of at most 4",
        lambda: contacts(OBB(*boxes[0]), OBB(*boxes[1]), body_b=1, limit=4),
        {"fcl": (partial(_fcl_boxes, boxes, most=4), 15.0)},
    )


def _round(rng: np.random.Generator) -> list[Row]:
    c, d = rng.uniform(-1, 1, (2, PAIRS, 3))
    r, s = rng.uniform(0.1, 0.5, (2, PAIRS))
    e, f = c + rng.normal(size=(PAIRS, 3)), d + rng.normal(size=(PAIRS, 3))
    return [
        *_against(
            "spheres, gap",
            lambda: gap(Sphere(c, r), Sphere(d, s)),
            {"coal": (partial(_coal_spheres, c, r, d, s), 25.0)},
        ),
        *_against(
            "capsules, gap",
            lambda: gap(Capsule(c, e, r), Capsule(d, f, s)),
            {"coal": (partial(_coal_capsules, (c, e, r), (d, f, s)), 8.0)},
        ),
    ]


def _hulls(rng: np.random.Generator, size: int) -> list[Row]:
    """Distance of hulls of points on a sphere, both turned, most of them apart."""
    points = rng.normal(size=(2, size, 3))
    points /= np.linalg.norm(points, axis=-1, keepdims=True)
    first, second = (ConvexHull(p) for p in points)
    turns = Rotation.random(PAIRS, random_state=size).as_matrix()
    shifts = rng.uniform(-3, 3, (PAIRS, 3))
    name = f"hulls of {size} vertices, gap"

    def ours() -> object:
        return gap(first, second.moved(turns, shifts))

    loop = partial(_coal_hulls, points, turns, shifts)
    made = _against(name, ours, {"coal": (loop, 5.0)})
    if importlib.util.find_spec("coal") is None:
        return made
    counted = loop(inside=True)
    inside = min(counted() for _ in range(4)) / PAIRS
    mine = seconds(ours, repeats=3) / PAIRS * 1e6
    remark = f"{inside:.3g} against {mine:.3g} us a pair"
    return [
        *made,
        Row(f"{name}: coal's C++ alone / ours", inside / mine, 1 / 1.5, remark),
    ]


def _fcl_boxes(boxes: list[Any], most: int = 0) -> Callable[[], object]:
    import fcl

    objects = [
        [fcl.CollisionObject(fcl.Box(*(2 * h))) for h in half] for _, _, half in boxes
    ]
    request = fcl.CollisionRequest(
        num_max_contacts=max(most, 1), enable_contact=most > 0
    )

    def loop() -> None:
        (c, turn, _), (d, other, _) = boxes
        for i, (a, b) in enumerate(zip(*objects, strict=True)):
            a.setTransform(fcl.Transform(turn[i], c[i]))
            b.setTransform(fcl.Transform(other[i], d[i]))
            fcl.collide(a, b, request, fcl.CollisionResult())

    return loop


def _coal_boxes(boxes: list[Any]) -> Callable[[], object]:
    import coal

    (c, turn, half), (d, other, half_b) = boxes
    first, second = ([coal.Box(2 * h) for h in each] for each in (half, half_b))
    request, result = coal.CollisionRequest(), coal.CollisionResult()
    request.enable_contact = False

    def loop() -> None:
        for i, (a, b) in enumerate(zip(first, second, strict=True)):
            result.clear()
            here = coal.Transform3s(turn[i], c[i])
            coal.collide(a, here, b, coal.Transform3s(other[i], d[i]), request, result)

    return loop


def _coal_spheres(c: Array, r: Array, d: Array, s: Array) -> Callable[[], object]:
    import coal

    still = np.eye(3)
    first, second = ([coal.Sphere(float(x)) for x in each] for each in (r, s))
    places = lambda i: (coal.Transform3s(still, c[i]), coal.Transform3s(still, d[i]))  # noqa: E731
    return _coal_distances(first, second, places)


def _coal_capsules(first: Any, second: Any) -> Callable[[], object]:
    """coal's capsule lies along z about its centre: its pose is found beforehand."""
    import coal

    shapes, poses = [], []
    for start, end, radius in (first, second):
        axis = end - start
        length = np.linalg.norm(axis, axis=1)
        shapes.append([coal.Capsule(float(r), float(h)) for r, h in zip(radius, length, strict=True)])  # fmt: skip
        up = np.tile([0.0, 0, 1], (PAIRS, 1))
        turned = [Rotation.align_vectors(a[None], u[None])[0] for a, u in zip(axis, up, strict=True)]  # fmt: skip
        poses.append((Rotation.concatenate(turned).as_matrix(), (start + end) / 2))
    (turn, c), (other, d) = poses

    def places(i: int) -> tuple[Any, Any]:
        return coal.Transform3s(turn[i], c[i]), coal.Transform3s(other[i], d[i])

    return _coal_distances(*shapes, places)


def _coal_hulls(
    points: Array, turns: Array, shifts: Array, *, inside: bool = False
) -> Callable[[], Any]:
    import coal

    hulls = []
    for corners in points:
        listed = coal.StdVec_Vec3s()
        for p in corners:
            listed.append(p)
        hulls.append(coal.Convex.convexHull(listed, False, ""))
    still = coal.Transform3s.Identity()

    def places(i: int) -> tuple[Any, Any]:
        return still, coal.Transform3s(turns[i], shifts[i])

    first, second = ([hull] * PAIRS for hull in hulls)
    return _coal_distances(first, second, places, inside=inside)


def _coal_distances(
    first: list[Any], second: list[Any], places: Any, *, inside: bool = False
) -> Callable[[], float]:
    """The loop; it gives the microseconds that coal counts inside."""
    import coal

    request, result = coal.DistanceRequest(), coal.DistanceResult()
    request.gjk_tolerance = request.epa_tolerance = TOLERANCE
    request.enable_timings = inside

    # ``coal.distance`` itself leaves the timings at 0. What is asked here does not keep its shapes.
    asked = [(a, b, coal.ComputeDistance(a, b)) for a, b in zip(first, second, strict=True)]  # fmt: skip

    def loop() -> float:
        for i, (a, b) in enumerate(zip(first, second, strict=True)):
            result.clear()
            here, there = places(i)
            coal.distance(a, here, b, there, request, result)
        return 0.0

    def counted() -> float:
        spent = 0.0
        for i, (*_, distance) in enumerate(asked):
            result.clear()
            distance(*places(i), request, result)
            spent += result.timings.user
        return spent

    return counted if inside else loop
