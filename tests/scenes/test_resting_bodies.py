"""One body on its supports: the ladder and the plank, their closed forms against contact systems and each other."""

import numpy as np
import pytest

from course.contact import contact_system, separation_rate, solve
from course.dynamics import (
    ladder_gaps,
    ladder_leaving_angle,
    reference_motion,
    sliding_ladder_forces,
    standing_ladder_forces,
    uniform_gravity,
)
from course.scenes import ladder, loaded_plank


def forces(scene):
    system = contact_system(scene.bodies, scene.contacts, scene.force, scene.torque)
    return np.linalg.solve(system.A.toarray(), -system.b)


@pytest.mark.parametrize("angle", [0.3, 1.0, 1.4])
@pytest.mark.parametrize("rate", [0.0, -0.2, 0.7])
def test_it_touches_and_does_not_part(angle, rate):
    scene = ladder(angle, rate=rate, length=3.0)
    y, z = scene.bodies.position[0, 1:]
    np.testing.assert_allclose(ladder_gaps(y, z, angle, length=3.0), 0, atol=1e-15)
    np.testing.assert_allclose(
        separation_rate(scene.bodies, scene.contacts), 0, atol=1e-15
    )
    assert scene.bodies.angular_velocity[0, 0] == pytest.approx(rate, abs=1e-15)


@pytest.mark.parametrize("angle", [0.3, 1.0, 1.4])
@pytest.mark.parametrize("rate", [0.0, -0.9])
def test_closed_form_keeps_both_gaps_closed(angle, rate):
    """A f + b = 0 for the forces of Lagrange's equation."""
    scene = ladder(angle, rate=rate, length=3.0, mass=7.0)
    expected = sliding_ladder_forces(angle, rate=rate, length=3.0, mass=7.0)
    np.testing.assert_allclose(forces(scene), expected, rtol=1e-12)


def test_closed_form_moves_along_both():
    """The forces, put on the ladder as it goes, keep its ends on floor and wall for a second."""
    start = ladder(1.2)

    def wrench(bodies, time):
        q = bodies.orientation[0]
        theta, rate = 2 * np.arctan2(q[0], q[3]), bodies.angular_velocity[0, 0]
        floor, wall = sliding_ladder_forces(theta, rate=rate)
        force, torque = (x.copy() for x in uniform_gravity((0, 0, -9.81))(bodies, time))
        force[0] += (0, -wall, floor)
        torque[0, 0] = 2.0 * (wall * np.sin(theta) - floor * np.cos(theta))
        return force, torque

    end = reference_motion(start.bodies, wrench, [1.0])[0]
    q = end.orientation[0]
    theta = 2 * np.arctan2(q[0], q[3])
    assert theta < 1.0
    np.testing.assert_allclose(ladder_gaps(*end.position[0, 1:], theta), 0, atol=1e-11)


def test_standing_ladder_balances():
    np.testing.assert_allclose(
        standing_ladder_forces(np.pi / 4, mass=1.0, gravity=10.0),
        [10, 5, 5],
        rtol=1e-12,
    )
    scene = ladder(1.1, kerb=True)
    system = contact_system(scene.bodies, scene.contacts, scene.force, scene.torque)
    np.testing.assert_allclose(
        system.A @ standing_ladder_forces(1.1) + system.b, 0, atol=1e-13
    )


def test_it_leaves_the_wall_at_two_thirds():
    start = 1.2
    theta = ladder_leaving_angle(start)
    rate = -np.sqrt(
        3 * 9.81 / 4.0 * (np.sin(start) - np.sin(theta))
    )  # energy: m l^2 theta_dot^2/6
    assert sliding_ladder_forces(theta, rate=rate)[1] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize(("bad", "name"), [(dict(angle=0.0), "angle"), (dict(angle=2.0), "angle"),
                                           (dict(mass=-1.0), "mass"), (dict(rate=1.0, kerb=True), "rate")])  # fmt: skip
def test_ladders_that_are_refused(bad, name):
    with pytest.raises(ValueError, match=f"^{name}: expected"):
        ladder(**({"angle": 1.0} | bad))


G = 9.81


@pytest.mark.parametrize("load_at", [-0.75, -0.3, 0.0, 0.6])
def test_both_feet_carry_by_the_lever(load_at):
    """Moments about one foot: f_2 (2 feet) = m g (c + feet), with the common centre c."""
    centre = 20 * load_at / 30
    found = solve(loaded_plank(load_at).system())
    np.testing.assert_allclose(
        found.force, 30 * G * (0.5 + np.array([-centre, centre])), rtol=1e-9, atol=1e-9
    )
    np.testing.assert_allclose(found.acceleration, 0, atol=1e-9)


def test_a_foot_lifts_as_the_plank_turns_about_the_other():
    """Newton for the turn about the right foot: f_2 = M g - M c'' with c'' = g M a^2/(I + M a^2), a = .2 m its arm."""
    scene = loaded_plank(1.05)
    inertia = 10 * 9 / 12 + 10 * 0.7**2 + 20 * 0.35**2
    assert scene.bodies.inertia[0, 0, 0] == pytest.approx(inertia, rel=1e-12)
    found = solve(scene.system())
    fall = G * 30 * 0.2**2 / (inertia + 30 * 0.2**2)
    np.testing.assert_allclose(found.force, [0, 30 * (G - fall)], rtol=1e-9, atol=1e-9)
    assert found.acceleration[0] == pytest.approx(
        fall / 0.2, rel=1e-9
    )  # 1 m from the foot it turns about


def test_forcing_both_feet_to_stay_needs_one_that_pulls():
    """Misprint 14: feet at +-.5, centre at .7: (-.2, 1.2) m g."""
    system = loaded_plank(1.05).system()
    forced = np.linalg.solve(system.A.toarray(), -system.b) / (30 * G)
    np.testing.assert_allclose(forced, [-0.2, 1.2], rtol=1e-10)


@pytest.mark.parametrize(
    ("bad", "name"),
    [
        (dict(load_at=1.6), "load_at"),
        (dict(load=0.0), "load"),
        (dict(mass=-1.0), "mass"),
        (dict(feet=0.0), "feet"),
    ],
)
def test_planks_that_are_refused(bad, name):
    with pytest.raises(ValueError, match=f"^{name}: expected"):
        loaded_plank(**({"load_at": 0.0} | bad))
