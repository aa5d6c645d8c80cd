"""The dome against second differences of the gap, the classic two thirds, and the course's own contact formula."""

import numpy as np
import pytest

from course.contact import separation_acceleration
from course.dynamics import Bodies, Dome
from course.overlap import Contacts
from course.study import slide_off

ANGLES = np.array([0.35, 0.6, 0.9, 1.3])


def second_difference(gap, angle, h=1e-3):
    d = [gap(angle, k * h) for k in (-2, -1, 0, 1, 2)]
    return (-d[0] + 16 * d[1] - 30 * d[2] + 16 * d[3] - d[4]) / (12 * h * h)


@pytest.mark.parametrize("dome", [Dome(), Dome(radius=2.5, start=0.3, gravity=1.6)])
def test_three_gaps_have_three_accelerations(dome):
    """The true one v^2/R - g cos, from the old point 2 v^2/R - g cos, from the old plane - g cos."""
    np.testing.assert_allclose(
        second_difference(dome.gap, ANGLES), dome.bias(ANGLES), atol=1e-8
    )
    found = second_difference(dome.gap_from_the_old_point, ANGLES)
    np.testing.assert_allclose(found, dome.bias_as_printed(ANGLES), atol=1e-8)
    found = second_difference(dome.gap_from_the_old_plane, ANGLES)
    np.testing.assert_allclose(found, -dome.gravity * np.cos(ANGLES), atol=1e-8)


def test_it_leaves_at_two_thirds():
    assert np.degrees(Dome().leaving_angle) == pytest.approx(48.1897, abs=1e-4)
    assert np.degrees(Dome().leaving_angle_as_printed) == pytest.approx(
        36.8699, abs=1e-4
    )
    dome = Dome(start=0.4, radius=3.0)
    assert dome.bias(dome.leaving_angle) == pytest.approx(0, abs=1e-14)
    assert dome.bias_as_printed(dome.leaving_angle_as_printed) == pytest.approx(
        0, abs=1e-14
    )


def test_bias_is_that_of_the_contact_package():
    """A ball of 1e-9 m on a fixed sphere, with curvature tensors."""
    dome, theta, tiny = Dome(radius=2.0), 0.7, 1e-9
    out, along = (
        np.array([0, np.sin(theta), np.cos(theta)]),
        np.array([0, np.cos(theta), -np.sin(theta)]),
    )
    bodies = Bodies.balls([1.0, np.inf], [tiny, 2.0], [(2.0 + tiny) * out, np.zeros(3)],
                          [dome.speed(theta) * along, np.zeros(3)])  # fmt: skip
    contacts = Contacts(np.array([0]), np.array([1]), 2.0 * out[None], out[None], np.zeros(1), np.array(["curved"]),
                        curvature_a=np.eye(3)[None] / tiny, curvature_b=np.eye(3)[None] / 2.0)  # fmt: skip
    weight = [[0, 0, -9.81], [0, 0, 0]]
    found = separation_acceleration(bodies, contacts, weight, np.zeros((2, 3)))[0]
    assert found == pytest.approx(dome.bias(theta), abs=1e-7)


def test_refusals():
    with pytest.raises(ValueError, match="start"):
        Dome(start=2.0)
    with pytest.raises(ValueError, match="radius"):
        Dome(radius=0.0)
    with pytest.raises(ValueError, match="rule: expected one of"):
        slide_off(Dome(start=0.1), 0.01, rule="by eye")
    with pytest.raises(ValueError, match="dome.start"):
        slide_off(Dome(), 0.01)
    with pytest.raises(ValueError, match="angle"):
        Dome(start=0.5).speed(0.4)


@pytest.mark.parametrize("dome", [Dome(), Dome(radius=2.5, start=0.3, gravity=1.6)])
def test_paths_lie_on_the_dome_and_then_on_parabolas(dome):
    paths = dome.paths()
    size = lambda p: np.linalg.norm(p, axis=-1)  # noqa: E731
    np.testing.assert_allclose(size(paths.slide), dome.radius)
    np.testing.assert_allclose(paths.flight[0], paths.slide[-1], atol=1e-14)
    assert size(paths.flight).min() >= dome.radius * (1 - 1e-12)
    fall = np.diff(paths.flight[:, 1], 2)
    np.testing.assert_allclose(fall, fall[0])
    assert np.diff(paths.flight_as_printed[:, 0], 2) == pytest.approx(0, abs=1e-12)
    assert size(paths.deepest) == pytest.approx(dome.radius - paths.depth)
    assert size(paths.flight_as_printed).min() >= dome.radius - paths.depth - 1e-6
    assert size(paths.out) == pytest.approx(dome.radius, rel=1e-3)


def test_curves_of_the_bias_cross_zero_where_the_particle_leaves():
    dome = Dome(start=0.2)
    curves = dome.bias_curves(1.2)
    assert (curves.angle[0], curves.angle[-1]) == (0.2, 1.2)
    for values, leaving in (
        (curves.true, curves.leaving),
        (curves.as_printed, curves.leaving_as_printed),
    ):
        assert np.interp(leaving, curves.angle, values) == pytest.approx(0, abs=1e-3)
    np.testing.assert_allclose(
        curves.as_printed - curves.true, curves.true - curves.over_the_plane
    )
