"""One case at a time, worked out for a picture whose numbers stand on sliders."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course import formulas
from course.arrays import Array, ArrayLike
from course.contact import ContactSystem, resolve_collisions, solve
from course.dynamics import (
    Bodies,
    Dome,
    effective_mass,
    impulse_central,
    kinetic_energy_lost,
    point_velocity,
    total_energy,
    wall_bounce,
)
from course.scenes import bar_over_plank, falling_rods, loaded_plank, table


@dataclass(frozen=True, eq=False)
class CentralImpact:
    """Two bodies on one line, body 2 on the left, body 1 on the right, n to the right.

    Args:
        mass, before, after: of body 1 and body 2, (2,) [kg], [m/s], [m/s].
        impulse, lost: p_hat [N s] and the kinetic energy lost [J].
    """

    mass: Array
    before: Array
    after: Array
    impulse: float
    lost: float


def central_impact(
    mass_1: float,
    mass_2: float,
    velocity_1: float,
    velocity_2: float,
    restitution: float,
) -> CentralImpact:
    """A central impact along x; speeds along n [m/s], masses [kg]."""
    n = np.array([1.0, 0.0, 0.0])
    given = (mass_1, mass_2, velocity_1 * n, velocity_2 * n, n, restitution)
    p_hat, lost = float(impulse_central(*given)), float(kinetic_energy_lost(*given))
    mass, before = np.array([mass_1, mass_2]), np.array([velocity_1, velocity_2])
    after = before + p_hat * np.array([1, -1]) / mass
    return CentralImpact(mass, before, after, p_hat, lost)


@dataclass(frozen=True, eq=False)
class WallReflection:
    """A ball that comes at 1 m/s and a wall, in the plane of x and y.

    Args:
        wall_angle, incoming_angle: from the horizontal [degrees].
        restitution: e.
        normal, along: unit vectors out of the wall and along it, (3,).
        before, after: velocities, (3,) [m/s].
    """

    wall_angle: float
    incoming_angle: float
    restitution: float
    normal: Array
    along: Array
    before: Array
    after: Array


def wall_reflection(
    wall_angle: float, incoming_angle: float, restitution: float
) -> WallReflection:
    """A bounce; angles of the wall's surface and of the velocity the ball comes with [degrees]."""
    (c, going_c), (s, going_s) = (
        f(np.radians([wall_angle, incoming_angle])) for f in (np.cos, np.sin)
    )
    normal, along = np.array([-s, c, 0.0]), np.array([c, s, 0.0])
    before = np.array([going_c, going_s, 0.0])
    after = wall_bounce(before, normal, restitution)
    given = wall_angle, incoming_angle, restitution
    return WallReflection(*given, normal, along, before, after)


@dataclass(frozen=True, eq=False)
class RodLanding:
    """A rod of 1 kg and 1 m that falls at 1 m/s, before and after the floor hits it at one point.

    Args:
        angle: from the horizontal [degrees]; the lower end is on the right.
        restitution, place: e, and where it is hit, 1 the lower end, -1 the upper.
        axis: along it, toward the lower end, (3,).
        before, after: velocities of its upper end, middle and lower end, (3, 3) [m/s].
        spin: omega_y after [rad/s].
        impulse: of the floor, upward [N s].
        felt: effective mass at the point [kg].
        kept: kinetic energy after over before.
    """

    angle: float
    restitution: float
    place: float
    axis: Array
    before: Array
    after: Array
    spin: float
    impulse: float
    felt: float
    kept: float


def rod_landing(angle: float, restitution: float, place: float) -> RodLanding:
    """A rod's landing; the angle in degrees, the place from -1 to 1, 0 the middle."""
    scene = falling_rods(np.radians(angle), place=place)
    before, after = (
        scene.bodies,
        resolve_collisions(scene.bodies, scene.contacts, restitution),
    )
    axis = before.rotation[0, :, 0]
    arms = 0.5 * np.outer([-1.0, 0.0, 1.0], axis)
    was, now = (
        point_velocity(s.velocity[0], s.angular_velocity[0], arms)
        for s in (before, after)
    )
    return RodLanding(
        angle,
        restitution,
        place,
        axis,
        was,
        now,
        spin=float(after.angular_velocity[0, 1]),
        impulse=float(after.momentum[0, 2] - before.momentum[0, 2]),
        felt=float(effective_mass(before, scene.contacts)[0]),
        kept=float(total_energy(after) / total_energy(before)),
    )


@dataclass(frozen=True, eq=False)
class TwoForces:
    """Two contacts in the plane of their forces.

    Args:
        matrix, bias: A (2, 2) [1/kg] and b (2,) [m/s^2].
        forced: where both d_ddot are 0, whatever the signs, (2,) [N].
        force, acceleration: of the solution, (2,) [N], [m/s^2].
        sweeps: forces after each step of projected Gauss-Seidel from 0, (k, 2) [N].
    """

    matrix: Array
    bias: Array
    forced: Array
    force: Array
    acceleration: Array
    sweeps: Array


def two_forces(a: ArrayLike, b: ArrayLike, *, sweeps: int = 3) -> TwoForces:
    """Solve for two contact forces, and sweep a few times: A (2, 2) [1/kg], b (2,) [m/s^2]."""
    matrix, bias = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    force = solve(ContactSystem(matrix, bias)).force
    path = [np.zeros(2)]
    for i in [0, 1] * sweeps:
        f = path[-1].copy()
        f[i] = max(0.0, f[i] - (matrix[i] @ f + bias[i]) / matrix[i, i])
        path.append(f)
    forced = np.linalg.solve(matrix, -bias)
    return TwoForces(matrix, bias, forced, force, matrix @ force + bias, np.array(path))


