"""Impacts of bodies that turn: a rod on a spring, many landings of a box, and the order of its contacts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from course.arrays import Array, failure, positive, scalar, whole_number
from course.contact import contact_system, resolve_collisions
from course.dynamics import Bodies, point_velocity
from course.overlap import Contacts
from course.scenes import box_on_corners


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
    given = {"stiffness": stiffness, "mass": mass, "length": length, "speed": speed}
    k, m, size, v = (scalar(n, positive(n, x)) for n, x in given.items())
    half, inertia = 0.5 * size, m * size**2 / 12

    def rate(_: float, state: Array) -> list[float]:
        z, turned, z_rate, turning, _ = state
        force = k * max(half * np.sin(turned) - z, 0.0)
        torque = -force * half * np.cos(turned)
        return [z_rate, turning, force / m, torque / inertia, force]

    def leaves(_: float, state: Array) -> float:
        return float(state[0] - half * np.sin(state[1]))

    leaves.terminal, leaves.direction = True, 1.0  # type: ignore[attr-defined]
    span = 0, 4 * np.pi * np.sqrt(m / k)
    start = [half * np.sin(theta), theta, -v, 0.0, 0.0]
    options = {"method": "DOP853", "rtol": 1e-10, "atol": 1e-13, "events": leaves}
    motion = solve_ivp(rate, span, start, **options)
    if not motion.t_events[0].size:
        raise failure("stiffness", "a spring that throws the rod back", f"{k:g}")
    return float(motion.y_events[0][0, 4])


def normal_response(bodies: Bodies, contacts: Contacts) -> Array:
    """A = J M^-1 J', (c, c) [1/kg]: a_ij is the change of u_i for an impulse of 1 N s at contact j (row 21)."""
    none = np.zeros((len(bodies), 3))
    system = contact_system(bodies, contacts, none, none, rate_tolerance=np.inf)
    return np.asarray(system.A.toarray())


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
    scene = box_on_corners()
    bodies, contacts = scene.bodies, scene.contacts
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

    @cached_property
    def _counted(self) -> tuple[Array, np.ndarray]:
        return np.unique(np.round(self.spin, 6), axis=0, return_counts=True)

    @property
    def different(self) -> Array:
        """The spins that differ by more than 1e-6 rad/s, (d, 3) [rad/s]."""
        return self._counted[0]

    @property
    def times(self) -> np.ndarray:
        """How many orders end with each of the ``different`` spins, (d,)."""
        return self._counted[1]


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


@dataclass(frozen=True, eq=False)
class BoxOutcomes:
    """How fast the corners of a box rise before an impact and after it by several laws.

    Args:
        corners: (4, 3) [m], in the order (-,-), (-,+), (+,-), (+,+).
        height: of the box [m].
        speed: "before" and the names of the laws -> (4,) [m/s].
        spin: the same names -> omega, (3,) [rad/s].
    """

    corners: Array
    height: float
    speed: dict[str, Array]
    spin: dict[str, Array]


def box_outcomes(
    box: Bodies, corners: Array, outcomes: Mapping[str, Bodies]
) -> BoxOutcomes:
    """The corner speeds of a box that stands on the floor with its axes along x, y, z.

    Args:
        box: before; body 0 is the box.
        corners: where it touches the floor, (4, 3) [m].
        outcomes: name -> bodies after.
    """
    arms = corners - box.position[0]
    states = {"before": box} | dict(outcomes)
    moves = {
        name: point_velocity(s.velocity[0], s.angular_velocity[0], arms)[:, 2]
        for name, s in states.items()
    }
    return BoxOutcomes(
        corners,
        2 * float(box.position[0, 2]),
        moves,
        {name: s.angular_velocity[0] for name, s in states.items()},
    )
