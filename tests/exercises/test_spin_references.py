"""The references of lesson 12 take plain arrays; they must be those of the library, which takes bodies."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from course import dynamics
from course.exercises.definition import find_exercise
from course.overlap import Contacts


def reference(name):
    return find_exercise(name)[1].reference


@pytest.fixture
def scene():
    """Twenty pairs of turning bodies with one contact each, in some of them body 2 fixed."""
    rng, n = np.random.default_rng(121), 20
    mass = rng.uniform(0.5, 3.0, 2 * n)
    mass[n : n + 5] = np.inf
    free = np.isfinite(mass)[:, None]
    inertia = np.array([np.diag(rng.uniform(1, 1.9, 3)) for _ in mass])
    momentum, angular = rng.normal(size=(2, 2 * n, 3)) * free
    orientation = Rotation.random(2 * n, random_state=rng).as_quat()
    bodies = dynamics.Bodies(
        mass, inertia, rng.normal(size=(2 * n, 3)), orientation, momentum, angular
    )
    normal = rng.normal(size=(n, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    point = rng.normal(size=(n, 3))
    contacts = Contacts(np.arange(n), np.arange(n) + n, point, normal, np.zeros(n))
    arms = point - bodies.position[:n], point - bodies.position[n:]
    return bodies, contacts, arms, n


def mass_felt(bodies, contacts, arms, n):
    inverse, matrices = bodies.inverse_mass, bodies.world_inverse_inertia
    given = inverse[:n], inverse[n:], matrices[:n], matrices[n:], *arms, contacts.normal
    return reference("effective_mass")(*given)


def test_effective_mass_is_that_of_the_library(scene):
    bodies, contacts, _, _ = scene
    assert np.allclose(
        mass_felt(*scene), dynamics.effective_mass(bodies, contacts), rtol=1e-13
    )


def test_impulse_at_point_is_that_of_the_library(scene):
    bodies, contacts, arms, n = scene
    moving = reference("point_velocity")
    sides = zip((slice(n), slice(n, None)), arms, strict=True)
    points = [
        moving(bodies.velocity[s], bodies.angular_velocity[s], a) for s, a in sides
    ]
    for e in (0.0, 0.4, 1.0):
        mine = reference("impulse_at_point")(
            *points, contacts.normal, mass_felt(*scene), e
        )
        assert np.allclose(
            mine, dynamics.impulse_at_point(bodies, contacts, e), rtol=1e-12, atol=1e-14
        )


def test_apply_impulse_is_that_of_the_library(scene):
    bodies, contacts, arms, n = scene
    push = np.random.default_rng(5).uniform(0.5, 2.0, n)
    after = dynamics.apply_impulse(bodies, contacts, push)
    for part, arm, sign in ((slice(n), arms[0], 1.0), (slice(n, None), arms[1], -1.0)):
        velocity, spin = reference("apply_impulse")(
            bodies.velocity[part], bodies.angular_velocity[part], bodies.inverse_mass[part],
            bodies.world_inverse_inertia[part], arm, contacts.normal, sign * push,
        )  # fmt: skip
        assert np.allclose(velocity, after.velocity[part], atol=1e-13)
        assert np.allclose(spin, after.angular_velocity[part], atol=1e-13)


def test_rod_impulse_is_what_a_rod_gets():
    from course.study import falling_rods

    angle = np.linspace(0, 1.5, 6)
    rods, floor = falling_rods(angle, mass=2.0, length=3.0, speed=1.5)
    mine = reference("rod_impulse")(2.0, 1.5, angle, 0.3, 3.0)
    assert np.allclose(mine, dynamics.impulse_at_point(rods, floor, 0.3), rtol=1e-13)


def test_a_slip_in_simultaneous_impulses_is_seen():
    """A slip of 1e-4 in any entry that pushes is seen by the properties that judge."""
    exercise = find_exercise("simultaneous_impulses")[1]
    for case in exercise.draw(3):
        answer = np.array(exercise.reference(*case.arguments.values()))
        pushed = np.flatnonzero(answer > 1e-3)
        for sign in (1e-4, -1e-4):
            slipped = answer.copy()
            slipped[pushed[0]] += sign
            worst = max(
                np.max(np.abs(rule.residual(case.arguments, slipped)))
                for rule in exercise.properties
            )
            assert worst > 1e-6