@dataclass(frozen=True, eq=False)
class PlankForces:
    """The loaded plank: y of load, centre of mass and feet (2,) [m], and the forces at the feet."""

    load_at: float
    centre: float
    feet: Array
    forces: TwoForces


def plank_forces(load_at: float) -> PlankForces:
    """``course.scenes.loaded_plank`` with its load at y [m], solved."""
    scene = loaded_plank(load_at)
    system = scene.system()
    centre, feet = float(scene.bodies.position[0, 1]), scene.contacts.point[:, 1]
    return PlankForces(load_at, centre, feet, two_forces(system.A.toarray(), system.b))


@dataclass(frozen=True, eq=False)
class PushedTable:
    """A table of 1 kg that is pushed up from below with 1 N.

    Args:
        place, centre: of the push and of the centre of mass, (2,) [m].
        feet: (4, 3) [m].
        response: upward acceleration of each foot, (4,) [m/s^2].
        still: two points of the line that does not move at first, (2, 2) [m]; None where
            the push is under the centre of mass.
    """

    place: Array
    centre: Array
    feet: Array
    response: Array
    still: Array | None


def pushed_table(
    x: float = 0.5, y: float = 0.3, offset_x: float = 0.1, offset_y: float = 0.05
) -> PushedTable:
    """The table pushed at (x, y) with its centre of mass at the offsets from the middle [m].

    Nothing moves at first where 1/m + r_y p_y/I_x + r_x p_x/I_y = 0, x and y being
    principal axes.
    """
    scene = table(offset=(offset_x, offset_y))
    bodies, feet, place = scene.bodies, scene.contacts.point, np.array([x, y])
    mass, inverse = bodies.mass[0], bodies.world_inverse_inertia[0]
    arms, push_arm = (p - bodies.position[0] for p in (feet, np.array([x, y, 0.0])))
    up = np.array([0.0, 0.0, 1.0])
    lift = [formulas.point_response(mass, inverse, r, push_arm, up)[2] for r in arms]
    centre, still = bodies.position[0, :2], None
    slope = (place - centre) * np.array([inverse[1, 1], inverse[0, 0]])
    size = float(slope @ slope)
    if size >= 1e-9:
        along = np.array([-slope[1], slope[0]]) / np.sqrt(size)
        still = centre - slope / (mass * size) + np.array([[-3.0], [3.0]]) * along
    return PushedTable(place, centre, feet, np.array(lift), still)


@dataclass(frozen=True, eq=False)
class OldPoint:
    """A particle let go on a dome of 1 m, a moment ahead, in the plane of y and z.

    Args:
        angle, ahead: from the top [degrees], and the moment [s].
        path: of the flight, (k, 2) [m], from the touched point to the particle.
        normal: of the dome at the particle, (2,).
        gap, from_old_point: to the dome, and along N from the point touched before [m].
        bias, speed: d_ddot without a force [m/s^2], and v when it was let go [m/s].
    """

    angle: float
    ahead: float
    path: Array
    normal: Array
    gap: float
    from_old_point: float
    bias: float
    speed: float


def old_point(angle: float, ahead: float) -> OldPoint:
    """The gap to a dome and the gap from the point that was touched; degrees from the top and s ahead."""
    dome, theta = Dome(), np.radians(angle)
    path = dome.flight(theta, np.linspace(0, ahead, 40))
    return OldPoint(
        angle,
        ahead,
        path,
        path[-1] / np.linalg.norm(path[-1]),
        gap=float(dome.gap(theta, ahead)),
        from_old_point=float(dome.gap_from_the_old_point(theta, ahead)),
        bias=float(dome.bias(theta)),
        speed=float(dome.speed(theta)),
    )


@dataclass(frozen=True, eq=False)
class GapRate:
    """How fast a bar and a plank part, and what each motion adds to it.

    Args:
        bodies: bar and plank, level.
        point, velocity: of the two points of the contact, (2, 3) [m], [m/s].
        parts: name of a motion -> what it adds to d_dot [m/s].
    """

    bodies: Bodies
    point: Array
    velocity: Array
    parts: dict[str, float]

    @property
    def total(self) -> float:
        """d_dot [m/s]."""
        return sum(self.parts.values())


def gap_rate(
    rate_a: float,
    rate_b: float,
    velocity_a: float = 0.0,
    velocity_b: float = 0.0,
    *,
    reach: float = 1.8,
) -> GapRate:
    """Bar over plank: rates against the clock [rad/s], velocities upward [m/s], y of the bar's centre [m]."""
    scene = bar_over_plank(rate_a, rate_b, reach=reach, clear=0.7)
    bodies, contact = scene.bodies, scene.contacts
    point = np.stack([contact.point_a[0], contact.point_b[0]])
    lift = np.outer([velocity_a, velocity_b], [0.0, 0.0, 1.0])
    turning = point_velocity(0 * lift, bodies.angular_velocity, point - bodies.position)
    parts = {
        "A rises": velocity_a,
        "A turns": float(turning[0, 2]),
        "B rises": -velocity_b,
        "B turns": -float(turning[1, 2]),
    }
    return GapRate(bodies, point, turning + lift, parts)
