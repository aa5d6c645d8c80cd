"""Which colliders of a world meet first, of all that fly for a while."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import Array, BoolArray, IntArray, failure, written
from course.detection.choosing import broad_phase
from course.detection.world.flights import Flight, flight_times
from course.detection.world.members import Members, permitted
from course.detection.world.phases import alike, below
from course.overlap import time_of_impact
from course.shapes import AABB

#: Pairs that meet within this part of the horizon meet at once.
AT_ONCE = 1e-9


@dataclass(frozen=True, eq=False)
class FirstHit:
    """The first impact, and all pairs that meet then.

    Attributes:
        time: [s], inf if nothing meets.
        handles: (k, 2), A being the lower.
        bodies: (k, 2).
    """

    time: float
    handles: IntArray
    bodies: IntArray


def flights_of(members: Members, velocity: Array, spin: Array, acceleration: Array) -> Flight:  # fmt: skip
    """How each row flies, given that of each body, (bodies, 3); fixed rows rest.

    Raises:
        ValueError: a half space that spins: it reaches without end.
    """
    moving = ~members.fixed[:, None]
    turning = members.is_plane & ~members.fixed & np.any(spin[members.body] != 0, axis=1)  # fmt: skip
    if np.any(turning):
        body = int(members.body[np.argmax(turning)])
        raise failure("spin", "0 of bodies with a half space", written(spin[body]), (body,))  # fmt: skip
    v, omega, a = (
        np.where(moving, x[members.body], 0.0) for x in (velocity, spin, acceleration)
    )
    arm = members.coarse.now["center"] - members.pivot
    reach = np.linalg.norm(arm, axis=1) + members.radius + members.slack
    return Flight(members.pivot, v, omega, a, reach)


def first_of(members: Members, flights: Flight, horizon: float) -> FirstHit:
    """The first impact within the horizon."""
    pairs = _candidates(members, flights, horizon)
    time, until = np.full(len(pairs), np.inf), horizon
    for _, some, a, b in alike(members, pairs):
        i, j = pairs[some].T
        end = np.full(some.size, until)
        time[some] = _times(members, a, b, i, j, flights, end)
        until = min(until, float(time[some].min()) + AT_ONCE * horizon)
    first = float(time.min(initial=np.inf))
    found = pairs[time <= first + AT_ONCE * horizon] if first < np.inf else pairs[:0]
    return FirstHit(first, members.handle[found], members.body[found])


def swept_boxes(members: Members, flights: Flight, horizon: float) -> Array:
    """Boxes around all places of each row until the horizon, (n, 6) [m].

    Each coordinate of v t + a t^2/2 is largest and least at 0, at T, or where it turns back,
    t = -v/a. What spins stays within rho of its pivot.
    """
    v, a = flights.velocity, flights.acceleration
    with np.errstate(divide="ignore", invalid="ignore"):
        back = np.where(a != 0, np.clip(-v / a, 0.0, horizon), 0.0)
    ways = [np.zeros_like(v), v * horizon + 0.5 * a * horizon**2, v * back + 0.5 * a * back**2]  # fmt: skip
    spins = np.any(flights.spin != 0, axis=1)[:, None]
    rho = flights.reach[:, None]
    more = members.slack[:, None]
    low = np.where(spins, flights.pivot - rho, members.box[:, :3] - more)
    high = np.where(spins, flights.pivot + rho, members.box[:, 3:] + more)
    return np.concatenate([low + np.min(ways, axis=0), high + np.max(ways, axis=0)], axis=1)  # fmt: skip


def _candidates(members: Members, flights: Flight, horizon: float) -> IntArray:
    """Pairs that may touch and whose swept boxes meet, i < j; with a half space that moves, all."""
    box = swept_boxes(members, flights, horizon)
    plane = members.is_plane
    solid = np.flatnonzero(~plane)
    pairs = [solid[broad_phase(AABB(box[solid, :3], box[solid, 3:]))]]
    for row in np.flatnonzero(plane):
        rests = not np.any([flights.velocity[row], flights.spin[row], flights.acceleration[row]])  # fmt: skip
        near = solid
        if rests:
            near = solid[below(members, box[solid], np.full(solid.size, row), 0.0)]
        pairs.append(np.column_stack([np.full(near.size, row), near]))
    found = np.sort(np.concatenate(pairs), axis=1)
    found = found[permitted(members, found)]
    return found[np.lexsort((found[:, 1], found[:, 0]))]


def _times(
    members: Members, a: object, b: object, i: IntArray, j: IntArray, flights: Flight, end: Array
) -> Array:  # fmt: skip
    """Times of impact of pairs of one kind each; where nothing bends relative to the other, without steps."""
    fly_a, fly_b = flights[i], flights[j]
    bends: BoolArray = np.any(fly_a.acceleration != fly_b.acceleration, axis=1)
    time = np.full(i.size, np.inf)
    if not np.all(bends):
        s = np.flatnonzero(~bends)
        time[s] = time_of_impact(
            a[s], b[s], fly_a.velocity[s], fly_b.velocity[s], horizon=end[s],  # type: ignore[index]
            spin_a=fly_a.spin[s], spin_b=fly_b.spin[s],
            pivot_a=fly_a.pivot[s], pivot_b=fly_b.pivot[s],
        )  # fmt: skip
    if np.any(bends):
        s = np.flatnonzero(bends)
        size = np.minimum(*(_size(members, rows[s]) for rows in (i, j)))
        far = members.slack[i[s]] + members.slack[j[s]]
        time[s] = flight_times(
            a[s], b[s], fly_a[s], fly_b[s], end[s], 1e-9 * size + far  # type: ignore[index]
        )  # fmt: skip
    return time


def _size(members: Members, rows: IntArray) -> Array:
    """The radius of rows; without end of half spaces."""
    return np.where(members.is_plane[rows], np.inf, members.radius[rows])
