"""Pairs of bodies that move past each other, and how well differences of their gap give its rates.

``MovingContact`` is a pair whose gap is found from the shapes alone at every
moment, so that formulas for d_dot and d_ddot can be held against what
happens. Its motion is integrated to 1e-13. ``TurningPair`` is the plane scene
of lesson 13, whose motion has a closed form.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from course import rotations
from course.arrays import (
    Array,
    ArrayLike,
    choice,
    failure,
    positive,
    scalar,
    scalars,
    whole_number,
    written,
)
from course.dynamics import Bodies, reference_motion
from course.overlap import Contacts

#: What may meet: a corner and a face, a face and a corner, two edges, two balls.
KINDS = ("face_b", "face_a", "edges", "curved")
#: Radii of the balls [m].
RADII = (0.7, 0.6)


@dataclass(frozen=True, eq=False)
class MovingContact:
    """Two bodies under a constant force and torque each, and the parts of them that meet.

    Args:
        kind: one of ``KINDS``: a corner of A and a face of B ("face_b"), a
            face of A and a corner of B ("face_a"), two edges, two balls ("curved").
        bodies: A and B at time 0.
        spot_a, spot_b: in each body's own axes, a point of what it meets with:
            the corner, a point of the face or edge, a ball's centre, (3,) [m].
        axis_a, axis_b: in each body's own axes, the face's outward normal or the edge's direction, unit, (3,).
        force, torque: on A and B, world axes, (2, 3) [N, N m].
    """

    kind: str
    bodies: Bodies
    spot_a: Array
    spot_b: Array
    axis_a: Array
    axis_b: Array
    force: Array
    torque: Array

    def at(self, time: float) -> Bodies:
        """The bodies at this time [s], before or after 0."""
        if time == 0:
            return self.bodies
        return reference_motion(
            self.bodies, lambda *_: (self.force, self.torque), [time]
        )[0]

    def contacts(self, bodies: Bodies) -> Contacts:
        """The one contact of A and B as they lie now: points, N and d from the shapes alone."""
        spot_a, spot_b, axis_a, axis_b = self._in_the_world(bodies)
        if self.kind == "face_b":
            d, normal, point_a = (spot_a - spot_b) @ axis_b, axis_b, spot_a
        elif self.kind == "face_a":
            d, normal = (spot_b - spot_a) @ axis_a, -axis_a
            point_a = spot_b + d * normal
        elif self.kind == "edges":
            point_a, point_b = _nearest_on_lines(spot_a, axis_a, spot_b, axis_b)
            normal = _unit(np.cross(axis_a, axis_b))
            d = np.asarray((point_a - point_b) @ normal)
        else:
            between = spot_a - spot_b
            distance = np.linalg.norm(between)
            normal, d = between / distance, np.asarray(distance - sum(RADII))
            point_a = spot_a - RADII[0] * normal
        data: dict[str, Any] = {}
        if self.kind == "edges":
            data = {"edge_a": axis_a[None], "edge_b": axis_b[None]}
        if self.kind == "curved":
            data = {
                "curvature_a": np.eye(3)[None] / RADII[0],
                "curvature_b": np.eye(3)[None] / RADII[1],
            }
        halfway = point_a - 0.5 * d * normal
        return Contacts(np.array([0]), np.array([1]), halfway[None], normal[None], np.array([float(d)]),
                        np.array([self.kind]), **data)  # fmt: skip

    def gap(self, time: float) -> float:
        """d at this time [m]."""
        return float(self.contacts(self.at(time)).separation[0])

    def _in_the_world(self, bodies: Bodies) -> tuple[Array, Array, Array, Array]:
        (x_a, x_b), (turn_a, turn_b) = bodies.position, bodies.rotation
        return (
            x_a + turn_a @ self.spot_a,
            x_b + turn_b @ self.spot_b,
            turn_a @ self.axis_a,
            turn_b @ self.axis_b,
        )


def moving_contact(kind: str, *, seed: int = 13, gap: float = 0.0) -> MovingContact:
    """A drawn pair that flies and turns, d = gap at time 0; d_dot is whatever was drawn.

    Args:
        kind: one of ``KINDS``.
        seed: draws bodies, motion, forces and shapes.
        gap: d at time 0 [m].
    """
    choice("kind", kind, KINDS)
    rng = np.random.default_rng([seed, KINDS.index(kind)])
    # A body has I = tr(S) 1 - S with positive second moments S = integral of r r' dm. A positive matrix drawn as I
    # itself may have a principal moment above the sum of the other two, and no body has that.
    root = rng.normal(size=(2, 3, 3))
    second = 0.5 * (root @ np.swapaxes(root, 1, 2) + np.eye(3))
    inertia = np.trace(second, axis1=1, axis2=2)[:, None, None] * np.eye(3) - second
    spots, (axis_a, axis_b) = rng.normal(size=(2, 3)), _unit(rng.normal(size=(2, 3)))
    spots = (
        np.zeros((2, 3)) if kind == "curved" else spots
    )  # balls about their centres of mass
    bodies = Bodies(rng.uniform(0.5, 3, 2), inertia, rng.normal(size=(2, 3)), _unit(rng.normal(size=(2, 4))),
                    *0.6 * rng.normal(size=(2, 2, 3)))  # fmt: skip
    force, torque = rng.normal(size=(2, 2, 3))
    scene = MovingContact(
        kind, bodies, spots[0], spots[1], axis_a, axis_b, force, torque
    )
    contacts = scene.contacts(bodies)
    shift = (scalar("gap", gap) - contacts.separation[0]) * contacts.normal[0]
    position = bodies.position + np.stack([shift, np.zeros(3)])
    return replace(scene, bodies=replace(bodies, position=position))


@dataclass(frozen=True)
class TurningPair:
    """A bar over a plank, seen from the side, each turning on an axle through its centre: no centre ever moves.

    The plane is that of y (to the right) and z (up); x points to the reader,
    so that a turn against the clock is a positive rate. Both lie level at
    time 0, the left end of the bar (A) above the plank (B), which is centred
    at the origin. What meets is A's lower left corner and B's upper face.

    Args:
        rate_a, rate_b: omega_x of bar and plank [rad/s].
        reach: y of A's centre [m].
        half_a, half_b: half lengths [m].
        thickness: of both [m].
        clear: the gap at time 0 [m].
    """

    rate_a: float = 1.5
    rate_b: float = 0.5
    reach: float = 1.8
    half_a: float = 0.8
    half_b: float = 1.4
    thickness: float = 0.1
    clear: float = 0.25

    def bodies(self, time: float = 0.0) -> Bodies:
        """Bar and plank at this time [s], 1 kg each, moment 1 kg m^2."""
        turns = rotations.from_rotation_vector(
            [[self.rate_a * time, 0, 0], [self.rate_b * time, 0, 0]]
        )
        spin = [[self.rate_a, 0, 0], [self.rate_b, 0, 0]]
        return Bodies(
            np.ones(2),
            np.stack([np.eye(3)] * 2),
            self._centres,
            turns,
            np.zeros((2, 3)),
            np.array(spin),
        )

    def contacts(self, time: float = 0.0) -> Contacts:
        """The one contact: p_A is the corner, p_B the point of the face straight below it along N."""
        (turn_a, turn_b), (x_a, x_b) = self.bodies(time).rotation, self._centres
        corner = x_a + turn_a @ np.array([0, -self.half_a, -0.5 * self.thickness])
        normal = turn_b[:, 2]
        d = (corner - x_b) @ normal - 0.5 * self.thickness
        return Contacts(
            np.array([0]),
            np.array([1]),
            (corner - 0.5 * d * normal)[None],
            normal[None],
            np.array([d]),
        )

    def gap(self, time: float) -> float:
        """d at this time [m]."""
        return float(self.contacts(time).separation[0])

    def outlines(self, time: float) -> Array:
        """The corners of bar and plank in the plane, (2, 4, 2) [m]."""
        half = np.array(
            [[self.half_a, 0.5 * self.thickness], [self.half_b, 0.5 * self.thickness]]
        )
        corners = half[:, None] * [[-1, -1], [1, -1], [1, 1], [-1, 1]]
        turn = self.bodies(time).rotation[:, 1:, 1:]
        return self._centres[:, None, 1:] + np.einsum("bij,bcj->bci", turn, corners)

    @property
    def _centres(self) -> Array:
        return np.array([[0, self.reach, self.clear + self.thickness], [0, 0, 0]])


@dataclass(frozen=True, eq=False)
class FlyingCorners:
    """c corners of bodies A over faces of bodies B, all flying and turning evenly: a batch in closed form.

    Args:
        position, velocity, omega: of A and B, (2, c, 3) [m], [m/s], [rad/s].
        arm: to the corner of A and to a point marked on the face of B, at time 0, (2, c, 3) [m].
        normal: of the face of B at time 0, (c, 3).
    """

    position: Array
    velocity: Array
    omega: Array
    arm: Array
    normal: Array

    def points(self, time: float | complex) -> tuple[Any, Any, Any]:
        """p_A, p_B and N at this time, (c, 3) each."""
        centre = self.position + time * self.velocity
        p_a, p_b = centre + _turned(self.arm, self.omega, time)
        return p_a, p_b, _turned(self.normal, self.omega[1], time)

    def rates(self) -> Array:
        """d_dot at time 0 to rounding, from the gap alone, (c,) [m/s].

        The complex step: Im d(i h)/h for a tiny h, in which nothing is
        subtracted (W. Squire, G. Trapp, "Using complex variables to estimate
        derivatives of real functions", SIAM Review 40, 1998).
        """
        tiny = 1e-100
        p_a, p_b, n = self.points(1j * tiny)
        return np.asarray(np.sum((p_a - p_b) * n, axis=-1).imag / tiny)


def flying_corners(count: int, *, seed: int = 13) -> FlyingCorners:
    """Corners and faces drawn by seed; the gaps are whatever comes."""
    rng = np.random.default_rng(seed)
    position, velocity, omega, arm = rng.normal(
        size=(4, 2, whole_number("count", count, minimum=1), 3)
    )
    return FlyingCorners(
        position, velocity, omega, arm, _unit(rng.normal(size=(count, 3)))
    )


@dataclass(frozen=True)
class Stencil:
    """A difference quotient: sum_k weight_k f(t + offset_k h) / h^derivative, with an error of order h^order.

    (B. Fornberg, "Generation of finite difference formulas on arbitrarily
    spaced grids", Mathematics of Computation 51, 1988.)
    """

    name: str
    offsets: tuple[float, ...]
    weights: tuple[float, ...]
    derivative: int
    order: int

    def difference(
        self, value: Callable[[float], float], time: float, step: float
    ) -> float:
        """The quotient for f = value at this time with step h."""
        h = scalar("step", positive("step", step))
        terms = [
            w * value(time + o * h)
            for o, w in zip(self.offsets, self.weights, strict=True)
        ]
        return float(sum(terms)) / h**self.derivative


FORWARD = Stencil("one-sided", (0, 1), (-1, 1), 1, 1)
CENTRAL = Stencil("central", (-1, 1), (-1 / 2, 1 / 2), 1, 2)
FIVE_POINTS = Stencil(
    "five points", (-2, -1, 1, 2), (1 / 12, -8 / 12, 8 / 12, -1 / 12), 1, 4
)
SECOND = Stencil("three points of d", (-1, 0, 1), (1, -2, 1), 2, 2)
SECOND_FIVE = Stencil(
    "five points of d",
    (-2, -1, 0, 1, 2),
    (-1 / 12, 16 / 12, -30 / 12, 16 / 12, -1 / 12),
    2,
    4,
)


@dataclass(frozen=True, eq=False)
class DifferenceErrors:
    """How far difference quotients are from a known rate, over the step.

    Args:
        step: h, (k,) [s].
        error: by the name of each stencil, (k,).
        unit: of the errors.
    """

    step: Array
    error: dict[str, Array]
    unit: str

    def best(self, name: str) -> tuple[float, float]:
        """The step with the least error of a stencil, and that error."""
        if name not in self.error:
            raise failure(
                "name", "one of " + ", ".join(map(repr, self.error)), written(name)
            )
        least = int(np.argmin(self.error[name]))
        return float(self.step[least]), float(self.error[name][least])


def difference_errors(
    tries: Sequence[tuple[Stencil, Callable[[float], float]]],
    exact: float,
    steps: ArrayLike,
    *,
    time: float = 0.0,
    unit: str = "m/s",
) -> DifferenceErrors:
    """The error of each difference quotient at each step: truncation falls with h, rounding grows as 1/h^derivative.

    Args:
        tries: stencils, each with the function of time that it is used on.
        exact: the rate in closed form.
        steps: h, (k,) [s].
        time: where the rate is wanted [s].
        unit: of the rate.
    """
    h = positive("steps", scalars("steps", steps))
    errors = {
        s.name: np.array([abs(s.difference(f, time, x) - exact) for x in h.tolist()])
        for s, f in tries
    }
    return DifferenceErrors(h, errors, unit)


def _nearest_on_lines(p: Array, d: Array, q: Array, e: Array) -> tuple[Array, Array]:
    """The points nearest to each other of the lines p + s d and q + t e."""
    s, t = np.linalg.lstsq(np.stack([d, -e], axis=1), q - p, rcond=None)[0]
    return p + s * d, q + t * e


def _turned(arrow: Array, omega: Array, time: float | complex) -> Any:
    """Arrows turned by omega t (Rodrigues' formula); analytic in the time."""
    speed = np.linalg.norm(omega, axis=-1, keepdims=True)
    axis, angle = omega / speed, speed * time
    along = axis * np.sum(axis * arrow, axis=-1, keepdims=True)
    return (
        along + (arrow - along) * np.cos(angle) + np.cross(axis, arrow) * np.sin(angle)
    )


def _unit(vector: Array) -> Array:
    return np.asarray(vector / np.linalg.norm(vector, axis=-1, keepdims=True))
