"""One body on its supports: a table, a loaded plank, a ladder, a rod, a ball in a groove, a block on pins."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from course import rotations
from course.arrays import failure, positive, scalar, whole_number, written
from course.dynamics import (
    Bodies,
    sliding_ladder_forces,
    standing_ladder_forces,
)
from course.scenes.layout import UP, contacts_at, with_ground
from course.scenes.scene import GRAVITY, Scene, resting

#: Breadth of ladder and plank along x [m]; it has no part in what happens in the plane.
BREADTH = 0.4


def table(
    legs: int = 4,
    *,
    offset: tuple[float, float] = (0.1, 0.05),
    half_widths: tuple[float, float] = (0.5, 0.3),
) -> Scene:
    """A table of 1 kg on the ground, 4 legs at the corners, any other number on the ellipse through these.

    Four legs are one too many: A has rank 3, and with f every
    f + t (1, -1, 1, -1) that is not negative solves it.

    Args:
        legs: how many, counted from (+, +) to (-, +).
        offset: of the centre of mass from the middle of the legs [m].
        half_widths: a and b, half the distances between the corners [m].
    """
    whole_number("legs", legs, minimum=1)
    a, b = half_widths
    angle = 2 * np.pi * (np.arange(legs) + 0.5) / legs
    across = np.sqrt(2) * np.stack([a * np.cos(angle), b * np.sin(angle)], axis=1)
    centre = np.array([*offset, 0.7])
    bodies = with_ground([1.0], np.diag([0.2, 0.3, 0.4])[None], centre[None])
    feet = np.column_stack([across, np.zeros(legs)])
    return resting(f"table on {legs} legs", bodies, contacts_at(feet))


def loaded_plank(
    load_at: float,
    *,
    load: float = 20.0,
    mass: float = 10.0,
    length: float = 3.0,
    feet: float = 0.5,
) -> Scene:
    """A plank on two feet with a load that may stand anywhere on it: two contacts, of which one may lift.

    Seen from the side in the plane of y (to the right) and z (up). Plank and load are
    one rigid body, 0, on the ground, 1; contact 0 is the left foot at y = -feet, 1 the
    right one. Its moment about x is m l^2/12 + m c^2 + load (load_at - c)^2 about the
    common centre of mass c. Between the feet both carry (the law of the lever); past a
    foot the plank turns about it with M g/(1 + M r^2/I) on it, and the other lifts.

    Args:
        load_at: where the load stands on the plank, y [m].
        load, mass: of the load, a point, and of the plank [kg].
        length: of the plank [m].
        feet: distance of each foot from the middle [m].
    Raises:
        ValueError: a load that is not on the plank, masses or lengths that are not positive.
    """
    y = scalar("load_at", load_at)
    half = 0.5 * scalar("length", positive("length", length))
    if abs(y) > half:
        expected = f"a place on the plank, from {-half:g} to {half:g}"
        raise failure("load_at", expected, written(y))
    p = scalar("load", positive("load", load))
    m = scalar("mass", positive("mass", mass))
    foot = scalar("feet", positive("feet", feet))
    centre, weight = p * y / (p + m), (p + m) * GRAVITY
    turning = m * (length**2 / 12 + centre**2) + p * (y - centre) ** 2
    rolling = m * BREADTH**2 / 12
    inertia = np.diag([turning, rolling, turning + rolling])[None]
    bodies = with_ground([p + m], inertia, np.array([[0.0, centre, 0.0]]))
    sides = foot * np.array([-1.0, 1.0])
    if abs(centre) <= foot:
        truth = 0.5 * weight * (1 + np.sign(sides) * centre / foot)
    else:
        turned_about = weight / (1 + (p + m) * (abs(centre) - foot) ** 2 / turning)
        truth = np.where(sides * centre > 0, turned_about, 0.0)
    contacts = contacts_at(sides[:, None] * [0.0, 1.0, 0.0])
    return resting(f"plank with its load at {y:g} m", bodies, contacts, truth=truth)


def ladder(
    angle: float,
    *,
    rate: float = 0.0,
    length: float = 4.0,
    mass: float = 10.0,
    kerb: bool = False,
    gravity: float = GRAVITY,
) -> Scene:
    """A ladder touching a smooth wall and floor, sliding at theta_dot = rate: d = d_dot = 0 at foot and top.

    ``course.dynamics.ladder_gaps`` says how it lies. Bodies: the ladder 0, the floor 1
    and the wall 2, both fixed. Contacts: foot, top, and with a kerb the foot again,
    N_3 = (0, 1, 0), which keeps it from slipping away from the wall.

    Args:
        angle: theta, above 0 and below pi/2 [rad].
        rate: theta_dot, below 0 while it slides down [rad/s]; 0 with a kerb.
        length, mass: [m], [kg].
        kerb: whether the foot is held; the kerb belongs to the floor.
        gravity: [m/s^2].
    Raises:
        ValueError: an angle out of range, a length or mass that is not positive, a ladder that moves at a kerb.
    """
    theta, omega = scalar("angle", angle), scalar("rate", rate)
    if not 0 < theta < np.pi / 2:
        expected = "a number between 0 and pi/2, both excluded"
        raise failure("angle", expected, written(theta))
    if kerb and omega != 0:
        raise failure("rate", "0 where a kerb holds the foot", written(omega))
    half = 0.5 * scalar("length", positive("length", length))
    m, g = scalar("mass", positive("mass", mass)), scalar("gravity", gravity)
    bodies = _ladder_bodies(theta, omega, half, m)
    reach = half * np.array([0.0, np.cos(theta), np.sin(theta)])
    foot, top = bodies.position[0] - reach, bodies.position[0] + reach
    normal = np.array([UP, [0, -1.0, 0], [0, 1.0, 0]])
    contacts = contacts_at(np.stack([foot, top, foot]), normal, b=[1, 2, 1])
    if kerb:
        truth = standing_ladder_forces(theta, mass=m, gravity=g)
    else:
        options = {"rate": omega, "length": 2 * half, "mass": m, "gravity": g}
        truth = sliding_ladder_forces(theta, **options)
    return resting(
        "ladder held by a kerb" if kerb else "ladder on smooth floor and wall",
        bodies,
        contacts[: 3 if kerb else 2],
        gravity=-g * UP,
        truth=truth if np.all(truth >= 0) else None,
    )


def _ladder_bodies(theta: float, omega: float, half: float, mass: float) -> Bodies:
    """The ladder, sliding, with the floor and the wall; its centre moves on a circle about their corner."""
    sine, cosine = np.sin(theta), np.cos(theta)
    square, broad = (2 * half) ** 2, BREADTH**2
    inertia = mass / 12 * np.diag([square, broad, square + broad])
    upright = rotations.from_rotation_vector([[theta, 0, 0]])
    velocity, ladder_alone = half * omega * np.array([0.0, sine, cosine]), [1, 0, 0]
    return Bodies(
        np.array([mass, np.inf, np.inf]),
        np.stack([inertia, np.eye(3), np.eye(3)]),
        np.stack([[0.0, -half * cosine, half * sine], -UP, [0.0, 1.0, 0.0]]),
        np.concatenate([upright, rotations.identity(2)]),
        np.outer(ladder_alone, mass * velocity),
        np.outer(ladder_alone, inertia[0] * omega),
    )


def leaning_rod(angle: float, *, length: float = 1.0) -> Scene:
    """A thin rod of 1 kg let go with one end on the smooth ground, at an angle from the horizontal [rad].

    The ground carries m g / (1 + 3 cos^2 angle) at that moment.
    """
    tilt = scalar("angle", angle)
    half = 0.5 * scalar("length", positive("length", length))
    centre = half * np.array([np.cos(tilt), 0.0, np.sin(tilt)])
    along = np.outer(centre, centre) / (centre @ centre)
    inertia = length**2 / 12 * (np.eye(3) - along) + 1e-6 * along
    bodies = with_ground([1.0], inertia[None], centre[None])
    truth = [GRAVITY / (1 + 3 * np.cos(tilt) ** 2)]
    return resting("leaning rod", bodies, contacts_at(np.zeros((1, 3))), truth=truth)


def wedged_ball(angle: float = 0.5) -> Scene:
    """A ball of 1 kg between two walls that lean by the angle [rad]; at 0 they stand upright and hold nothing.

    With every f the forces f + (t, t) would hold upright walls' contacts as
    well: what two contacts push in all need not be unique. Walls that lean
    carry m g/(2 sin angle) each.
    """
    lean = scalar("angle", angle)
    normal = np.array([[side * np.cos(lean), 0, np.sin(lean)] for side in (1, -1)])
    bodies = Bodies.balls([1.0, np.inf], 0.5, np.outer([0, -9.0], UP))
    truth = np.full(2, 0.5 * GRAVITY / np.sin(lean)) if 0 < lean < np.pi else None
    contacts = contacts_at(-0.5 * normal, normal)
    return resting("ball between two walls", bodies, contacts, truth=truth)


def spinning_between_pins(rate: float = 2.0, gravity: float = 0.0) -> Scene:
    """A block that turns between two fixed pins at the middles of opposite faces: no force keeps it out of both.

    Its faces would have to stay 1 m apart along a line that turns past them:
    d_ddot = -rate^2 r at each pin, and a push on one pin takes from the other.
    Without spin a force exists.
    """
    still = with_ground([1.0], np.eye(3)[None] / 6, np.zeros((1, 3)))
    turning = np.array([[0, 0, scalar("rate", rate) / 6], [0, 0, 0]])
    normal = np.array([[1.0, 0, 0], [-1.0, 0, 0]])
    contacts = replace(contacts_at(-0.5 * normal, normal), feature=np.full(2, "face_a"))
    return resting(
        "block between two pins",
        replace(still, angular_momentum=turning),
        contacts,
        gravity=-gravity * UP,
        solvable=rate == 0,
    )
