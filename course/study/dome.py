"""A particle that slides off a dome: where it leaves, and what the printed formula makes of it.

A fixed sphere of radius R about the origin, seen in the plane of y and z; the
particle slides from rest at the angle theta_0 from the top, without friction.
While it slides, energy gives v^2 = 2 g R (cos theta_0 - cos theta), and
without a contact force its gap to the dome has

    d_ddot = v^2/R - g cos theta

It leaves where that turns positive: cos theta = (2/3) cos theta_0. A material
point of the dome with the turning radial normal in the reduced formula of
syllabus row 20 counts 2 v^2/R and says (4/5) cos theta_0 (misprint 8).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    broadcast,
    choice,
    failure,
    in_range,
    positive,
    scalar,
    scalars,
    written,
)

RULES = ("as printed", "with curvature", "with curvature, located")


@dataclass(frozen=True)
class Dome:
    """A dome and a particle on it.

    Args:
        radius: R [m].
        start: theta_0, where the particle is let go, from 0 (a touch is enough there) to below pi/2 [rad].
        gravity: g [m/s^2].
    Raises:
        ValueError: a radius or gravity that is not positive, a start out of range.
    """

    radius: float = 1.0
    start: float = 0.0
    gravity: float = 9.81

    def __post_init__(self) -> None:
        for name in ("radius", "gravity"):
            positive(name, scalar(name, getattr(self, name)))
        if not 0 <= scalar("start", self.start) < np.pi / 2:
            raise failure("start", "a number from 0 to below pi/2", written(self.start))

    @property
    def leaving_angle(self) -> float:
        """arccos((2/3) cos theta_0) [rad]."""
        return float(np.arccos(2 / 3 * np.cos(self.start)))

    @property
    def leaving_angle_as_printed(self) -> float:
        """arccos((4/5) cos theta_0) [rad]."""
        return float(np.arccos(4 / 5 * np.cos(self.start)))

    def speed(self, angle: ArrayLike) -> Array:
        """v while it slides, (...) [m/s]."""
        theta = in_range("angle", angle, self.start, np.pi / 2)
        return np.sqrt(
            2 * self.gravity * self.radius * (np.cos(self.start) - np.cos(theta))
        )

    def flight(self, angle: ArrayLike, time: ArrayLike) -> Array:
        """Where the particle is if the dome lets go of it at this angle: a parabola, (..., 2) of y and z [m]."""
        out, along = _directions(angle)
        t = scalars("time", time)
        broadcast(angle=(out, 1), time=(t, 0))
        v, t = self.speed(angle)[..., None], t[..., None]
        return (
            self.radius * out
            + t * v * along
            - 0.5 * self.gravity * t**2 * np.array([0.0, 1.0])
        )

    def gap(self, angle: ArrayLike, time: ArrayLike) -> Array:
        """The gap in that flight, |p| - R, (...) [m]; below 0 inside the dome."""
        return np.linalg.norm(self.flight(angle, time), axis=-1) - self.radius

    def gap_from_the_old_point(self, angle: ArrayLike, time: ArrayLike) -> Array:
        """(p - p_B).N with the point p_B of the dome that was touched at time 0 and the radial N of each moment."""
        p, old = self.flight(angle, time), self.radius * _directions(angle)[0]
        return np.sum((p - old) * p, axis=-1) / np.linalg.norm(p, axis=-1)

    def gap_from_the_old_plane(self, angle: ArrayLike, time: ArrayLike) -> Array:
        """(p - p_B).N with both p_B and N of time 0: the height over the plane that touches there."""
        out = _directions(angle)[0]
        return np.sum((self.flight(angle, time) - self.radius * out) * out, axis=-1)

    def bias(self, angle: ArrayLike) -> Array:
        """d_ddot without a contact force, v^2/R - g cos theta, (...) [m/s^2]."""
        return self.speed(angle) ** 2 / self.radius - self.gravity * np.cos(angle)

    def bias_as_printed(self, angle: ArrayLike) -> Array:
        """What the reduced formula makes of it, 2 v^2/R - g cos theta, (...) [m/s^2]."""
        return 2 * self.speed(angle) ** 2 / self.radius - self.gravity * np.cos(angle)


def slide_off(
    dome: Dome, step: float, *, rule: str = "with curvature"
) -> tuple[float, int]:
    """Step a particle down the dome until d_ddot without a force is positive.

    theta_ddot = (g/R) sin theta by the classical Runge-Kutta method of order
    4 (E. Hairer, S. Norsett, G. Wanner, *Solving Ordinary Differential
    Equations I*, section II.1), from rest at theta_0, which must be above 0.

    Args:
        dome: with a start above 0.
        step: [s].
        rule: "as printed" and "with curvature" stop at the first step past the
            sign change, "with curvature, located" puts a straight line through
            the last two values and takes its zero.
    Returns:
        The angle where it leaves [rad] and the number of evaluations of theta_ddot.
    Raises:
        ValueError: a start of 0, where it would rest; a step that is not positive; an unknown rule.
    """
    choice("rule", rule, RULES)
    h = float(positive("step", scalar("step", step)))
    if dome.start == 0:
        raise failure(
            "dome.start", "an angle above 0, from where it slides by itself", "0"
        )
    pull, factor = dome.gravity / dome.radius, 2.0 if rule == "as printed" else 1.0
    state, count = np.array([dome.start, 0.0]), 0
    value = before = -np.inf
    last = state
    while value <= 0:
        last, before = state, value
        k_1 = _rate(state, pull)
        k_2 = _rate(state + 0.5 * h * k_1, pull)
        k_3 = _rate(state + 0.5 * h * k_2, pull)
        state = state + h / 6 * (k_1 + 2 * k_2 + 2 * k_3 + _rate(state + h * k_3, pull))
        count += 4
        value = factor * state[1] ** 2 - pull * np.cos(state[0])
    if rule == "with curvature, located" and np.isfinite(before):
        return float(last[0] + (state[0] - last[0]) * before / (before - value)), count
    return float(state[0]), count


def _rate(state: Array, pull: float) -> Array:
    return np.array([state[1], pull * np.sin(state[0])])


def _directions(angle: ArrayLike) -> tuple[Array, Array]:
    """Out of the dome, and down along it, (..., 2) each."""
    theta = scalars("angle", angle)
    sine, cosine = np.sin(theta), np.cos(theta)
    return np.stack([sine, cosine], axis=-1), np.stack([cosine, -sine], axis=-1)
