"""Rods and boxes at the moment they land, against the closed form."""

import numpy as np
import pytest
from scenes.parts import bodies_and_contacts

from course.contact import resolve_collisions
from course.dynamics import effective_mass, normal_velocity
from course.scenes import falling_rods, rod_on_two_pegs


@pytest.mark.parametrize("e", [0.0, 0.6, 1.0])
def test_rods_get_the_closed_form_at_every_angle(e):
    # j = (1 + e) m v/(1 + 3 cos^2 theta): D. Baraff's formula with I = m L^2/12 about the centre.
    angle = np.linspace(0, np.pi / 2, 7)
    rods, floor = bodies_and_contacts(
        falling_rods(angle, mass=2.0, length=3.0, speed=1.5)
    )
    after = resolve_collisions(rods, floor, e)
    impulse = (after.momentum - rods.momentum)[:-1, 2]
    assert np.allclose(
        impulse, (1 + e) * 3.0 / (1 + 3 * np.cos(angle) ** 2), rtol=1e-13
    )
    assert np.allclose(normal_velocity(after, floor), 1.5 * e, atol=1e-13)


def test_mass_felt_along_a_rod():
    # By hand: 1/mu = (1 + 3 place^2)/m for a level rod.
    place = np.array([-1.0, -0.5, 0.0, 0.5, 1.0])
    felt = effective_mass(*bodies_and_contacts(falling_rods(0.0, place=place)))
    assert np.allclose(felt, [0.25, 4 / 7, 1.0, 4 / 7, 0.25], rtol=1e-14)


def test_places_outside_the_rod_are_refused():
    with pytest.raises(
        ValueError, match="place: expected numbers from -1 to 1; got 1.5"
    ):
        bodies_and_contacts(falling_rods(0.0, place=1.5))
    with pytest.raises(
        ValueError, match="place: expected numbers from 0 to 1; got -0.5"
    ):
        bodies_and_contacts(rod_on_two_pegs(-0.5))
