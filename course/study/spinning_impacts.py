"""Impacts of bodies that turn: a rod on the floor or on pegs, a box on its four corners."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from course import rotations
from course.arrays import (
    Array,
    ArrayLike,
    IntArray,
    failure,
    in_range,
    positive,
    scalar,
    scalars,
    vectors,
    whole_number,
)
from course.contact import contact_jacobian, inverse_mass_matrix, resolve_collisions
from course.dynamics.bodies import Bodies
from course.overlap.contact_arrays import Contacts

UP = (0.0, 0.0, 1.0)
#: A box whose three moments of inertia differ: half extents [m].
BOX = (0.5, 0.3, 0.2)


def falling_rods(
    angle: ArrayLike,
    *,
    place: ArrayLike = 1.0,
    mass: float = 1.0,
    length: float = 1.0,
    speed: float = 1.0,
) -> tuple[Bodies, Contacts]:
    """Thin rods that fall without turning and touch a fixed floor at one point, and that contact of each.

    Rod i lies in the x-z plane, its lower end toward +x, and is hit at r = place (length/2) along it from the
    centre, n = z. Across its axis I = m length^2/12; about the axis, where no contact can turn it, a hundredth of
    that. The floor is the last body.

    Args:
        angle: theta, from the horizontal, (n,) or one number [rad].
        place: 1 the lower end, 0 the middle, -1 the upper end, (n,) or one number.
        mass, length, speed: of every rod [kg], [m], [m/s].
    """
    theta, where = (
        np.atleast_1d(scalars("angle", angle)),
        in_range("place", place, -1, 1),
    )
    theta, where = np.broadcast_arrays(theta, where)
    m, size = (
        float(positive(name, scalar(name, x)))
        for name, x in (("mass", mass), ("length", length))
    )
    n = theta.size
    axis = np.stack([np.cos(theta), np.zeros(n), -np.sin(theta)], axis=-1)
    across = m * size**2 / 12
    inertia = np.broadcast_to(np.diag([0.01 * across, across, across]), (n + 1, 3, 3))
    orientation = np.concatenate(
        [
            rotations.from_rotation_vector(theta[:, None] * [0.0, 1.0, 0.0]),
            [[0, 0, 0, 1]],
        ]
    )
    momentum = np.zeros((n + 1, 3))
    momentum[:n, 2] = -m * float(positive("speed", scalar("speed", speed)))
    zero = np.zeros((n + 1, 3))
    bodies = Bodies(
        np.append(np.full(n, m), np.inf), inertia, zero, orientation, momentum, zero
    )
    point = 0.5 * size * where[:, None] * axis
    return bodies, _on_the_floor(np.arange(n), n, point)


def rod_on_spring(
    angle: float,
    stiffness: float,
    *,
    mass: float = 1.0,
    length: float = 1.0,
    speed: float = 1.0,
) -> float:
    """Impulse that a spring under the lower end of a falling rod gives it before the end leaves it again [N s].

    The rod moves and turns while it is pushed, m z'' = F, I theta'' = -F (length/2) cos theta, F = k times how deep
    the end is in the floor: nothing is assumed of an instant, of restitution or of an effective mass. Towards large
    k it becomes the impulse at e = 1.

    Args:
        angle: theta at the first touch, from the horizontal [rad].
        stiffness: k [N/m].
        mass, length, speed: [kg], [m], [m/s].
    """
    from scipy.integrate import solve_ivp

    theta = scalar("angle", angle)
    k, m, size, v = (
        float(positive(name, scalar(name, x)))
        for name, x in (
            ("stiffness", stiffness),
            ("mass", mass),
            ("length", length),
            ("speed", speed),
        )
    )
    half, inertia = 0.5 * size, m * size**2 / 12

    def rate(_: float, state: Array) -> list[float]:
        z, turned, z_rate, turning, _ = state
        force = k * max(half * np.sin(turned) - z, 0.0)
        return [
            z_rate,
            turning,
            force / m,
            -force * half * np.cos(turned) / inertia,
            force,
        ]

    def leaves(_: float, state: Array) -> float:
        return float(state[0] - half * np.sin(state[1]))

    leaves.terminal, leaves.direction = True, 1.0  # type: ignore[attr-defined]
    longest = 4 * np.pi * np.sqrt(m / k)
    start = [half * np.sin(theta), theta, -v, 0.0, 0.0]
    motion = solve_ivp(
        rate,
        (0, longest),
        start,
        method="DOP853",
        rtol=1e-10,
        atol=1e-13,
        events=leaves,
    )
    if not motion.t_events[0].size:
        raise failure("stiffness", "a spring that throws the rod back", f"{k:g}")
    return float(motion.y_events[0][0, 4])


def box_on_corners(
    *,
    velocity: ArrayLike = (0.0, 0.0, -1.0),
    spin: ArrayLike = (0.0, 0.0, 0.0),
    half_extents: ArrayLike = BOX,
) -> tuple[Bodies, Contacts]:
    """A box of 1 kg that stands on a fixed floor with its four lower corners at the moment of impact.

    Args:
        velocity: of its centre, (3,) [m/s].
        spin: omega, (3,) [rad/s].
        half_extents: (3,) [m]. The floor is body 1, the corners run (-,-), (-,+), (+,-), (+,+) in x and y.
    """
    half = positive("half_extents", vectors("half_extents", half_extents))
    inertia = np.diag(half @ half - half**2) / 3
    momentum, angular = np.zeros((2, 2, 3))
    momentum[0], angular[0] = (
        vectors("velocity", velocity),
        inertia @ vectors("spin", spin),
    )
    position = np.array([[0.0, 0.0, half[2]], [0.0, 0.0, 0.0]])
    both = np.stack([inertia, np.eye(3)])
    bodies = Bodies(
        np.array([1.0, np.inf]),
        both,
        position,
        rotations.identity(2),
        momentum,
        angular,
    )
    corner = np.array(
        [[x * half[0], y * half[1], 0.0] for x in (-1, 1) for y in (-1, 1)]
    )
    return bodies, _on_the_floor(np.zeros(4, int), 1, corner)


def normal_response(bodies: Bodies, contacts: Contacts) -> Array:
    """A = J M^-1 J', (c, c) [1/kg]: a_ij is the change of u_i for an impulse of 1 N s at contact j (row 21)."""
    jacobian = contact_jacobian(bodies, contacts)
    matrix = (jacobian @ (inverse_mass_matrix(bodies) @ jacobian.T)).toarray()
    return np.asarray(0.5 * (matrix + matrix.T))


