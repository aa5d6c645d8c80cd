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
    failure,
    in_range,
    positive,
    scalar,
    scalars,
    written,
)


@dataclass(frozen=True, eq=False)
class DomePaths:
    """A particle's ways down a dome, in the plane of y and z.

    Args:
        radius: R [m].
        leaving, leaving_as_printed: the angles where it leaves [rad].
        slide: along the dome from the start to where it leaves, (k, 2) [m].
        flight, flight_as_printed: after it has left, (l, 2) each [m].
        depth: how deep the flight as printed runs inside the dome [m].
        deepest, out: where it is deepest and where it comes out, (2,) each [m].
    """

    radius: float
    leaving: float
    leaving_as_printed: float
    slide: Array
    flight: Array
    flight_as_printed: Array
    depth: float
    deepest: Array
    out: Array


@dataclass(frozen=True, eq=False)
class DomeBias:
    """The second rate of a gap over the angle, without a contact force.

    Args:
        angle: (k,) [rad].
        true, as_printed: v^2/R - g cos theta and 2 v^2/R - g cos theta, (k,) [m/s^2].
        over_the_plane: -g cos theta, over the plane that was touched, (k,) [m/s^2].
        leaving, leaving_as_printed: where the first two are 0 [rad].
    """

    angle: Array
    true: Array
    as_printed: Array
    over_the_plane: Array
    leaving: float
    leaving_as_printed: float


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

    def dive(self, angle: ArrayLike) -> tuple[float, Array, Array]:
        """Where the flight from an angle that is too early runs inside the dome.

        Returns:
            How deep at most [m], the place where it is, and the place where it comes
            out again, (2,) of y and z [m]; by 2,000 points of the flight.
        """
        times = np.linspace(0, np.sqrt(2 * self.radius / self.gravity), 2000)
        gaps, places = self.gap(angle, times), self.flight(angle, times)
        deepest = int(np.argmin(gaps))
        outside = deepest + int(np.argmax(gaps[deepest:] >= 0))
        return float(-gaps[deepest]), places[deepest], places[outside]

    def paths(self) -> DomePaths:
        """Where the particle slides and flies, by the truth and by the printed formula.

        Each flight takes 1.2 times the time of a fall through R.
        """
        true, printed = self.leaving_angle, self.leaving_angle_as_printed
        slide = self.radius * _directions(np.linspace(self.start, true, 50))[0]
        times = np.linspace(0, 1.2 * np.sqrt(2 * self.radius / self.gravity), 60)
        flown, as_printed = self.flight(true, times), self.flight(printed, times)
        deepest = self.dive(printed)
        return DomePaths(self.radius, true, printed, slide, flown, as_printed, *deepest)

    def bias_curves(self, end: float = np.radians(70.0)) -> DomeBias:
        """The second rates of the gap from the start to an angle ``end`` [rad]."""
        theta = np.linspace(self.start, scalar("end", end), 200)
        return DomeBias(
            theta,
            self.bias(theta),
            self.bias_as_printed(theta),
            -self.gravity * np.cos(theta),
            self.leaving_angle,
            self.leaving_angle_as_printed,
        )

    def bias(self, angle: ArrayLike) -> Array:
        """d_ddot without a contact force, v^2/R - g cos theta, (...) [m/s^2]."""
        return self.speed(angle) ** 2 / self.radius - self.gravity * np.cos(angle)

    def bias_as_printed(self, angle: ArrayLike) -> Array:
        """What the reduced formula makes of it, 2 v^2/R - g cos theta, (...) [m/s^2]."""
        return 2 * self.speed(angle) ** 2 / self.radius - self.gravity * np.cos(angle)


def _directions(angle: ArrayLike) -> tuple[Array, Array]:
    """Out of the dome, and down along it, (..., 2) each."""
    theta = scalars("angle", angle)
    sine, cosine = np.sin(theta), np.cos(theta)
    return np.stack([sine, cosine], axis=-1), np.stack([cosine, -sine], axis=-1)
