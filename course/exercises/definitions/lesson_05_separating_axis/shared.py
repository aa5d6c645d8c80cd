"""What the exercises of this lesson share: values, and pairs of polygons and boxes by what sees them apart."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from course import formulas
from course.arrays import Array
from course.exercises.definition import Value

VERTICES_A = Value("vertices_a", "(..., n, 2)", "m", "A's vertices, counter-clockwise")
VERTICES_B = Value("vertices_b", "(..., m, 2)", "m", "B's vertices, counter-clockwise")

#: No verdict hangs on rounding: greatest gaps are at least this far from 0 [m].
CLEAR = 0.02
Pair = dict[str, Array]
#: Greatest gaps of a pair on its families of axes, by the family's name [m].
Gaps = Mapping[str, float]


def polygon(rng: np.random.Generator, corners: int) -> Array:
    """A convex polygon without equal or parallel sides: corners on a turned ellipse, (n, 2) [m].

    Rectangles would hide edges used as axes.
    """
    while True:
        angle = np.sort(rng.uniform(0.0, 2 * np.pi, corners))
        steps = np.diff(angle, append=angle[:1] + 2 * np.pi)
        if steps.min() > 0.5 and steps.max() < 3.0:
            break
    points = np.stack([np.cos(angle), rng.uniform(0.4, 0.9) * np.sin(angle)], axis=-1)
    turn = rng.uniform(0.0, 2 * np.pi)
    c, s = np.cos(turn), np.sin(turn)
    return np.asarray(np.round(points @ np.array([[c, s], [-s, c]]), 3))


def polygon_gaps(vertices_a: Array, vertices_b: Array) -> Gaps:
    """Greatest gaps of one pair on A's, on B's edge normals, and on x and y."""
    families = {
        "A": formulas.edge_normals(vertices_a),
        "B": formulas.edge_normals(vertices_b),
        "xy": np.eye(2),
    }
    return {name: _greatest(vertices_a, vertices_b, axes) for name, axes in families.items()}


def _greatest(vertices_a: Array, vertices_b: Array, axes: Array) -> float:
    shadows = formulas.project(vertices_a, axes), formulas.project(vertices_b, axes)
    return float(formulas.shadow_gap(*shadows[0], *shadows[1]).max())


def polygon_pair(
    rng: np.random.Generator, kind: str = "any", corners: tuple[int, int] = (3, 5)
) -> Pair:
    """A pair near touching, drawn until it is of a kind of ``KINDS``."""
    while True:
        a, b = (polygon(rng, n) for n in corners)
        b = np.round(b + rng.uniform(-1.6, 1.6, 2), 3)
        gaps = polygon_gaps(a, b)
        if abs(max(gaps["A"], gaps["B"])) > CLEAR and KINDS[kind](gaps):
            return {"vertices_a": a, "vertices_b": b}


#: What a pair of polygons must be.
KINDS: dict[str, Callable[[Gaps], bool]] = {
    "any": lambda g: abs(max(g["A"], g["B"])) < 0.4,
    "overlap": lambda g: -0.3 < max(g["A"], g["B"]) < 0,
    "seen by A only": lambda g: g["A"] > CLEAR and g["B"] < -CLEAR,
    "seen by B only": lambda g: g["B"] > CLEAR and g["A"] < -CLEAR,
    "not seen along x and y": lambda g: max(g["A"], g["B"]) > CLEAR and g["xy"] < -CLEAR,
}  # fmt: skip


def crossing(rng: np.random.Generator) -> Pair:
    """Two slim kites that cross like a plus sign: no corner of one lies in the other."""
    a = np.array([[-2.0, 0.1], [0.2, -0.3], [2.2, 0.0], [-0.1, 0.4]])
    shift = np.round(rng.uniform(-0.2, 0.2, 2), 3)
    return {"vertices_a": a, "vertices_b": a[:, ::-1] * [-1.0, 1.0] + shift}


def one_inside(rng: np.random.Generator) -> Pair:
    """A small pentagon inside a large triangle."""
    large = np.array([[-3.0, -2.0], [4.0, -2.5], [0.5, 3.5]])
    small = np.round(0.3 * polygon(rng, 5) + rng.uniform(-0.3, 0.3, 2), 3)
    return {"vertices_a": large, "vertices_b": small}


def touching() -> Pair:
    """A corner of B on an upright edge of A, in numbers that are exact."""
    return {
        "vertices_a": np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 3.0]]),
        "vertices_b": np.array([[2.0, 1.0], [3.0, 0.5], [4.0, 2.0], [3.0, 2.5]]),
    }


def together(pairs: Iterable[Pair], shape: tuple[int, ...]) -> Pair:
    """Pairs as one batch of this shape."""
    listed = list(pairs)
    stacked = {name: np.stack([pair[name] for pair in listed]) for name in listed[0]}
    return {name: v.reshape(*shape, *v.shape[1:]) for name, v in stacked.items()}


# Boxes. The gap that each family of axes sees, so that no family can be left out.


def turn(rng: np.random.Generator) -> Array:
    """A drawn rotation, (3, 3)."""
    return np.asarray(Rotation.from_quat(rng.normal(size=4)).as_matrix())


def box_pair(rng: np.random.Generator, kind: str = "any") -> Pair:
    """Two boxes near touching, drawn until they are of a kind of ``BOX_KINDS``."""
    while True:
        pair = _boxes(rng)
        gaps = box_gaps(pair)
        if abs(max(gaps.values())) > CLEAR and BOX_KINDS[kind](gaps):
            return pair


def _boxes(rng: np.random.Generator) -> Pair:
    way = rng.normal(size=3)
    center = rng.normal(size=3)
    apart = rng.uniform(0.8, 2.2) * way / np.linalg.norm(way)
    return {
        "center_a": np.round(center, 3),
        "rotation_a": turn(rng),
        "half_extents_a": np.round(rng.uniform(0.2, 1.2, 3), 3),
        "center_b": np.round(center + apart, 3),
        "rotation_b": turn(rng),
        "half_extents_b": np.round(rng.uniform(0.2, 1.2, 3), 3),
    }


def box_gaps(pair: Pair) -> Gaps:
    """Greatest gaps on A's face normals, on B's, and on the products of edges."""
    axes = formulas.box_axes(pair["rotation_a"], pair["rotation_b"])
    axes = axes / np.linalg.norm(axes, axis=-1, keepdims=True)
    half = [
        np.abs(axes @ pair[f"rotation_{x}"]) @ pair[f"half_extents_{x}"] for x in "ab"
    ]
    gap = np.abs(axes @ (pair["center_b"] - pair["center_a"])) - half[0] - half[1]
    return {"A": float(gap[:3].max()), "B": float(gap[3:6].max()), "edges": float(gap[6:].max())}  # fmt: skip


BOX_KINDS: dict[str, Callable[[Gaps], bool]] = {
    "any": lambda g: abs(max(g.values())) < 0.3,
    "overlap": lambda g: -0.3 < max(g.values()) < 0,
    "seen by A only": lambda g: g["A"] > CLEAR and max(g["B"], g["edges"]) < -CLEAR,
    "seen by B only": lambda g: g["B"] > CLEAR and max(g["A"], g["edges"]) < -CLEAR,
    "seen by edges only": lambda g: g["edges"] > CLEAR and max(g["A"], g["B"]) < -CLEAR,
}


def values_of_box(name: str) -> tuple[Value, Value, Value]:
    """The three arguments of a box, "a" or "b"."""
    body = name.upper()
    return (
        Value(f"center_{name}", "(..., 3)", "m", f"centre of {body}"),
        Value(f"rotation_{name}", "(..., 3, 3)", "", f"columns: the axes of {body}"),
        Value(f"half_extents_{name}", "(..., 3)", "m", f"half the sides of {body}"),
    )


