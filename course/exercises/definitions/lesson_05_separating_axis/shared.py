"""What the exercises of this lesson share: values, and pairs of polygons and boxes by what sees them apart.

Many pairs are drawn at once, and then taken by their kind: a check must not wait.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from scipy.spatial.transform import Rotation

from course import formulas
from course.arrays import Array, BoolArray
from course.exercises.definition import Value

VERTICES_A = Value("vertices_a", "(..., n, 2)", "m", "A's vertices, counter-clockwise")
VERTICES_B = Value("vertices_b", "(..., m, 2)", "m", "B's vertices, counter-clockwise")

#: No verdict hangs on rounding: greatest gaps are at least this far from 0 [m].
CLEAR = 0.02
#: Pairs drawn at once.
POOL = 1500
#: Arguments by name; of many pairs, with the pair as first axis.
Pairs = dict[str, Array]
#: Greatest gaps of each pair on families of axes, by the family's name, (p,) [m].
Gaps = Mapping[str, Array]
Kind = Callable[[Gaps], BoolArray]


def taken(
    rng: np.random.Generator,
    drawn: Callable[[np.random.Generator], Pairs],
    gaps: Callable[[Pairs], Gaps],
    kinds: Sequence[Kind],
    shape: tuple[int, ...] = (),
) -> Pairs:
    """Pairs of a batch of this shape: the first is of the first kind, and so in turn."""
    pool, found = drawn(rng), []
    seen, used = gaps(pool), np.zeros(POOL, dtype=bool)
    for k in range(int(np.prod(shape))):
        fits = kinds[k % len(kinds)](seen) & ~used
        while not fits.any():
            pool = drawn(rng)
            seen, used = gaps(pool), np.zeros(POOL, dtype=bool)
            fits = kinds[k % len(kinds)](seen)
        first = int(np.argmax(fits))
        used[first] = True
        found.append({name: values[first] for name, values in pool.items()})
    stacked = {name: np.stack([pair[name] for pair in found]) for name in found[0]}
    return {name: v.reshape(*shape, *v.shape[1:]) for name, v in stacked.items()}


# Polygons.


def polygons(rng: np.random.Generator, corners: int, count: int) -> Array:
    """Convex polygons without parallel sides: corners on a turned ellipse, (count, n, 2) [m].

    Rectangles would hide edges used as axes.
    """
    found = np.zeros((0, corners))
    while len(found) < count:
        angle = np.sort(rng.uniform(0.0, 2 * np.pi, (4 * count, corners)), axis=-1)
        steps = np.diff(angle, append=angle[:, :1] + 2 * np.pi)
        good = (steps.min(axis=-1) > 1.2 / corners) & (steps.max(axis=-1) < 3.0)
        found = np.concatenate([found, angle[good]])
    angle = found[:count]
    flat = rng.uniform(0.4, 0.9, (count, 1))
    x, y = np.cos(angle), flat * np.sin(angle)
    turn = rng.uniform(0.0, 2 * np.pi, (count, 1))
    c, s = np.cos(turn), np.sin(turn)
    return np.asarray(np.round(np.stack([c * x - s * y, s * x + c * y], axis=-1), 3))


def _polygon_pairs(corners: tuple[int, int]) -> Callable[[np.random.Generator], Pairs]:
    def drawn(rng: np.random.Generator) -> Pairs:
        a, b = (polygons(rng, n, POOL) for n in corners)
        center = rng.uniform(-3.0, 3.0, (POOL, 1, 2))
        shift = center + rng.uniform(-1.6, 1.6, (POOL, 1, 2))
        return {
            "vertices_a": np.round(a + center, 3),
            "vertices_b": np.round(b + shift, 3),
        }

    return drawn


def polygon_gaps(pairs: Pairs) -> Gaps:
    """Greatest gaps on A's, on B's edge normals, along x and y; the second of all; and of A above or below B."""
    a, b = pairs["vertices_a"], pairs["vertices_b"]
    normals = formulas.edge_normals(a), formulas.edge_normals(b)
    both = np.concatenate(normals, axis=-2)
    shadow_a, shadow_b = formulas.project(a, both), formulas.project(b, both)
    gap, count = formulas.shadow_gap(*shadow_a, *shadow_b), a.shape[-2]
    upright = np.eye(2)
    along_xy = formulas.shadow_gap(
        *formulas.project(a, upright), *formulas.project(b, upright)
    )
    return {
        "A": gap[..., :count].max(axis=-1),
        "B": gap[..., count:].max(axis=-1),
        "xy": along_xy.max(axis=-1),
        "second": np.sort(gap, axis=-1)[..., -2],
        "above": (shadow_a[0] - shadow_b[1]).max(axis=-1),
        "below": (shadow_b[0] - shadow_a[1]).max(axis=-1),
    }


def polygon_pairs(
    rng: np.random.Generator, kinds: Sequence[str] | str, shape: tuple[int, ...] = (),
    corners: tuple[int, int] = (3, 5),
) -> Pairs:  # fmt: skip
    """Pairs whose kinds, of ``KINDS`` or ``OWNERS``, take turns."""
    names = [kinds] if isinstance(kinds, str) else kinds
    return taken(
        rng,
        _polygon_pairs(corners),
        polygon_gaps,
        [(KINDS | OWNERS)[k] for k in names],
        shape,
    )


#: What a pair of polygons must be.
KINDS: dict[str, Kind] = {
    "overlap": lambda g: (_any(g) > -0.3) & (_any(g) < -CLEAR),
    "seen by A only": lambda g: (g["A"] > CLEAR) & (g["B"] < -CLEAR),
    "seen by B only": lambda g: (g["B"] > CLEAR) & (g["A"] < -CLEAR),
    "not seen along x and y": lambda g: (_any(g) > CLEAR) & (g["xy"] < -CLEAR),
    "near": lambda g: (np.abs(_any(g)) > CLEAR) & (np.abs(_any(g)) < 0.4),
    "deep": lambda g: _any(g) < -0.3,
}
#: With one least shift only, across an edge of A or of B; or apart, with A above B or below it on the axes.
OWNERS: dict[str, Kind] = {
    "across A": lambda g: (g["A"] < -CLEAR) & (g["A"] > np.maximum(g["B"], g["second"] + CLEAR)),
    "across B": lambda g: (g["B"] < -CLEAR) & (g["B"] > np.maximum(g["A"], g["second"] + CLEAR)),
    "above only": lambda g: (g["above"] > CLEAR) & (g["below"] < -CLEAR),
    "below only": lambda g: (g["below"] > CLEAR) & (g["above"] < -CLEAR),
}  # fmt: skip


def _any(gaps: Gaps) -> Array:
    """The greatest gap of all axes that decide."""
    return np.max(
        [v for name, v in gaps.items() if name in ("A", "B", "edges")], axis=0
    )


# Boxes. The gap that each family of axes sees, so that no family can be left out.


def turns(rng: np.random.Generator, count: int) -> Array:
    """Drawn rotations, every one alike, (count, 3, 3)."""
    return np.asarray(Rotation.from_quat(rng.normal(size=(count, 4))).as_matrix())


def _boxes(rng: np.random.Generator) -> Pairs:
    """Pairs of boxes, one often much larger than the other."""
    way = rng.normal(size=(POOL, 3))
    center = rng.normal(size=(POOL, 3))
    size = rng.uniform(0.3, 1.6, (2, POOL, 1))
    e = np.round(size * rng.uniform(0.3, 1.0, (2, POOL, 3)), 3)
    reach = np.linalg.norm(e, axis=-1, keepdims=True).sum(axis=0)
    apart = rng.uniform(0.2, 1.0, (POOL, 1)) * reach
    apart = apart * way / np.linalg.norm(way, axis=-1, keepdims=True)
    return {
        "center_a": np.round(center, 3),
        "rotation_a": turns(rng, POOL),
        "half_extents_a": e[0],
        "center_b": np.round(center + apart, 3),
        "rotation_b": turns(rng, POOL),
        "half_extents_b": e[1],
    }


def box_gaps(pairs: Pairs) -> Gaps:
    """Greatest gaps on A's face normals, on B's, and on the products of edges."""
    axes = formulas.box_axes(pairs["rotation_a"], pairs["rotation_b"])
    axes = axes / np.linalg.norm(axes, axis=-1, keepdims=True)
    between = pairs["center_b"] - pairs["center_a"]
    gap = np.abs(np.sum(axes * between[..., None, :], axis=-1))
    for x in "ab":
        cosines = np.abs(axes @ pairs[f"rotation_{x}"])
        gap -= np.sum(cosines * pairs[f"half_extents_{x}"][..., None, :], axis=-1)
    families = {"A": gap[..., :3], "B": gap[..., 3:6], "edges": gap[..., 6:]}
    return {name: g.max(axis=-1) for name, g in families.items()}


def box_pairs(
    rng: np.random.Generator, kinds: Sequence[str] | str, shape: tuple[int, ...] = ()
) -> Pairs:
    """Pairs of boxes whose kinds, of ``KINDS`` or ``BOX_KINDS``, take turns."""
    names = [kinds] if isinstance(kinds, str) else kinds
    known = KINDS | BOX_KINDS
    return taken(rng, _boxes, box_gaps, [known[k] for k in names], shape)


BOX_KINDS: dict[str, Kind] = {
    "seen by A only": lambda g: (g["A"] > CLEAR) & (np.maximum(g["B"], g["edges"]) < -CLEAR),
    "seen by B only": lambda g: (g["B"] > CLEAR) & (np.maximum(g["A"], g["edges"]) < -CLEAR),
    "seen by edges only": lambda g: (g["edges"] > CLEAR) & (np.maximum(g["A"], g["B"]) < -CLEAR),
}  # fmt: skip


def values_of_box(name: str) -> tuple[Value, Value, Value]:
    """The three arguments of a box, "a" or "b"."""
    body = name.upper()
    return (
        Value(f"center_{name}", "(..., 3)", "m", f"centre of {body}"),
        Value(f"rotation_{name}", "(..., 3, 3)", "", f"columns: the axes of {body}"),
        Value(f"half_extents_{name}", "(..., 3)", "m", f"half the sides of {body}"),
    )
