"""Two spheres that come together far from the origin, with their places stored in so many bytes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import Array
from course.study.asking import asked
from course.study.far_places import DTYPES, SpheresVerdict
from course.study.shadow_cases import stopped_at

#: The radii of the two spheres far from the origin, A's and B's [m].
FAR_RADII = 5.0, 4.0
#: Where B's centre begins, seen from A's [m], and how fast it comes [m/s].
FAR_START, FAR_SPEED = 30.0, 6.0


@dataclass(frozen=True, eq=False)
class FarMeeting:
    """Sphere B comes toward sphere A, X from the origin, until a verdict on stored places stops it.

    Args:
        times: (t,) [s].
        true: B's centre as seen from A's, (t, 2) [m].
        drawn: the same of the places as they are stored, (t, 2) [m].
        gap: the true one, (t,) [m].
        stored_gap: that of the stored places, (t,) [m].
        stopped: whether the verdict stopped it.
    """

    times: Array
    true: Array
    drawn: Array
    gap: Array
    stored_gap: Array
    stopped: bool


def far_meeting(
    far: float, lane: float, times: Array, size: int, function: SpheresVerdict
) -> FarMeeting:
    """B comes along x, with its places stored in so many bytes.

    Args:
        far: X, x of A's centre, taken to a number that 4 bytes can hold [m].
        lane: y of B's centre [m].
        function: ``spheres_overlap``, asked at each moment.
    """
    kind, far = DTYPES[size], float(np.float32(far))
    r_a, r_b = (kind(r) for r in FAR_RADII)
    x_a = np.array([far, 0.0, 0.0], dtype=kind)

    def place(x: Array) -> Array:
        x = np.asarray(x)
        fill = np.broadcast_to
        return np.stack([far + x, fill(lane, x.shape), fill(0.0, x.shape)], axis=-1)

    def says(x: float) -> bool:
        return bool(
            asked(function, [()], x_a, r_a, place(np.array(x)).astype(kind), r_b)[0]
        )

    way = FAR_START - FAR_SPEED * times
    stop, met = stopped_at(says, way)
    x = np.maximum(way, stop)
    drawn = place(x).astype(kind).astype(float) - x_a.astype(float)
    true = np.stack([x, np.full_like(x, lane)], axis=-1)
    gap, stored_gap = (
        np.linalg.norm(p, axis=-1) - sum(FAR_RADII) for p in (true, drawn)
    )
    return FarMeeting(times, true, drawn[:, :2], gap, stored_gap, met)
