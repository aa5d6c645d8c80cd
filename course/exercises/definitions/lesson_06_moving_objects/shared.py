"""What the exercises of this lesson share: pairs that meet, that pass, that touch, drawn by kind.

No drawn verdict hangs on rounding: what is to graze or to touch has numbers that are exact.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course.arrays import Array
from course.exercises.definition import Value
from course.exercises.definitions.vectors import unit_vector

#: What a pair does, in turn.
KINDS = ("meet", "pass", "part", "overlap", "late")
HORIZON = Value("horizon", "(...)", "s", "how long they are followed")
TIME = Value("time", "(...)", "s", "time of impact, inf where there is none")


def moves(rng: np.random.Generator, kinds: Sequence[str]) -> dict[str, Array]:
    """Where A is from B, how fast it moves, and the horizon, for pairs whose reach is 1.

    "meet": in the horizon; "late": beyond it; "pass": at 1.2 to 2 from B's centre;
    "part": it moves away; "overlap": it moves out of B.

    Returns:
        offset (k, 3), velocity (k, 3), horizon (k,), and unit vectors across (k, 3).
    """
    k, kind = len(kinds), np.array(kinds)
    way = unit_vector(rng, (k,))
    across = np.cross(way, unit_vector(rng, (k,)))
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    aside = np.where(kind == "pass", rng.uniform(1.2, 2.0, k), rng.uniform(0.1, 0.7, k))
    far = np.where(
        kind == "overlap", rng.uniform(0.1, 0.5, k), rng.uniform(2.0, 5.0, k)
    )
    speed = rng.uniform(1.5, 4.0, k)
    away = np.isin(kind, ("part", "overlap"))
    horizon = np.where(kind == "late", 0.3, rng.uniform(1.2, 2.0, k)) * far / speed
    return {
        "offset": -far[:, None] * way + aside[:, None] * across,
        "velocity": np.where(away, -speed, speed)[:, None] * way,
        "horizon": np.round(horizon, 3),
        "across": across,
    }


def in_turn(count: int) -> list[str]:
    """So many kinds, one after the other."""
    return [KINDS[k % len(KINDS)] for k in range(count)]
