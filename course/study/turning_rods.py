"""A rod that turns about its end toward a ball: where it is, how far away, and how many steps it takes to meet."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array
from course.overlap import time_of_impact
from course.shapes import Capsule, Sphere
from course.study.asking import asked


@dataclass(frozen=True, eq=False)
class Rod:
    """A rod of 1 m that turns about z, and a ball.

    Args:
        omega: about z [rad/s].
        center: of the ball, (3,) [m].
        radius: of the ball [m].
        horizon: [s].
    """

    omega: float
    center: Array
    radius: float = 0.1
    horizon: float = 4.0

    @property
    def arguments(self) -> tuple[Any, ...]:
        """As ``conservative_advancement`` takes them, without the tolerance."""
        arm, spin = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, self.omega])
        return np.zeros(3), arm, spin, self.center, self.radius, self.horizon

    def tip(self, times: Array) -> Array:
        """Its other end, (t, 3) [m]."""
        angle = self.omega * np.asarray(times)
        return np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=-1)

    def gap(self, times: Array) -> Array:
        """From the rod to the ball, (t,) [m]."""
        rod = self.tip(times)
        along = np.clip(rod @ self.center, 0, 1)
        return np.asarray(
            np.linalg.norm(self.center - along[:, None] * rod, axis=-1) - self.radius
        )


def ball_ahead(omega: float, degrees: float, distance: float) -> Rod:
    """A ball at an angle ahead of the rod and a distance from its pivot [m].

    The rod is followed for 4 s, and no farther than once round.
    """
    angle, round_once = np.radians(degrees), 2 * np.pi / max(abs(omega), 1e-9)
    center = distance * np.array([np.cos(angle), np.sin(angle), 0.0])
    return Rod(omega, center, horizon=min(4.0, round_once))


def rod_time(rod: Rod) -> float:
    """When they meet, by the library; inf if they do not."""
    thin = Capsule(np.zeros(3), np.array([1.0, 0.0, 0.0]), np.array(1e-9))
    ball, still = Sphere(rod.center, np.array(rod.radius - 1e-9)), np.zeros(3)
    spin = np.array([0.0, 0.0, rod.omega])
    return float(time_of_impact(
        thin, ball, still, still, horizon=rod.horizon, spin_a=spin, pivot_a=still, tolerance=1e-9
    ))  # fmt: skip


def advancement_steps(
    rod: Rod, tolerance: float, *, most: int = 100_000
) -> tuple[float, int]:
    """The time that conservative advancement reaches, and how many gaps it asks for."""
    t, fastest = 0.0, abs(rod.omega)
    for k in range(1, most + 1):
        gap = float(rod.gap(np.array([t]))[0])
        if gap <= tolerance:
            return t, k
        t += gap / fastest
        if t > rod.horizon:
            return np.inf, k
    return t, most


def tip_swept_straight(rod: Rod, step: float) -> float:
    """When the tip meets the ball if in each step it is taken to run straight on; inf if never."""
    count = int(np.ceil(rod.horizon / step - 1e-9))
    tips = rod.tip(step * np.arange(count + 1, dtype=float))
    velocity = np.diff(tips, axis=0) / step
    time = formulas.swept_spheres_time(
        tips[:-1], 0.0, velocity, rod.center, rod.radius, np.zeros(3), step
    )
    time = step * np.arange(count) + time
    return float(np.min(np.where(time <= rod.horizon, time, np.inf)))


def stopped_rod(rod: Rod, function: Callable[..., Any], tolerance: float) -> float:
    """When somebody's ``conservative_advancement`` stops it [s]."""
    found = asked(function, [()], *rod.arguments, tolerance, never=True)
    return max(float(found[0]), 0.0)
