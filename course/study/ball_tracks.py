"""Balls rolling on a table without friction, from collision to collision."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    choice,
    failure,
    in_range,
    positive,
    scalar,
    scalars,
    written,
)
from course.contact import resolve_collisions
from course.contact.collisions import LAWS
from course.dynamics import Bodies
from course.overlap import Contacts, sphere_contacts, sphere_plane_contacts


@dataclass(frozen=True, eq=False)
class BallTracks:
    """Balls on a frictionless table, event by event.

    Args:
        time: of the start, each event, and the end, (t,) [s]; straight lines between.
        position: (t, n, 3) [m].
        velocity: after each of these times, (t, n, 3) [m/s].
        events: how many times balls met each other or a cushion.
        finished: False if max_events came before the end; the tracks stop there.
    """

    time: Array
    position: Array
    velocity: Array
    events: int
    finished: bool


def roll(
    bodies: Bodies,
    radius: float,
    duration: float,
    *,
    table: tuple[ArrayLike, ArrayLike] | None = None,
    law: str = "simultaneous",
    restitution: float = 1.0,
    max_events: int = 5000,
) -> BallTracks:
    """Free balls of one radius, no gravity and no friction, from collision to collision.

    The next event is the least root of |dx + dv t| = 2 r over the pairs that
    approach, or the next cushion; then ``resolve_collisions`` with every pair
    and cushion that touches. All pairs are looked at for each event, which is
    fair for tens of balls.

    Args:
        bodies: n free balls that do not overlap.
        radius: [m].
        duration: [s].
        table: lower and upper corner, (2,) each [m], of cushions in x and y; None for an endless plane.
        law, restitution: of ``resolve_collisions``.
    """
    r, end = (
        float(positive("radius", scalar("radius", radius))),
        float(positive("duration", duration)),
    )
    choice("law", law, LAWS)
    e = float(in_range("restitution", scalar("restitution", restitution), 0, 1))
    _require_free(bodies)
    low, high = _cushions(table, r)
    state, time = bodies, 0.0
    times, places, speeds, events = [0.0], [bodies.position], [bodies.velocity], 0
    while events < max_events:
        wait = _next_event(state.position, state.velocity, r, low, high)
        moved = min(wait, end - time)
        state = replace(state, position=state.position + moved * state.velocity)
        time += moved
        if wait <= moved:
            state = _collide(state, r, low, high, law, e)
            events += 1
        times.append(time)
        places.append(state.position)
        speeds.append(state.velocity)
        if time >= end:
            break
    return BallTracks(
        np.array(times), np.array(places), np.array(speeds), events, time >= end
    )


def _require_free(bodies: Bodies) -> None:
    if np.any(bodies.fixed):
        at = (int(np.argmax(bodies.fixed)),)
        raise failure("bodies", "free balls", "a body of infinite mass", at)


def _cushions(
    table: tuple[ArrayLike, ArrayLike] | None, radius: float
) -> tuple[Array, Array]:
    """Where centres may be."""
    if table is None:
        return np.full(3, -np.inf), np.full(3, np.inf)
    lower, upper = scalars("table", table[0]), scalars("table", table[1])
    if (
        lower.shape != (2,)
        or upper.shape != (2,)
        or np.any(upper - lower <= 2 * radius)
    ):
        raise failure("table", "two corners (x, y), lower below upper", written(table))
    return np.append(lower + radius, -np.inf), np.append(upper - radius, np.inf)


def _next_event(x: Array, v: Array, radius: float, low: Array, high: Array) -> float:
    """Time until two balls or a ball and a cushion meet; 0 if they touch and approach."""
    i, j = np.triu_indices(len(x), 1)
    dx, dv = x[i] - x[j], v[i] - v[j]
    closing = -np.sum(dx * dv, axis=-1)
    square = np.sum(dv * dv, axis=-1)
    gap = np.sum(dx * dx, axis=-1) - 4 * radius**2
    # What approaches more slowly than this is taken to touch and stay.
    meets = closing > 1e-9 * radius * np.max(np.abs(v), initial=0.0)
    root = closing**2 - square * gap
    meets &= root >= 0
    pair = np.maximum(gap[meets], 0.0) / (closing[meets] + np.sqrt(root[meets]))
    with np.errstate(divide="ignore", invalid="ignore"):
        side = np.where(v > 0, (high - x) / v, np.where(v < 0, (low - x) / v, np.inf))
    return float(
        min(np.min(pair, initial=np.inf), max(np.min(side, initial=np.inf), 0.0))
    )


def _collide(
    state: Bodies, radius: float, low: Array, high: Array, law: str, restitution: float
) -> Bodies:
    n, margin = len(state), 1e-7 * radius
    axes, limits = np.eye(3)[:2], np.concatenate([low[:2], -high[:2]])
    cushions = np.isfinite(limits)
    touching = sphere_contacts(state.position, radius, margin=margin)
    sides = sphere_plane_contacts(
        state.position,
        radius,
        np.concatenate([axes, -axes])[cushions],
        limits[cushions] - radius,
        margin=margin,
    )
    frame = Bodies.balls(np.inf, 1.0, np.zeros((1, 3)))
    both = Bodies.concatenate([state, frame])
    contacts = Contacts.concatenate([touching, sides])
    after = resolve_collisions(both, contacts, restitution, law=law)
    return after[:n]
