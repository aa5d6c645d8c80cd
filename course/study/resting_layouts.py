"""Boxes, tables, rods and tangles at rest, laid out by hand; ``resting_scenes`` has them all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from course import rotations
from course.arrays import (
    Array,
    ArrayLike,
    IntArray,
    choice,
    positive,
    scalar,
    whole_number,
)
from course.contact import ContactSystem, contact_system
from course.dynamics import Bodies
from course.overlap import Contacts

GRAVITY = 9.81
UP = np.array([0.0, 0.0, 1.0])
#: The corners of a square of side 2, in the order in which corners are counted everywhere.
FOUR = ((1, 1, 0), (-1, 1, 0), (-1, -1, 0), (1, -1, 0))


@dataclass(frozen=True, eq=False)
class RestingScene:
    """Bodies, their contacts, and the external force and torque on each body.

    Args:
        name: what it shows.
        bodies: n bodies.
        contacts: c contacts with d_dot = 0.
        force, torque: (n, 3) [N, N m].
        solvable: whether contact forces exist that keep all d_ddot >= 0.
    """

    name: str
    bodies: Bodies
    contacts: Contacts
    force: Array
    torque: Array
    solvable: bool = True

    def system(self) -> ContactSystem:
        """Its contact system."""
        return contact_system(self.bodies, self.contacts, self.force, self.torque)


def table(
    legs: int = 4,
    *,
    offset: tuple[float, float] = (0.1, 0.05),
    half_widths: tuple[float, float] = (0.5, 0.3),
) -> RestingScene:
    """A table of 1 kg on the ground, 4 legs at the corners, any other number on the ellipse through these.

    Four legs are one too many: A has rank 3, and with f every
    f + t (1, -1, 1, -1) that is not negative solves it.

    Args:
        legs: how many, counted from (+, +) to (-, +).
        offset: of the centre of mass from the middle of the legs [m].
        half_widths: a and b, half the distances between the corners [m].
    """
    whole_number("legs", legs, minimum=1)
    a, b = half_widths
    angle = 2 * np.pi * (np.arange(legs) + 0.5) / legs
    feet = np.stack(
        [
            np.sqrt(2) * a * np.cos(angle),
            np.sqrt(2) * b * np.sin(angle),
            np.zeros(legs),
        ],
        axis=1,
    )
    centre = np.array([*offset, 0.7])
    bodies = with_ground([1.0], np.diag([0.2, 0.3, 0.4])[None], centre[None])
    contacts = contacts_at(np.zeros(legs), np.ones(legs), feet, np.tile(UP, (legs, 1)))
    return weighed(f"table on {legs} legs", bodies, contacts)


def stack(
    count: int,
    *,
    mass: ArrayLike = 1.0,
    corners: int = 4,
    size: tuple[float, float, float] = (1.0, 1.0, 1.0),
) -> RestingScene:
    """A tower of boxes, the lowest on the ground; each rests on 4 corners, or on 1 point under its centre.

    Args:
        count: how many boxes.
        mass: one or (count,), from below [kg].
        corners: 4, or 1, with which A is tridiagonal.
        size: edges of each box [m].
    """
    whole_number("count", count, minimum=1)
    choice("corners", str(corners), ("1", "4"))
    masses = np.broadcast_to(positive("mass", mass), count)
    height = size[2] * np.arange(count)
    position = np.stack(
        [np.zeros(count), np.zeros(count), height + 0.5 * size[2]], axis=1
    )
    bodies = with_ground(
        masses, _box_inertia(masses, np.tile(size, (count, 1))), position
    )
    corner = (
        np.zeros((1, 3))
        if corners == 1
        else 0.5 * np.array(FOUR) * (size[0], size[1], 0)
    )
    point = (corner + height[:, None, None] * UP).reshape(-1, 3)
    upper = np.repeat(np.arange(count), len(corner))
    contacts = contacts_at(
        upper,
        np.where(upper == 0, count, upper - 1),
        point,
        np.tile(UP, (len(point), 1)),
    )
    return weighed(f"stack of {count}", bodies, contacts)


def wall(
    rows: int, columns: int, *, depth: int = 1, mass: ArrayLike = 1.0
) -> RestingScene:
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
    low = np.concatenate(spots)  # the corner of each brick with the least coordinates
    count = len(low)
    masses = np.broadcast_to(positive("mass", mass), count)
    size = np.array([2.0, 1.0, 1.0])
    bodies = with_ground(
        masses, _box_inertia(masses, np.tile(size, (count, 1))), low + 0.5 * size
    )
    upper, lower = _supports(low, size)
    ground = np.flatnonzero(low[:, 2] == 0)
    upper, lower = (
        np.concatenate([ground, upper]),
        np.concatenate([np.full(ground.size, count), lower]),
    )
    below = np.where(
        (lower == count)[:, None], low[upper], low[np.minimum(lower, count - 1)]
    )
    start, end = np.maximum(low[upper], below), np.minimum(low[upper], below) + size
    at = 0.5 * (np.array(FOUR) + (1, 1, 0))
    point = start[:, None] * (1 - at) + end[:, None] * at
    point[:, :, 2] = low[upper, None, 2]
    normal = np.tile(UP, (4 * upper.size, 1))
    contacts = contacts_at(
        np.repeat(upper, 4), np.repeat(lower, 4), point.reshape(-1, 3), normal
    )
    return weighed(f"wall of {count} bricks", bodies, contacts)


def tangle(count: int, contacts: int, rng: np.random.Generator) -> RestingScene:
    """Bodies pushed at random, with contacts anywhere and in any direction between any two or one and the ground.

    No geometry would make it, and no body has such inertias; solvers must
    bear both. Velocities are 0, so a solution exists.
    """
    whole_number("count", count, minimum=1)
    whole_number("contacts", contacts)
    root = rng.normal(size=(count, 3, 3))
    mass = rng.uniform(0.5, 2, count)
    bodies = with_ground(
        mass,
        root @ np.swapaxes(root, 1, 2) + 0.1 * np.eye(3),
        rng.normal(size=(count, 3)),
    )
    a = rng.integers(count, size=contacts)
    b = (a + rng.integers(1, count + 1, size=contacts)) % (count + 1)
    normal = rng.normal(size=(contacts, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    scene = weighed(
        "tangle", bodies, contacts_at(a, b, rng.normal(size=(contacts, 3)), normal)
    )
    push = rng.normal(size=(2, count + 1, 3))
    return replace(scene, force=scene.force + push[0], torque=push[1])


def spinning_between_pins(rate: float = 2.0, gravity: float = 0.0) -> RestingScene:
    """A block that turns between two fixed pins at the middles of opposite faces: no force keeps it out of both.

    Its faces would have to stay 1 m apart along a line that turns past them:
    d_ddot = -rate^2 r at each pin, and a push on one pin takes from the other.
    Without spin a force exists.
    """
    bodies = with_ground([1.0], np.eye(3)[None] / 6, np.zeros((1, 3)))
    spin = np.array([[0, 0, scalar("rate", rate) / 6], [0, 0, 0]])
    point, normal = (
        np.array([[-0.5, 0, 0], [0.5, 0, 0]]),
        np.array([[1.0, 0, 0], [-1.0, 0, 0]]),
    )
    contacts = contacts_at(np.zeros(2), np.ones(2), point, normal)
    contacts = replace(contacts, feature=np.array(["face_a", "face_a"]))
    scene = weighed(
        "block between two pins",
        replace(bodies, angular_momentum=spin),
        contacts,
        gravity,
    )
    return replace(scene, solvable=rate == 0)


def leaning_rod(angle: float, *, length: float = 1.0) -> RestingScene:
    """A thin rod of 1 kg let go with one end on the smooth ground, at an angle from the horizontal [rad].

    The ground carries m g / (1 + 3 cos^2 angle) at that moment.
    """
    tilt = scalar("angle", angle)
    centre = (
        0.5
        * scalar("length", positive("length", length))
        * np.array([np.cos(tilt), 0.0, np.sin(tilt)])
    )
    along = np.outer(centre, centre) / (centre @ centre)
    inertia = length**2 / 12 * (np.eye(3) - along) + 1e-6 * along
    bodies = with_ground([1.0], inertia[None], centre[None])
    contacts = contacts_at(np.zeros(1), np.ones(1), np.zeros((1, 3)), UP[None])
    return weighed("leaning rod", bodies, contacts)


def side_by_side(scenes: Sequence[RestingScene]) -> RestingScene:
    """Scenes that do not touch, as one; each keeps its ground."""
    bodies = [scene.bodies for scene in scenes]
    start = np.cumsum([0] + [len(b) for b in bodies])
    contacts = [
        replace(s.contacts, body_a=s.contacts.body_a + n, body_b=s.contacts.body_b + n)
        for s, n in zip(scenes, start, strict=False)
    ]
    return RestingScene(
        f"{len(scenes)} scenes", Bodies.concatenate(bodies), Contacts.concatenate(contacts),
        np.concatenate([s.force for s in scenes]), np.concatenate([s.torque for s in scenes]),
        all(s.solvable for s in scenes),
    )  # fmt: skip


def weighed(
    name: str, bodies: Bodies, contacts: Contacts, gravity: float = GRAVITY
) -> RestingScene:
    """A scene in which only gravity acts."""
    weight = -np.where(bodies.fixed, 0.0, bodies.mass)[:, None] * gravity * UP
    return RestingScene(name, bodies, contacts, weight, np.zeros((len(bodies), 3)))


def with_ground(mass: ArrayLike, inertia: Array, position: Array) -> Bodies:
    """Bodies at rest and, last, a fixed one."""
    n = len(position) + 1
    return Bodies(
        np.append(mass, np.inf), np.concatenate([inertia, np.eye(3)[None]]),
        np.concatenate([position, [[0, 0, -1.0]]]), rotations.identity(n), np.zeros((n, 3)), np.zeros((n, 3)),
    )  # fmt: skip


def contacts_at(a: ArrayLike, b: ArrayLike, point: Array, normal: Array) -> Contacts:
    """Touching contacts on faces of B."""
    return Contacts(
        np.asarray(a, dtype=int),
        np.asarray(b, dtype=int),
        point,
        normal,
        np.zeros(len(point)),
    )


def _box_inertia(mass: Array, size: Array) -> Array:
    """m/12 (y^2 + z^2, x^2 + z^2, x^2 + y^2) on the diagonal, (n, 3, 3)."""
    square = size**2
    return (mass[:, None] / 12 * (square.sum(axis=1, keepdims=True) - square))[
        :, :, None
    ] * np.eye(3)


def _supports(low: Array, size: Array) -> tuple[IntArray, IntArray]:
    """(upper, lower) of all bricks of which one lies on the other with some area."""
    from scipy.spatial import cKDTree

    # Bricks within 3.9 once rows are 3 apart: all that may lie on each other.
    pairs = cKDTree(low * (1, 1, 3)).query_pairs(3.9, output_type="ndarray")
    first, second = pairs.T if len(pairs) else np.zeros((2, 0), dtype=int)
    upper, lower = np.where(
        low[first, 2] > low[second, 2], (first, second), (second, first)
    )
    apart = np.abs(low[upper] - low[lower])
    on = (apart[:, 2] == size[2]) & np.all(apart[:, :2] < size[:2] - 1e-9, axis=1)
    upper, lower = upper[on], lower[on]
    order = np.lexsort((lower, upper))
    return upper[order], lower[order]
