"""Bodies that turn at the moment they land: a rod on the floor or on pegs, a box on its four corners."""

from __future__ import annotations

import numpy as np

from course import rotations
from course.arrays import (
    Array,
    ArrayLike,
    in_range,
    positive,
    scalar,
    scalars,
    vectors,
)
from course.dynamics import Bodies
from course.overlap import Contacts
from course.scenes.layout import box_inertia, contacts_at, fixed_body
from course.scenes.scene import Scene

#: A box whose three moments of inertia differ: half extents [m].
BOX = (0.5, 0.3, 0.2)


def falling_rods(
    angle: ArrayLike,
    *,
    place: ArrayLike = 1.0,
    mass: float = 1.0,
    length: float = 1.0,
    speed: float = 1.0,
) -> Scene:
    """Thin rods that fall without turning and touch a fixed floor at one point, and that contact of each.

    Rod i lies in the x-z plane, its lower end toward +x, and is hit at r = place (length/2) along it from the
    centre, n = z. Across its axis I = m length^2/12; about the axis, where no contact can turn it, a hundredth of
    that. The floor is the last body. The impulses are (1 + e) m v/(1 + 3 place^2 cos^2 theta).

    Args:
        angle: theta, from the horizontal, (n,) or one number [rad].
        place: 1 the lower end, 0 the middle, -1 the upper end, (n,) or one number.
        mass, length, speed: of every rod [kg], [m], [m/s].
    """
    theta = np.atleast_1d(scalars("angle", angle))
    theta, where = np.broadcast_arrays(theta, in_range("place", place, -1, 1))
    m, size, v = (
        scalar(name, positive(name, value))
        for name, value in (("mass", mass), ("length", length), ("speed", speed))
    )
    n = theta.size
    axis = np.stack([np.cos(theta), np.zeros(n), -np.sin(theta)], axis=-1)
    across = m * size**2 / 12
    inertia = np.broadcast_to(np.diag([0.01 * across, across, across]), (n, 3, 3))
    turns = rotations.from_rotation_vector(theta[:, None] * [0.0, 1.0, 0.0])
    zero, momentum = np.zeros((n, 3)), np.outer(np.full(n, m * v), [0.0, 0.0, -1.0])
    rods = Bodies(np.full(n, m), inertia, zero, turns, momentum, zero)
    bodies = Bodies.concatenate([rods, fixed_body()])
    contacts = contacts_at(0.5 * size * where[:, None] * axis, a=np.arange(n), b=n)
    felt = m / (1 + 3 * (where * np.cos(theta)) ** 2)
    return _landing("falling rods", bodies, contacts, felt * v)


def rod_on_two_pegs(place: float) -> Scene:
    """A level rod of 1 kg and 1 m that falls at 1 m/s on two fixed pegs, each place/2 from its middle.

    Its pegs feel each other by a_12 = 1/m - (place/2)^2/I, which is 0 where the pegs stand at the radius of
    gyration, place = 1/sqrt 3: there neither peg notices the other. The left peg comes first in the list. By
    symmetry each gives half of (1 + e) m v.

    Args:
        place: from 0, both under the middle, to 1, under the ends.
    """
    where = float(in_range("place", scalar("place", place), 0, 1))
    pegs = contacts_at(0.5 * where * np.array([[-1.0, 0, 0], [1.0, 0, 0]]))
    return _landing("rod on two pegs", falling_rods(0.0).bodies, pegs, np.full(2, 0.5))


def box_on_corners(
    *,
    velocity: ArrayLike = (0.0, 0.0, -1.0),
    spin: ArrayLike = (0.0, 0.0, 0.0),
    half_extents: ArrayLike = BOX,
) -> Scene:
    """A box of 1 kg that stands on a fixed floor with its four lower corners at the moment of impact.

    Args:
        velocity: of its centre, (3,) [m/s].
        spin: omega, (3,) [rad/s].
        half_extents: (3,) [m]. The floor is body 1, the corners run (-,-), (-,+), (+,-), (+,+) in x and y.
    """
    half = positive("half_extents", vectors("half_extents", half_extents))
    inertia = box_inertia([1.0], 2 * half)
    box = Bodies(
        np.ones(1),
        inertia,
        np.array([[0.0, 0.0, half[2]]]),
        rotations.identity(1),
        vectors("velocity", velocity)[None],
        (inertia[0] @ vectors("spin", spin))[None],
    )
    bodies = Bodies.concatenate([box, fixed_body()])
    sides = np.array([[x, y, 0.0] for x in (-1, 1) for y in (-1, 1)])
    return Scene(bodies, None, contacts_at(sides * half), name="box on its corners")


def _landing(name: str, bodies: Bodies, contacts: Contacts, stopping: Array) -> Scene:
    """A scene whose impulses are (1 + e) times those that stop the approach, (c,) [N s]."""

    def truth(restitution: float) -> Array:
        return np.asarray((1 + restitution) * stopping)

    def error(impulse: ArrayLike, restitution: float) -> float:
        return float(np.abs(np.asarray(impulse) - truth(restitution)).max())

    return Scene(bodies, None, contacts, truth=truth, error=error, name=name)
