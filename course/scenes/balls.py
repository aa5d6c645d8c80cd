"""Balls at rest on each other, in bins and on domes; and balls about to hit one another."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    IntArray,
    failure,
    positive,
    scalar,
    scalars,
    whole_number,
)
from course.dynamics import Bodies
from course.overlap import Contacts, Spheres
from course.scenes.layout import UP
from course.scenes.scene import GRAVITY, Scene, resting

#: A pool ball: radius [m] and mass [kg] (2 1/4 inches and 6 ounces).
POOL_RADIUS, POOL_MASS = 0.028575, 0.17


def pile(
    count: int, rng: np.random.Generator, *, spread: float = 0.3, rounds: int = 150
) -> Scene:
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
    return _settled(f"pile of {count} balls", x, radius, width)


def cannonballs(layers: int) -> Scene:
    """A four-sided pyramid of equal balls, each on four of the layer below; balls of one layer touch as well."""
    whole_number("layers", layers, minimum=1)
    spots = []
    for k in range(layers):
        side = np.arange(layers - k) + 0.5 * k
        grid = np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)
        spots.append(np.column_stack([grid, np.full(len(grid), 0.5 + k / np.sqrt(2))]))
    centres = np.concatenate(spots)
    return _settled("cannonballs", centres, np.full(len(centres), 0.5), None)


def balls_on_domes(count: int, rng: np.random.Generator) -> Scene:
    """Balls that slide and spin over fixed domes, one each; the fast ones are about to leave.

    Each alone has f = max(0, m (g N_z - v^2/(r + R))).
    """
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
    velocity = np.concatenate([2 * along, np.zeros((count, 3))])
    bodies = Bodies.balls(mass, np.append(r, dome), centres, velocity)
    angular_momentum = np.zeros((2 * count, 3))
    angular_momentum[:count] = (
        rng.normal(size=(count, 3)) * bodies.inertia[:count, 0, :1]
    )
    index = np.arange(count)
    contacts = Contacts(
        index,
        count + index,
        spot + dome[:, None] * out,
        out,
        np.zeros(count),
        np.full(count, "curved"),
        curvature_a=np.eye(3) / r[:, None, None],
        curvature_b=np.eye(3) / dome[:, None, None],
    )
    needed = GRAVITY * out[:, 2] - np.sum((2 * along) ** 2, axis=1) / (r + dome)
    return resting(
        "balls on domes",
        replace(bodies, angular_momentum=angular_momentum),
        contacts,
        truth=mass[:count] * np.maximum(needed, 0.0),
    )


def touching_row(
    velocity: ArrayLike, *, mass: ArrayLike = 1.0, radius: float = 0.5
) -> Scene:
    """n balls in a row along x, each touching the next, and their n - 1 contacts in order.

    Args:
        velocity: along x, (n,) [m/s].
        mass: one or (n,) [kg].
        radius: [m].
    """
    v = scalars("velocity", velocity)
    if v.ndim != 1 or v.size < 2:
        expected = "the speeds of at least two balls, shape (n,)"
        raise failure("velocity", expected, f"shape {v.shape}")
    along, r = np.array([1.0, 0, 0]), scalar("radius", positive("radius", radius))
    position = 2 * r * np.outer(np.arange(v.size), along)
    bodies = Bodies.balls(mass, r, position, np.outer(v, along))
    return _in_flight(f"row of {v.size} balls", bodies, r)


def rack(*, rows: int = 5, radius: float = POOL_RADIUS, spacing: float = 0.0) -> Array:
    """Centres of a triangle of balls in the plane z = 0, apex at the origin, opening toward +x, (n, 3) [m].

    Args:
        rows: 5 make 15 balls.
        spacing: gap between neighbours [m]; 0 makes them touch.
    """
    count, r = (
        whole_number("rows", rows, minimum=1),
        float(positive("radius", scalar("radius", radius))),
    )
    row = np.repeat(np.arange(count), np.arange(1, count + 1))
    place = np.concatenate([np.arange(k + 1) - 0.5 * k for k in range(count)])
    pitch = 2 * r + scalar("spacing", spacing)
    return pitch * np.stack([np.sqrt(0.75) * row, place, np.zeros(row.size)], axis=-1)


def billiard_rack(
    *,
    speed: float = 8.0,
    offset: float = 0.0,
    rows: int = 5,
    radius: float = POOL_RADIUS,
    mass: float = POOL_MASS,
) -> Scene:
    """The cue ball, body 0, moving along +x, at the moment it touches the apex of a rack of touching balls.

    Args:
        speed: of the cue ball [m/s].
        offset: how far its path passes beside the apex ball's centre, below 2 radius [m].
        rows: of the rack; 5 make 15 balls.
        radius, mass: of every ball [m], [kg].
    """
    balls, side = rack(rows=rows, radius=radius), scalar("offset", offset)
    if abs(side) >= 2 * radius:
        raise failure("offset", f"less than two radii, {2 * radius:g}", f"{side:g}")
    cue = np.array([-np.sqrt(4 * radius**2 - side**2), side, 0.0])
    position = np.concatenate([cue[None], balls])
    velocity = np.zeros(position.shape)
    velocity[0, 0] = positive("speed", scalar("speed", speed))
    bodies = Bodies.balls(mass, radius, position, velocity)
    return _in_flight(f"cue ball on a rack of {len(balls)}", bodies, radius)


def _in_flight(name: str, bodies: Bodies, radius: float) -> Scene:
    """Balls of one radius without gravity; what touches within a millionth of it is a contact."""
    balls = Spheres(np.full(len(bodies), radius), margin=1e-6 * radius)
    touching = balls.contacts(bodies.position, bodies.rotation)
    return Scene(bodies, balls, touching, name=name)


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


def _settled(name: str, x: Array, radius: Array, width: float | None) -> Scene:
    """Balls with a contact wherever two, or one and a side of the bin, touch within 1 percent of a radius."""
    normal, offset = UP[None], np.zeros(1)
    if width is not None:
        sides = np.eye(3)[:2]
        normal = np.concatenate([normal, sides, -sides])
        offset = np.array([0.0, 0.0, 0.0, -width, -width])
    balls = Spheres(radius, normal, offset, margin=0.01 * radius.min())
    mass, centres = 4 / 3 * np.pi * radius**3, np.concatenate([x, -UP[None]])
    bodies = Bodies.balls(np.append(mass, np.inf), np.append(radius, 1.0), centres)
    touching = balls.contacts(bodies.position, bodies.rotation)
    return resting(name, bodies, touching, colliders=balls)
