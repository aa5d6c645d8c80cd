"""One case at a time: what is conserved, closed forms, and the scenes that they are taken from."""

import numpy as np
import pytest

from course.contact import separation_rate, solve
from course.dynamics import Dome
from course.scenes import bar_over_plank, falling_rods, loaded_plank, table
from course.study import (
    central_impact,
    gap_rate,
    old_point,
    plank_forces,
    pushed_table,
    rod_landing,
    two_forces,
    wall_reflection,
)


@pytest.mark.parametrize("e", [0.0, 0.4, 1.0])
def test_central_impact_keeps_momentum_and_counts_energy(e):
    found = central_impact(2.0, 5.0, -3.0, 1.0, e)
    assert found.mass @ found.after == pytest.approx(found.mass @ found.before)
    assert np.subtract(*found.after) == pytest.approx(4 * e)  # it closed at 4 m/s
    change = 0.5 * found.mass @ (found.before**2 - found.after**2)
    assert found.lost == pytest.approx(change, abs=1e-14)
    apart = central_impact(2.0, 5.0, 3.0, 1.0, e)
    assert apart.impulse == apart.lost == 0 and np.array_equal(
        apart.after, apart.before
    )


def test_reflection_turns_the_normal_part_alone():
    found = wall_reflection(30.0, -70.0, 0.5)
    assert found.before @ found.normal == pytest.approx(-np.sin(np.radians(100)))
    assert found.after @ found.normal == pytest.approx(0.5 * np.sin(np.radians(100)))
    assert found.after @ found.along == pytest.approx(found.before @ found.along)


@pytest.mark.parametrize("place", [1.0, 0.3, 0.0, -1.0])
@pytest.mark.parametrize("e", [0.0, 0.7])
def test_rod_landing_is_the_closed_form(place, e):
    """With s = place cos angle: 1/mu = 1 + 3 s^2, and mu (1 - e^2)/2 of half a joule is lost."""
    found = rod_landing(40.0, e, place)
    impulse = float(falling_rods(np.radians(40.0), place=place).truth(e)[0])
    felt = 1 / (1 + 3 * (place * np.cos(np.radians(40.0))) ** 2)
    assert found.impulse == pytest.approx(impulse) and found.felt == pytest.approx(felt)
    assert found.kept == pytest.approx(1 - felt * (1 - e**2))
    hit = np.interp(place, [-1, 0, 1], found.after[:, 2])  # linear along the rod
    assert hit == pytest.approx(e) and found.after[1, 2] == pytest.approx(impulse - 1)
    np.testing.assert_array_equal(found.before, np.tile([0, 0, -1.0], (3, 1)))
    ends = found.after[2] - found.after[0]
    np.testing.assert_allclose(ends, np.cross([0, found.spin, 0], found.axis))


@pytest.mark.parametrize("load_at", [0.3, 1.05])
def test_two_forces_are_those_of_the_solver_and_of_the_plank(load_at):
    system, truth = loaded_plank(load_at).system(), loaded_plank(load_at).truth
    found = plank_forces(load_at)
    forces = found.forces
    np.testing.assert_allclose(forces.force, truth, atol=1e-9)
    np.testing.assert_allclose(
        forces.acceleration, solve(system).acceleration, atol=1e-9
    )
    np.testing.assert_allclose(forces.matrix @ forces.forced, -forces.bias, atol=1e-12)
    assert found.centre == pytest.approx(20 * load_at / 30)
    assert found.feet.tolist() == [-0.5, 0.5]


def test_many_sweeps_come_to_the_solution():
    found = two_forces([[2.0, -1.0], [-1.0, 3.0]], [-1.0, -2.0], sweeps=40)
    assert found.sweeps.shape == (81, 2)
    np.testing.assert_allclose(found.sweeps[-1], found.force, atol=1e-12)
    np.testing.assert_allclose(found.force, [1.0, 1.0], atol=1e-12)


def test_a_table_pushed_at_a_foot_shows_its_column_of_a():
    column = table().system().A.toarray()[:, 2]
    found = pushed_table(-0.5, -0.3)
    np.testing.assert_allclose(found.response, column, atol=1e-14)
    # The response is linear in the place of a foot, and 0 on the still line.
    plane = np.column_stack([found.feet[:, :2], np.ones(4)])
    slope = np.linalg.lstsq(plane, found.response, rcond=None)[0]
    np.testing.assert_allclose(
        np.column_stack([found.still, [1, 1]]) @ slope, 0, atol=1e-12
    )
    assert pushed_table(0.1, 0.05).still is None


def test_old_point_is_the_dome():
    found, dome = old_point(42.0, 0.08), Dome()
    theta = np.radians(42.0)
    assert found.gap == dome.gap(theta, 0.08)
    assert found.from_old_point == pytest.approx(
        (found.path[-1] - found.path[0]) @ found.normal
    )
    assert found.bias == pytest.approx(2 * 9.81 - 3 * 9.81 * np.cos(theta))
    assert found.speed == pytest.approx(np.sqrt(2 * 9.81 * (1 - np.cos(theta))))


def test_gap_rate_is_the_sum_of_its_parts():
    turning = bar_over_plank(-0.7, 0.9, reach=1.3, clear=0.7)
    found = gap_rate(-0.7, 0.9, 0.2, -0.4, reach=1.3)
    expected = separation_rate(turning.bodies, turning.contacts)[0] + 0.6
    assert found.total == pytest.approx(expected) and found.parts["B rises"] == 0.4
    between = found.velocity[0] - found.velocity[1]
    assert between[2] == pytest.approx(expected)
