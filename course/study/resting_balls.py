"""Balls at rest on each other, in bins, in grooves and on domes; ``resting_scenes`` has them all."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from course.arrays import Array, IntArray, scalar, whole_number
from course.dynamics import Bodies
from course.overlap import Contacts
from course.study.resting_layouts import UP, RestingScene, contacts_at, weighed


def pile(
    count: int, rng: np.random.Generator, *, spread: float = 0.3, rounds: int = 150
) -> RestingScene:
    """Balls of different sizes settled in a square bin, walls and floor fixed; about 3 contacts a ball.

    They sink, are pushed apart where they overlap, and sink a little more at
    the end. Those that touch within 1 percent of the smallest radius are
    contacts; some overlap is left, which the forces do not depend on.

    Args:
        count: how many balls.
        rng: draws sizes and places.
        spread: radii are 0.5 (1 +- spread) [m].
        rounds: how long they sink; three times as long in all.
    """
    from scipy.spatial import cKDTree

    whole_number("count", count, minimum=1)
    radius = 0.5 * (1 + spread * rng.uniform(-1, 1, count))
    width = max(1.2 * (count / 0.55 * np.pi / 6) ** (1 / 3), 2.1 * radius.max())
    x = rng.uniform(0, 1, (count, 3)) * (width, width, 1.5 * width)
    lowest = np.stack([radius, radius, radius], axis=1)
    highest = np.stack([width - radius, width - radius, np.full(count, np.inf)], axis=1)
    near = np.zeros((0, 2), dtype=np.intp)
    falling = 1.6 * width / rounds * (1 - np.arange(rounds) / rounds)
    for k, sink in enumerate([*falling, *np.zeros(rounds), *np.full(rounds, 5e-4)]):
        x[:, 2] -= sink
        if k % 3 == 0:
            near = cKDTree(x).query_pairs(
                2 * radius.max() + 0.05, output_type="ndarray"
            )
        x = np.clip(x + _pushed_apart(x, radius, near), lowest, highest)
    return _ball_contacts(x, radius, width)


def cannonballs(layers: int) -> RestingScene:
    """A four-sided pyramid of equal balls, each on four of the layer below; balls of one layer touch as well."""
    whole_number("layers", layers, minimum=1)
    spots = []
    for k in range(layers):
        side = np.arange(layers - k) + 0.5 * k
        grid = np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)
        spots.append(np.column_stack([grid, np.full(len(grid), 0.5 + k / np.sqrt(2))]))
    centres = np.concatenate(spots)
    return replace(
        _ball_contacts(centres, np.full(len(centres), 0.5), None), name="cannonballs"
    )


def wedged_ball(angle: float = 0.5) -> RestingScene:
    """A ball between two walls that lean by the angle [rad]; at 0 they stand upright and hold nothing.

    With every f the forces f + (t, t) would hold upright walls' contacts as
    well: what two contacts push in all need not be unique.
    """
    lean = scalar("angle", angle)
    normal = np.array(
        [[np.cos(lean), 0, np.sin(lean)], [-np.cos(lean), 0, np.sin(lean)]]
    )
    bodies = Bodies.balls(
        np.array([1.0, np.inf]), 0.5, np.array([[0, 0, 0], [0, 0, -9.0]])
    )
    contacts = contacts_at(np.zeros(2), np.ones(2), -0.5 * normal, normal)
    return weighed("ball between two walls", bodies, contacts)


def balls_on_domes(count: int, rng: np.random.Generator) -> RestingScene:
    """Balls that slide and spin over fixed domes, one each; the fast ones are about to leave."""
    whole_number("count", count, minimum=1)
    r, dome = rng.uniform(0.05, 0.5, count), rng.uniform(0.5, 3.0, count)
    out = rng.normal(size=(count, 3))
    out[:, 2] = np.abs(out[:, 2])
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    along = rng.normal(size=(count, 3))
    along -= np.sum(along * out, axis=1, keepdims=True) * out
    spot = 10.0 * np.arange(count)[:, None] * np.array([1.0, 0, 0])
    centres = np.concatenate([spot + (r + dome)[:, None] * out, spot])
    mass = np.append(rng.uniform(0.5, 2, count), np.full(count, np.inf))
    bodies = Bodies.balls(
        mass,
        np.append(r, dome),
        centres,
        np.concatenate([2 * along, np.zeros((count, 3))]),
    )
    spin = np.zeros((2 * count, 3))
    spin[:count] = rng.normal(size=(count, 3)) * bodies.inertia[:count, 0, :1]
    index = np.arange(count)
    contacts = Contacts(
        index, count + index, spot + dome[:, None] * out, out, np.zeros(count), np.full(count, "curved"),
        None, None, np.eye(3) / r[:, None, None], np.eye(3) / dome[:, None, None],
    )  # fmt: skip
    return weighed("balls on domes", replace(bodies, angular_momentum=spin), contacts)


def _pushed_apart(x: Array, radius: Array, pairs: IntArray) -> Array:
    """Half of each overlap to either ball, averaged where a ball overlaps with several."""
    i, j = pairs[:, 0], pairs[:, 1]
    between = x[i] - x[j]
    distance = np.maximum(np.linalg.norm(between, axis=1), 1e-9)
    overlap = radius[i] + radius[j] - distance
    hit = overlap > 0
    i, j, n = i[hit], j[hit], len(x)
    step = (0.5 * overlap[hit] / distance[hit])[:, None] * between[hit]
    share = np.maximum(
        1.0, 0.5 * (np.bincount(i, minlength=n) + np.bincount(j, minlength=n))
    )
    moved = [
        np.bincount(i, step[:, k], n) - np.bincount(j, step[:, k], n) for k in range(3)
    ]
    return np.stack(moved, axis=1) / share[:, None]


def _ball_contacts(x: Array, radius: Array, width: float | None) -> RestingScene:
    """Balls with a contact wherever two, or one and a side of the bin, touch within 1 percent of a radius."""
    from scipy.spatial import cKDTree

    n, close = len(x), 0.01 * radius.min()
    pairs = (
        cKDTree(x).query_pairs(2.1 * radius.max(), output_type="ndarray").reshape(-1, 2)
    )
    i, j = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))].T
    distance = np.linalg.norm(x[i] - x[j], axis=1)
    gap = distance - radius[i] - radius[j]
    i, j, distance, gap = (value[gap < close] for value in (i, j, distance, gap))
    normal = (x[i] - x[j]) / distance[:, None]
    parts = [(i, j, x[j] + (radius[j] + 0.5 * gap)[:, None] * normal, normal, gap)]
    sides = [(UP, 0.0)]
    if width is not None:
        sides += [(np.eye(3)[k], 0.0) for k in (0, 1)] + [
            (-np.eye(3)[k], -width) for k in (0, 1)
        ]
    for out, level in sides:
        height = x @ out - level - radius
        ball = np.flatnonzero(height < close)
        point = x[ball] - (radius[ball] + 0.5 * height[ball])[:, None] * out
        parts.append(
            (
                ball,
                np.full(ball.size, n),
                point,
                np.tile(out, (ball.size, 1)),
                height[ball],
            )
        )
    a, b, point, normal, gap = (
        np.concatenate(column) for column in zip(*parts, strict=True)
    )
    mass, centres = (
        np.append(4 / 3 * np.pi * radius**3, np.inf),
        np.concatenate([x, -UP[None]]),
    )
    bodies = Bodies.balls(mass, np.append(radius, 1.0), centres)
    curvature = (1 / np.append(radius, np.inf))[:, None, None] * np.eye(3)
    feature = np.full(a.size, "curved")
    contacts = Contacts(
        a, b, point, normal, gap, feature, None, None, curvature[a], curvature[b]
    )
    return weighed(f"pile of {n} balls", bodies, contacts)
