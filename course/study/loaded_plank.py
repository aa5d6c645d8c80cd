"""A plank on two feet with a load that may stand anywhere on it: two contacts, of which one may lift.

Seen from the side in the plane of y (to the right) and z (up). Plank and load are one rigid body; its centre of mass
is at y = load * load_at / (load + mass). As long as it lies between the feet both carry (the law of the lever); past a
foot the plank turns about it and the other foot lifts.
"""

from __future__ import annotations

import numpy as np

from course.arrays import failure, positive, scalar, written
from course.study.resting_layouts import (
    UP,
    RestingScene,
    contacts_at,
    weighed,
    with_ground,
)

#: Breadth along x [m]; it has no part in what happens in the plane.
BREADTH = 0.4


def loaded_plank(
    load_at: float,
    *,
    load: float = 20.0,
    mass: float = 10.0,
    length: float = 3.0,
    feet: float = 0.5,
) -> RestingScene:
    """The plank at rest, body 0, on the ground, body 1; contact 0 is the left foot at y = -feet, 1 the right one.

    Its moment about x is m l^2/12 + m c^2 + load (load_at - c)^2 about the common centre of mass c.

    Args:
        load_at: where the load stands on the plank, y [m].
        load, mass: of the load, a point, and of the plank [kg].
        length: of the plank [m].
        feet: distance of each foot from the middle [m].
    Raises:
        ValueError: a load that is not on the plank, masses or lengths that are not positive.
    """
    y, half = (
        scalar("load_at", load_at),
        0.5 * scalar("length", positive("length", length)),
    )
    if abs(y) > half:
        raise failure(
            "load_at", f"a place on the plank, from {-half:g} to {half:g}", written(y)
        )
    p, m = (
        scalar(name, positive(name, value))
        for name, value in (("load", load), ("mass", mass))
    )
    foot = scalar("feet", positive("feet", feet))
    centre = p * y / (p + m)
    turning = m * (length**2 / 12 + centre**2) + p * (y - centre) ** 2
    rolling = m * BREADTH**2 / 12
    bodies = with_ground(
        [p + m],
        np.diag([turning, rolling, turning + rolling])[None],
        np.array([[0.0, centre, 0.0]]),
    )
    point = np.array([[0.0, -foot, 0.0], [0.0, foot, 0.0]])
    contacts = contacts_at(np.zeros(2), np.ones(2), point, np.tile(UP, (2, 1)))
    return weighed(f"plank with its load at {y:g} m", bodies, contacts)
