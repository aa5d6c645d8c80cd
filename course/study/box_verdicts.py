"""Verdicts on many pairs of boxes: by few axes and by all, by balls, by other libraries, and the truth."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import astuple, dataclass

import numpy as np

from course import formulas
from course.arrays import Array, BoolArray
from course.study.engines import installed_engines
from course.study.precision import Method, Problem, WorkPrecision, work_precision

CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1.0)])


@dataclass(frozen=True, eq=False)
class BoxPairs:
    """p pairs of oriented boxes.

    Args:
        center_a, center_b: (p, 3) [m].
        rotation_a, rotation_b: columns the boxes' axes, (p, 3, 3).
        half_extents_a, half_extents_b: (p, 3) [m].
    """

    center_a: Array
    rotation_a: Array
    half_extents_a: Array
    center_b: Array
    rotation_b: Array
    half_extents_b: Array

    def __len__(self) -> int:
        return len(self.center_a)

    @property
    def arguments(self) -> tuple[Array, ...]:
        """As ``oriented_boxes_overlap`` takes them."""
        return astuple(self)


def random_turns(
    rng: np.random.Generator, count: int, *, upright: bool = False
) -> Array:
    """Rotations, (count, 3, 3): every one alike, or about z only."""
    from scipy.spatial.transform import Rotation

    if upright:
        angle = rng.uniform(0.0, 2 * np.pi, count)
        about_z = angle[:, None] * [0.0, 0.0, 1.0]
        return np.asarray(Rotation.from_rotvec(about_z).as_matrix())
    return np.asarray(Rotation.from_quat(rng.normal(size=(count, 4))).as_matrix())


def random_box_pairs(
    count: int, *, seed: int, upright: bool = False, thinnest: float = 0.2
) -> BoxPairs:
    """Pairs whose bounding balls overlap, as a broad phase leaves them.

    Args:
        upright: turned about z only, centres at one height: cars on a flat ground.
        thinnest: half extents are drawn between this and 1 [m].
    """
    rng = np.random.default_rng(seed)
    e = rng.uniform(thinnest, 1.0, (2, count, 3))
    way = rng.normal(size=(count, 3)) * [1.0, 1.0, 0.0 if upright else 1.0]
    way /= np.linalg.norm(way, axis=-1, keepdims=True)
    reach = np.linalg.norm(e, axis=-1).sum(axis=0)
    # Uniform in the ball, or the disc, in which the centre of B can lie.
    radius = rng.uniform(0.0, 1.0, count) ** (1 / 2 if upright else 1 / 3) * reach
    turns = [random_turns(rng, count, upright=upright) for _ in "ab"]
    center_a = np.zeros((count, 3))
    return BoxPairs(center_a, turns[0], e[0], radius[:, None] * way, turns[1], e[1])


def gaps_on_axes(pairs: BoxPairs, count: int = 15) -> Array:
    """Gaps on the first of the 15 axes, (p, count) [m]; on edges' products times their length."""
    axes = formulas.box_axes(pairs.rotation_a, pairs.rotation_b)[:, :count]
    between = pairs.center_b - pairs.center_a
    gap = np.abs(np.einsum("pkd,pd->pk", axes, between))
    gap -= np.einsum(
        "pki,pi->pk", np.abs(axes @ pairs.rotation_a), pairs.half_extents_a
    )
    gap -= np.einsum(
        "pki,pi->pk", np.abs(axes @ pairs.rotation_b), pairs.half_extents_b
    )
    return np.asarray(gap)


def by_axes(pairs: BoxPairs, count: int) -> tuple[BoolArray, int]:
    """The verdict of the first axes, and how many axes a program tries that stops at the first gap."""
    apart = gaps_on_axes(pairs, count) > 0
    tried = np.where(apart.any(axis=-1), np.argmax(apart, axis=-1) + 1, count)
    return np.asarray(~apart.any(axis=-1)), int(tried.sum())


def by_balls(pairs: BoxPairs) -> BoolArray:
    """The verdict of the bounding balls."""
    reach = np.linalg.norm(pairs.half_extents_a, axis=-1) + np.linalg.norm(pairs.half_extents_b, axis=-1)  # fmt: skip
    away = pairs.center_b - pairs.center_a
    return np.asarray(np.sum(away**2, axis=-1) <= reach**2)


def by_upright_boxes(pairs: BoxPairs) -> BoolArray:
    """The verdict of the axis-aligned boxes around both, |R| e."""
    reach = np.einsum("pij,pj->pi", np.abs(pairs.rotation_a), pairs.half_extents_a)
    reach += np.einsum("pij,pj->pi", np.abs(pairs.rotation_b), pairs.half_extents_b)
    return np.asarray(np.all(np.abs(pairs.center_b - pairs.center_a) <= reach, axis=-1))


def true_overlap(pairs: BoxPairs) -> BoolArray:
    """The truth, without any of the axes: is 0 in Qhull's hull of all differences of corners?"""
    from scipy.spatial import ConvexHull

    points = [
        np.einsum("pij,pcj->pci", r, CORNERS * e[:, None]) + c[:, None]
        for c, r, e in (pairs.arguments[:3], pairs.arguments[3:])
    ]
    difference = (points[0][:, :, None] - points[1][:, None]).reshape(len(pairs), 64, 3)
    return np.array([ConvexHull(d).equations[:, -1].max() <= 0 for d in difference])


def wrong_share(verdict: BoolArray, truth: BoolArray) -> float:
    """Share of the verdicts that are not the truth."""
    return float(np.mean(verdict != truth))


def box_verdict_costs(
    pairs: BoxPairs, truth: BoolArray, *, peers: bool = True
) -> WorkPrecision:
    """Wrong verdicts against cost: balls, upright boxes, the first 1 to 15 axes, and libraries.

    The counted unit is an axis on which a pair is compared, where a program stops at
    the first gap. A ball counts as one, an upright box as three. What the libraries
    count inside is not known: they have a count of 0.
    """
    problem = Problem(
        f"{len(pairs)} pairs of boxes", lambda verdict: wrong_share(verdict, truth),
        "share of wrong verdicts", "whether 0 lies in the hull of all differences",
    )  # fmt: skip
    methods = [
        Method("balls", lambda _: (by_balls(pairs), len(pairs)), (1,)),
        Method("upright boxes", lambda _: (by_upright_boxes(pairs), 3 * len(pairs)), (3,)),
        Method("first k axes", lambda k: by_axes(pairs, int(k)), tuple(range(1, 16)), "axes"),
    ]  # fmt: skip
    for name, asked in installed_engines().items() if peers else ():
        methods.append(Method(name, _asking(asked, pairs), (1,)))
    return work_precision(problem, methods, count_unit="axes compared")


def _asking(
    asked: Callable[..., BoolArray], pairs: BoxPairs
) -> Callable[[float], tuple[BoolArray, int]]:
    return lambda _: (asked(*pairs.arguments), 0)
