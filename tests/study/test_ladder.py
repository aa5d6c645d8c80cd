"""The ladder: its gaps along its motion, and the closed forms against the contact system and each other."""

import numpy as np
import pytest

from course.contact import contact_system, separation_rate
from course.dynamics import reference_motion, uniform_gravity
from course.study.ladder import (
    ladder,
    ladder_gaps,
    leaving_angle,
    sliding_ladder_forces,
    standing_ladder_forces,
)


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
    theta = leaving_angle(start)
    rate = -np.sqrt(
        3 * 9.81 / 4.0 * (np.sin(start) - np.sin(theta))
    )  # energy: m l^2 theta_dot^2/6
    assert sliding_ladder_forces(theta, rate=rate)[1] == pytest.approx(0, abs=1e-12)


def test_gaps_of_a_batch():
    found = ladder_gaps(
        np.array([-2.0, -3.0]), 1.0, np.array([0.0, np.pi / 2]), length=2.0
    )
    np.testing.assert_allclose(found, [[1.0, 1.0], [0.0, 3.0]], atol=1e-15)


@pytest.mark.parametrize(("bad", "name"), [(dict(angle=0.0), "angle"), (dict(angle=2.0), "angle"),
                                           (dict(mass=-1.0), "mass"), (dict(rate=1.0, kerb=True), "rate")])  # fmt: skip
def test_refusals(bad, name):
    with pytest.raises(ValueError, match=f"^{name}: expected"):
        ladder(**({"angle": 1.0} | bad))