@dataclass(frozen=True, eq=False)
class BoxLandings:
    """Many landings of one box on its four corners, each with another spin.

    Args:
        matrix: A, the same for all, (4, 4) [1/kg].
        normal_velocity: u before, all below 0, (n, 4) [m/s].
    """

    matrix: Array
    normal_velocity: Array


def box_landings(
    count: int = 20, *, seed: int = 12, spread: float = 0.8
) -> BoxLandings:
    """A box that comes down at 1 m/s on four corners at once, with drawn spins about the two level axes.

    Drawn again where a corner would come in slower than 0.05 m/s, so that all four take part.

    Args:
        count: how many.
        seed: of the generator.
        spread: standard deviation of each spin [rad/s].
    """
    wanted, rng = whole_number("count", count, minimum=1), np.random.default_rng(seed)
    bodies, contacts = box_on_corners()
    arm = contacts.point - bodies.position[0]
    found: list[Array] = []
    while len(found) < wanted:
        spin = float(positive("spread", scalar("spread", spread))) * rng.normal(size=2)
        u = -1.0 + spin[0] * arm[:, 1] - spin[1] * arm[:, 0]
        if np.all(u < -0.05):
            found.append(u)
    return BoxLandings(normal_response(bodies, contacts), np.array(found))


@dataclass(frozen=True, eq=False)
class OrderOutcomes:
    """What became of one body under several orders of the same list of contacts.

    Args:
        order: (k, c) ints.
        velocity: (k, 3) [m/s].
        spin: omega, (k, 3) [rad/s].
    """

    order: np.ndarray
    velocity: Array
    spin: Array


def outcomes_by_order(
    bodies: Bodies,
    contacts: Contacts,
    restitution: float,
    orders: Sequence[Sequence[int]],
    *,
    law: str = "sequential",
) -> OrderOutcomes:
    """Body 0 after the same impact, with the contacts listed in each of these orders."""
    rows = np.array([list(order) for order in orders])
    count = len(contacts)
    if rows.shape != (len(rows), count) or not np.all(
        np.sort(rows, axis=1) == np.arange(count)
    ):
        raise failure(
            "orders", f"orders of the contacts 0 to {count - 1}", str(orders)[:60]
        )
    after = [
        resolve_collisions(bodies, contacts[order], restitution, law=law)
        for order in rows
    ]
    return OrderOutcomes(
        rows,
        np.array([a.velocity[0] for a in after]),
        np.array([a.angular_velocity[0] for a in after]),
    )


def rod_on_two_pegs(place: float) -> tuple[Bodies, Contacts]:
    """A level rod of 1 kg and 1 m that falls at 1 m/s on two fixed pegs, each place/2 from its middle.

    Its pegs feel each other by a_12 = 1/m - (place/2)^2/I, which is 0 where the pegs stand at the radius of
    gyration, place = 1/sqrt 3: there neither peg notices the other. The left peg comes first in the list.

    Args:
        place: from 0, both under the middle, to 1, under the ends.
    """
    where = float(in_range("place", scalar("place", place), 0, 1))
    bodies, _ = falling_rods(0.0)
    return bodies, _on_the_floor(
        np.zeros(2, int), 1, 0.5 * where * np.array([[-1.0, 0, 0], [1.0, 0, 0]])
    )


def _on_the_floor(body: IntArray, floor: int, point: Array) -> Contacts:
    """Contacts of bodies on a fixed one below them, n = z."""
    count = len(point)
    return Contacts(
        body, np.full(count, floor), point, np.tile(UP, (count, 1)), np.zeros(count)
    )
