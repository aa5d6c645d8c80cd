"""The plank: the law of the lever while both feet carry, and the foot that lifts beyond."""

import numpy as np
import pytest

from course.contact import solve
from course.study import loaded_plank

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
def test_refusals(bad, name):
    with pytest.raises(ValueError, match=f"^{name}: expected"):
        loaded_plank(**({"load_at": 0.0} | bad))
