"""A handle and a body of any moments, at the start and as they turn."""

import numpy as np
import pytest

from course.scenes import handle_mass_properties, spinning_body, spinning_handle
from course.scenes.spinning import HANDLE_CENTERS, HANDLE_HALF_EXTENTS, STEEL

SIZE = lambda v: np.linalg.norm(v, axis=-1)  # noqa: E731


def test_the_handle_is_a_steel_T_by_hand():
    """Mass 8 e1 e2 e3 rho of each box, centre by their masses, moments m (b^2 + c^2)/3 plus Steiner's m d^2."""
    solid = handle_mass_properties()
    mass = STEEL * 8 * np.prod(HANDLE_HALF_EXTENTS, axis=1)
    center = mass @ HANDLE_CENTERS / mass.sum()
    assert solid.mass == pytest.approx(mass.sum()) and solid.centre == pytest.approx(
        center
    )
    for axis in range(3):
        others = np.delete(np.arange(3), axis)
        own = mass * (HANDLE_HALF_EXTENTS[:, others] ** 2).sum(axis=1) / 3
        away = mass * ((HANDLE_CENTERS - center)[:, others] ** 2).sum(axis=1)
        assert solid.inertia[axis, axis] == pytest.approx((own + away).sum())
    assert np.all(np.diff(np.diag(solid.inertia)) > 0)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_it_starts_tilted_as_asked_with_L_upright(axis):
    bodies = spinning_handle(tilt=0.3, spin=5.0, axis=axis).bodies
    momentum, turned = bodies.angular_momentum[0], bodies.rotation[0]
    assert momentum[:2] == pytest.approx([0, 0]) and momentum[2] > 0
    assert SIZE(momentum) == pytest.approx(5.0 * bodies.inertia[0, axis, axis])
    seen = turned.T @ momentum / SIZE(momentum)
    assert seen[axis] == pytest.approx(np.cos(0.3)) and seen[
        (axis + 1) % 3
    ] == pytest.approx(np.sin(0.3))


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_body_of_any_moments_starts_as_the_handle_does(axis):
    """A crate of 20 kg, 0.4 by 0.5 by 0.6 m: moments m (b^2 + c^2)/12."""
    moments = 20 / 12 * np.array([0.41, 0.52, 0.61])
    bodies = spinning_body(moments, mass=20.0, tilt=0.2, spin=6.0, axis=axis).bodies
    seen = bodies.rotation[0].T @ bodies.angular_momentum[0]
    assert bodies.mass[0] == 20 and np.allclose(
        bodies.angular_momentum[0], [0, 0, 6 * moments[axis]]
    )
    assert np.arccos(seen[axis] / np.linalg.norm(seen)) == pytest.approx(0.2)
