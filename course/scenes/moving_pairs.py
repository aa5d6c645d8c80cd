"""Pairs of bodies that move past each other, their gap known at every moment from the shapes alone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from course import rotations
from course.arrays import Array, choice, scalar, whole_number
from course.dynamics import Bodies, reference_motion
from course.overlap import FEATURES, FeaturePair
from course.scenes.scene import Scene

#: Radii of the balls [m].
RADII = (0.7, 0.6)
#: Half lengths of bar and plank, and half the thickness of both [m].
BAR, PLANK, HALF_THICKNESS = 0.8, 1.4, 0.05


def moving_contact(kind: str, *, seed: int = 13, gap: float = 0.0) -> Scene:
    """A drawn pair under constant forces that flies and turns, d = gap at time 0; d_dot is whatever was drawn.

    Its motion is integrated to 1e-13.

    Args:
        kind: one of ``FEATURES``: a corner and a face, a face and a corner, two edges, two balls.
        seed: draws bodies, motion, forces and shapes.
        gap: d at time 0 [m].
    """
    choice("kind", kind, FEATURES)
    rng = np.random.default_rng([seed, FEATURES.index(kind)])
    # A body has I = tr(S) 1 - S with positive second moments S = integral of r r' dm. A
    # positive matrix drawn as I itself may have a principal moment above the sum of the
    # other two, and no body has that.
    root = rng.normal(size=(2, 3, 3))
    second = 0.5 * (root @ np.swapaxes(root, 1, 2) + np.eye(3))
    inertia = np.trace(second, axis1=1, axis2=2)[:, None, None] * np.eye(3) - second
    spots, axes = rng.normal(size=(2, 3)), _unit(rng.normal(size=(2, 3)))
    # Balls lie about their centres of mass.
    spots = np.zeros((2, 3)) if kind == "curved" else spots
    drawn = Bodies(rng.uniform(0.5, 3, 2), inertia, rng.normal(size=(2, 3)), _unit(rng.normal(size=(2, 4))),
                   *0.6 * rng.normal(size=(2, 2, 3)))  # fmt: skip
    force, torque = rng.normal(size=(2, 2, 3))
    pair = FeaturePair(kind, spots[0], spots[1], axes[0], axes[1], *RADII)
    contacts = pair.contacts(drawn.position, drawn.rotation)
    shift = (scalar("gap", gap) - contacts.separation[0]) * contacts.normal[0]
    bodies = replace(drawn, position=drawn.position + np.outer([1, 0], shift))

    def motion(time: float) -> Bodies:
        if time == 0:
            return bodies
        return reference_motion(bodies, lambda *_: (force, torque), [time])[0]

    options = {"applied_force": force, "torque": torque}
    return _known(f"pair of {kind}", bodies, pair, motion, **options)


def bar_over_plank(
    rate_a: float = 1.5, rate_b: float = 0.5, *, reach: float = 1.8, clear: float = 0.25
) -> Scene:
    """A bar over a plank, seen from the side, each turning on an axle through its centre: no centre ever moves.

    The plane is that of y (to the right) and z (up); x points to the reader,
    so that a turn against the clock is a positive rate. Both lie level at
    time 0, the left end of the bar (A) above the plank (B), which is centred
    at the origin. What meets is A's lower left corner and B's upper face. Each has 1 kg
    and the moment 1 kg m^2.

    Args:
        rate_a, rate_b: omega_x of bar and plank [rad/s].
        reach: y of A's centre [m].
        clear: the gap at time 0 [m].
    """
    centres = np.array([[0, reach, clear + 2 * HALF_THICKNESS], [0, 0, 0]])
    rates = np.outer([rate_a, rate_b], [1.0, 0, 0])

    def motion(time: float) -> Bodies:
        turns = rotations.from_rotation_vector(time * rates)
        one, still = np.stack([np.eye(3)] * 2), np.zeros((2, 3))
        return Bodies(np.ones(2), one, centres, turns, still, rates)

    up = np.array([0.0, 0, 1])
    corner = np.array([0, -BAR, -HALF_THICKNESS])
    pair = FeaturePair("face_b", corner, HALF_THICKNESS * up, up, up)
    return _known("bar over plank", motion(0.0), pair, motion)


def bar_and_plank_outlines(bodies: Bodies) -> Array:
    """The corners of the bar and the plank of ``bar_over_plank`` in the plane, (2, 4, 2) [m]."""
    half = np.array([[BAR, HALF_THICKNESS], [PLANK, HALF_THICKNESS]])
    corners = half[:, None] * [[-1, -1], [1, -1], [1, 1], [-1, 1]]
    turned = np.einsum("bij,bcj->bci", bodies.rotation[:, 1:, 1:], corners)
    return np.asarray(bodies.position[:, None, 1:] + turned)


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


def _known(
    name: str,
    bodies: Bodies,
    pair: FeaturePair,
    motion: Callable[[float], Bodies],
    **more: Any,
) -> Scene:
    """A scene with a known motion; its error is how far the gap is from where it should be [m]."""
    touching = pair.contacts(bodies.position, bodies.rotation)

    def gap(state: Bodies) -> float:
        return float(pair.contacts(state.position, state.rotation).separation[0])

    def error(state: Bodies, time: float) -> float:
        return abs(gap(state) - gap(motion(time)))

    return Scene(bodies, pair, touching, truth=motion, error=error, name=name, **more)


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
